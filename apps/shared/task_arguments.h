// Arguments of the commands that run tasks: study and tune.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/consent.h"
#include "apps/shared/settings.h"
#include "studies/cluster/slurm_script.h"
#include "studies/report/publication.h"

namespace hookpoint::application {

struct TaskArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;
  int jobs = 0;  ///< 0: one a core
  bool quick = false;
  bool resume = false;
  std::vector<std::string> only;  ///< subjects
  Consent consent;
  Settings settings{};   ///< of the file and of the scenes that it runs
  bool slurm = false;    ///< the runs are made by a cluster
  bool dry_run = false;  ///< only prints what it would be sent
  studies::SlurmSettings slurm_settings{};
  std::vector<std::string> engine_files{};  ///< absolute, that a cluster's runs may need
  std::vector<std::string> words{};   ///< of a command that makes its file; empty: it is given
  studies::PublicationForms forms{};  ///< what is left for a paper

  /// `jobs`, or how many cores there are.
  int threads() const;
};

/// "hookpoint study FILE ..." as it was called.
std::string rerun_command(const std::string& command, const TaskArguments& arguments);

}  // namespace hookpoint::application
