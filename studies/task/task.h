// A block of a file that runs and leaves a folder: Study, Wall, Matrix, Tune, Calibrate. Everything
// that the command and Python do with any of them; a new kind is a class of this folder and a word
// in task_kinds.cpp.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "output/files/result_folder.h"
#include "studies/measure/engine_table.h"
#include "studies/plan/plan.h"
#include "studies/report/publication.h"
#include "studies/report/report.h"
#include "studies/report/terminal_table.h"
#include "studies/run/run.h"
#include "studies/run/scene_file.h"
#include "studies/task/result_values.h"

namespace hookpoint::studies {

/// The worse the later.
enum class TaskStatus {
  holds,
  fails,        ///< a verdict does not hold, or a block judged nothing
  incomplete,   ///< something that it needs is not on this machine
  interrupted,  ///< finished runs are stored
};

/// A file of tasks, evaluated.
struct TaskFile {
  std::unique_ptr<language::Object> root;  ///< null after errors, which are reported
  std::vector<std::string> settable;       ///< Params and objects at its top
};

/// Where tasks find files, classes and engines. Outlives the tasks.
class TaskHost {
 public:
  virtual ~TaskHost() = default;
  /// Valid until plugins are loaded, which `evaluate` does.
  virtual language::Library& library() = 0;
  virtual const EngineTable& engines() const = 0;
  virtual void tell(const language::Diagnostics& diagnostics) const = 0;
  /// `file` with the user's settings, and the plugins of the scenes that it runs.
  virtual TaskFile evaluate(const std::filesystem::path& file) = 0;
  /// Every constant of other engines that the study ran with, for its report.
  virtual std::vector<PeerSetting> peer_settings(const StudyResult& result) const = 0;
};

/// What the tasks of a file are made from.
struct TaskSource {
  TaskHost& host;
  const language::Object& root;
  std::filesystem::path file;
  PlanOptions options;
  std::string command;  ///< runs the file again
  PublicationForms forms{};
};

class Task;

/// Who runs tasks: the command with its bars and pages, or Python.
class TaskRunner {
 public:
  using Work = std::function<void(const RunOptions& options, const std::atomic<bool>& stop)>;

  virtual ~TaskRunner() = default;

  /// Threads, and whether finished runs are taken over.
  virtual RunOptions options() const = 0;
  /// Does `work` with `options`, and with what shows its progress and stops it.
  virtual void run(const Task& task, RunOptions options, const Work& work) = 0;
  /// A notice that the task's values have too. Any thread may call it, and the next two.
  virtual void note(const std::string& message) = 0;
  /// A notice that they do not have.
  virtual void warn(const std::string& message) = 0;
  /// How far the run has come, in words.
  virtual void message(const std::string& message) = 0;
  /// A part of the report that could not be made.
  virtual void problem(const std::string& message) = 0;
  /// Whether anybody reads the reports.
  virtual bool wants_reports() const = 0;
  /// The task's folder is complete.
  virtual void left(Task& task) = 0;
};

class Task {
 public:
  Task(const TaskSource& source, std::string name, std::string hash)
      : host_(source.host),
        command_(source.command),
        forms_(source.forms),
        name_(std::move(name)),
        hash_(std::move(hash)) {}
  virtual ~Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  const std::string& name() const { return name_; }
  const std::string& hash() const { return hash_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Where its results go; before it runs.
  virtual void place(std::filesystem::path folder) { folder_ = std::move(folder); }

  /// Runs it, and leaves its files. `store`: that it shares with other tasks; null: it has its own.
  /// Throws output::FolderError when the folder is not to be had, output::FileError and StoreError
  /// when the disk refuses.
  virtual TaskStatus run(TaskRunner& runner, const std::shared_ptr<RunStore>& store);

  /// Why it cannot run on this machine; "" where it can.
  virtual std::string missing() const { return ""; }
  /// Params and objects of its scenes, which `--set` reaches.
  virtual std::vector<std::string> settable() const { return {}; }
  /// Why a cluster does not make its runs; "" where it does.
  virtual std::string runs_here() const { return ""; }
  /// How many runs a cluster would make at once.
  virtual std::size_t remote_runs() const { return 0; }

  /// The studies of a Matrix; else itself.
  virtual std::vector<const Task*> parts() const { return {this}; }
  /// Rows that fill while it runs; null where it has none.
  virtual const StudyPlan* rows_plan() const { return nullptr; }
  /// The table of `rows_plan()` with no row run.
  virtual StudyResult empty_rows() const { return {}; }
  /// What all rows together tell, after the run; null where the rows say it all.
  virtual const StudyResult* rows() const { return nullptr; }

  /// Name of its page in its folder, without the extension.
  virtual const char* page() const { return "report"; }
  std::filesystem::path page_file() const { return folder_ / (std::string(page()) + ".html"); }
  /// A scene of which the page may have a picture, as a file; `folder` takes what has to be
  /// written.
  virtual std::optional<SceneFile> pictured_scene(const std::filesystem::path&) const {
    return std::nullopt;
  }
  /// A picture that `pictured_scene` may have, by its name from the folder on.
  static constexpr const char* picture = "pictures/scene.png";
  /// Links the picture from the page.
  virtual void add_picture() {}

  /// What a terminal shows of the result; "" without one.
  virtual std::string terminal_text(const TableStyle& style) const = 0;
  /// What judged nothing though it should, a line each, beside the text.
  virtual std::vector<std::string> faults() const { return {}; }
  virtual ResultValues values() const = 0;

 protected:
  /// One run, within TaskRunner::run.
  virtual void execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) = 0;
  /// Whether there is a result to leave, though perhaps the beginning of one.
  virtual bool has_result() const = 0;
  virtual bool is_whole() const { return has_result(); }
  /// Notices of the runs.
  virtual std::vector<std::string> notices() const { return {}; }
  /// Writes the report and all else; what could not be drawn.
  virtual std::vector<std::string> leave() = 0;
  /// The result as a paper takes it; after `leave`.
  virtual Publication publication() const { return {}; }
  virtual bool holds() const = 0;
  /// The block's title, else its name.
  std::string title_or_name(const std::string& title) const {
    return title.empty() ? name_ : title;
  }

  TaskHost& host_;
  const std::string command_;
  const PublicationForms forms_;
  std::unique_ptr<output::ResultFolder> files_;  ///< locks the folder while it runs

 private:
  std::string name_, hash_;
  std::filesystem::path folder_;
};

using Tasks = std::vector<std::unique_ptr<Task>>;

/// A kind of task; each stands beside its class.
struct TaskKind {
  const char* block;    ///< "Study"
  const char* command;  ///< "study"
  /// Files of the scenes that the block runs, as it writes them.
  std::vector<std::string> (*scenes)(const language::Object& block);
  /// The block's tasks into `tasks`, with everything checked; false after errors, which are
  /// reported.
  bool (*plan)(const TaskSource& source, const language::Object& block, Tasks& tasks);
};

}  // namespace hookpoint::studies
