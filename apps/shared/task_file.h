// The tasks of a file, planned before anything runs. Shared by the command and by Python.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/application.h"
#include "apps/shared/task_arguments.h"
#include "studies/task/task_kinds.h"

namespace hookpoint::application {

/// A command that runs tasks.
struct TaskCommand {
  const char* name;
  const char* instead;            ///< what to do with a file that has none of its tasks
  const char* instead_in_python;  ///< the same
  /// Its settings are of the scenes too, and all its tasks in one folder share their runs.
  bool of_scenes;
};

inline constexpr TaskCommand study_command{"study", "`hookpoint run` runs a world",
                                           "`hookpoint run` runs a world", true};
inline constexpr TaskCommand tune_command{"tune", "`hookpoint study` runs studies",
                                          "`hookpoint.study` runs studies", false};
inline constexpr const TaskCommand* task_commands[] = {&study_command, &tune_command};

/// "creep.hook holds no Tune and no Calibrate; " and what to do.
std::string nothing_to_run(const std::filesystem::path& file, const TaskCommand& command,
                           const std::string& instead);

/// A file with those of the settings that it has a Param or an object for.
studies::TaskFile evaluate_file(Application& application, const std::filesystem::path& file,
                                const Settings& settings);

/// The application as tasks see it. Outlives them.
class TaskApplication : public studies::TaskHost {
 public:
  /// `arguments.file` is where the file is.
  TaskApplication(Application& application, const TaskCommand& command,
                  const TaskArguments& arguments)
      : application_(application), command_(command), arguments_(arguments) {}

  /// The tasks of the file, which go into `arguments.out`; none for a file that holds none, nothing
  /// after errors, which are reported.
  std::optional<studies::Tasks> plan();
  /// The same of the file as it was evaluated, not placed.
  std::optional<studies::Tasks> plan(const language::Object& root);
  /// The store that all the tasks share, in the folder that the user named for them; null where
  /// each has its own. Throws studies::StoreError.
  std::shared_ptr<studies::RunStore> shared_store(const studies::Tasks& tasks) const;

  language::Library& library() override { return application_.library(); }
  const studies::EngineTable& engines() const override { return application_.engines(); }
  void tell(const language::Diagnostics& diagnostics) const override {
    application_.tell(diagnostics);
  }
  studies::TaskFile evaluate(const std::filesystem::path& file) override;
  std::vector<studies::PeerSetting> peer_settings(
      const studies::StudyResult& result) const override;

 private:
  std::string unknown_setting(const studies::Tasks& tasks, std::vector<std::string> settable) const;

  Application& application_;
  const TaskCommand& command_;
  const TaskArguments& arguments_;
};

}  // namespace hookpoint::application
