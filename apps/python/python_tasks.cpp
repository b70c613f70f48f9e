#include "apps/python/python_tasks.h"

#include <string>
#include <utility>
#include <vector>

#include "apps/python/errors.h"
#include "apps/python/loaded_file.h"
#include "apps/python/run_beside.h"
#include "apps/python/tables.h"
#include "apps/python/temporary_folder.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// Tasks whose notices are warnings, where their values do not have them. Reports are drawn only
/// for a folder that is kept.
class PythonRunner : public studies::TaskRunner {
 public:
  explicit PythonRunner(const application::TaskArguments& arguments) : arguments_(arguments) {}

  studies::RunOptions options() const override {
    studies::RunOptions options;
    options.jobs = arguments_.threads();
    options.resume = arguments_.resume;
    return options;
  }

  void run(const studies::Task&, studies::RunOptions options, const Work& work) override {
    run_beside([&](const std::atomic<bool>& stop) {
      work(options, stop);
      return true;
    });
    for (const std::string& message : std::exchange(warnings_, {})) python::warn(message);
  }

  void note(const std::string&) override {}
  /// Kept until the run ends, since it runs in a thread that is not Python's.
  void warn(const std::string& message) override { warnings_.push_back(message); }
  void message(const std::string&) override {}
  void problem(const std::string& message) override { python::warn(message); }
  bool wants_reports() const override { return arguments_.out.has_value(); }
  void left(studies::Task&) override {}

 private:
  const application::TaskArguments& arguments_;
  std::vector<std::string> warnings_;
};

}  // namespace

py::dict run_tasks(const application::TaskCommand& command,
                   const application::TaskArguments& asked) {
  QuietApplication application(asked.consent);
  application::TaskArguments arguments = asked;
  arguments.file = application->find(asked.file);
  application::TaskApplication host(*application, command, arguments);
  const auto tasks = host.plan();
  if (!tasks) application.fail();
  if (tasks->empty())
    throw_error(application::nothing_to_run(arguments.file, command, command.instead_in_python));
  application.pass_on_warnings();
  const TemporaryFolder unkept;
  PythonRunner runner(arguments);
  const auto store = host.shared_store(*tasks);
  py::dict results;
  for (const auto& task : *tasks) {
    if (!arguments.out) task->place(unkept.path() / task->name());
    if (const std::string why = task->missing(); !why.empty()) throw_error(why);
    task->run(runner, store);
    results[py::str(task->name())] = dict_of(task->values());
  }
  return results;
}

}  // namespace hookpoint::python
