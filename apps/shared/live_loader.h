// The file of a run that a user may change, loaded whenever a field of it is edited.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/application.h"
#include "apps/shared/robot_file.h"
#include "simulation/run/live_run.h"

namespace hookpoint::application {

class LiveLoader {
 public:
  /// `movie`: one that is added to those of the file (simulation/run/run_files.h). `leader`: its
  /// chosen step (`deltat = auto`) is taken unless `settings` give one; it outlives this.
  LiveLoader(std::filesystem::path file, Settings settings, Consent consent,
             std::optional<std::filesystem::path> movie = std::nullopt,
             const LiveLoader* leader = nullptr);

  /// The file for the first time: the next `load` without overrides gives it, unless it is called
  /// again before. Null where it is wrong.
  const simulation::LoadedExperiment* load_first(std::string& problem);
  /// Without overrides the file is read again; with some it is as it was read then, and a step that
  /// was chosen then (`deltat = auto`) is its step: a state of one step means nothing in another.
  /// Errors go into `problem`, warnings are printed once.
  std::optional<simulation::LoadedExperiment> load(const std::vector<std::string>& overrides,
                                                   std::string& problem);
  /// The tree of what was loaded last.
  const language::Object& root() const { return *root_; }

 private:
  void read_anew();
  std::optional<simulation::LoadedExperiment> evaluate(const std::vector<std::string>& overrides,
                                                       std::string& problem);

  const std::filesystem::path file_;
  const Settings settings_;
  const Consent consent_;
  const std::optional<std::filesystem::path> movie_;
  const LiveLoader* const leader_;
  std::string told_;  ///< errors of the load that is under way
  std::shared_ptr<Application> application_;
  std::filesystem::path found_;
  std::optional<RobotWorld>
      robot_world_;  ///< of a robot's file: chosen once, read as often as the file
  std::unique_ptr<language::Object> root_;
  std::optional<simulation::LoadedExperiment> first_;
  std::vector<std::string> step_;  ///< the setting of a step that was chosen; else empty
};

}  // namespace hookpoint::application
