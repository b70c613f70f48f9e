// What a study is asked for with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "application/settings.h"
#include "studies/cluster/slurm_script.h"

namespace hookpoint::application {

struct StudyArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;
  int jobs = 0;  ///< 0: one a core
  bool quick = false;
  bool resume = false;
  std::vector<std::string> only;  ///< subjects
  bool allow_plugins = false;
  Settings settings{};   ///< of the file and of the scenes that it runs
  bool slurm = false;    ///< the runs are made by a cluster
  bool dry_run = false;  ///< only says what it would be asked
  studies::SlurmSettings slurm_settings{};
};
}  // namespace hookpoint::application
