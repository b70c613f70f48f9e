// A file's World, or a robot's file, as a model of another program.
#pragma once

#include <optional>
#include <string>

#include "apps/shared/consent.h"
#include "apps/shared/translated.h"
#include "translation/models/model.h"

namespace hookpoint::application {

struct ExportRequest {
  std::filesystem::path file;  ///< a .hook file with a World, or a robot's file
  Settings settings;
  std::string format;  ///< "mjcf"
  std::optional<std::string>
      robot;  ///< this one alone; none: all, of a format of one robot the only one
  std::optional<std::string> creep;  ///< as TranslateRequest's
  Consent consent;
};

/// None after errors of the file, which are reported. Throws translation::ParameterError for an unknown
/// format or robot.
std::optional<translation::Model> exported(Application& application, const ExportRequest& request);

}  // namespace hookpoint::application
