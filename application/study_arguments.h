// What a study is asked for with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "application/settings.h"

namespace hookpoint::application {

struct StudyArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;
  int jobs = 0;  ///< 0: one a core
  bool quick = false;
  bool resume = false;
  std::vector<std::string> only;  ///< subjects
  bool allow_plugins = false;
  Settings settings{};  ///< of the file and of the scenes that it runs
};
}  // namespace hookpoint::application
