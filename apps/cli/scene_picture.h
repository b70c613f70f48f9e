// A picture of a scene as it stands at time 0, drawn by the page in a browser without a display.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/shared/consent.h"

namespace hookpoint::cli {

struct PictureRequest {
  std::filesystem::path scene;
  std::vector<std::string> settings;  ///< as --set takes them
  application::Consent consent;
  std::filesystem::path file;  ///< a PNG
};

/// Draws it, in some seconds. "" or why there is none; then there is no file either. `stop` may be
/// set meanwhile.
std::string draw_scene_picture(const PictureRequest& request, const std::atomic<bool>& stop);

}  // namespace hookpoint::cli
