#include <iostream>

#include "application/application.h"
#include "application/calibration_plans.h"
#include "application/study_plans.h"
#include "application/tune_plans.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "formats/formats.h"
#include "output/file.h"

namespace hookpoint::cli {
namespace {

/// What `run`, `study` and `tune` would find before anything runs, found.
bool can_run(application::Application& application, const language::Object& root,
             const std::filesystem::path& file, bool allow_plugins) {
  if (!root.children_of("World").empty() && !application.load(root)) return false;
  application::StudyArguments arguments;
  arguments.file = file;
  arguments.allow_plugins = allow_plugins;
  if (application::holds_study(root) && !application::plan_study_file(application, root, arguments))
    return false;
  return !application::holds_tune(root) ||
         (application::plan_tune_file(application, root, arguments).has_value() &&
          application::plan_calibrate_file(application, root, arguments).has_value());
}

}  // namespace

int check(const std::vector<std::filesystem::path>& files, bool allow_plugins) {
  application::Application application(allow_plugins);
  int status = fine;
  for (const std::filesystem::path& named : files) {
    const std::filesystem::path file = application.locate(named);
    const auto root = application.evaluate(file, {});
    if (root && can_run(application, *root, file, allow_plugins)) {
      std::cout << file.string() << ": fine\n";
    } else {
      status = wrong_input;
    }
  }
  return status;
}

int format(const std::vector<std::filesystem::path>& files, bool check_only) {
  int status = fine;
  for (const std::filesystem::path& file : files) {
    const auto text = output::read_file(file);
    if (!text) {
      application::print_error("cannot read " + file.string());
      status = wrong_input;
      continue;
    }
    const std::string refusal = formats::refusal(*text, file, formats::Use::experiment);
    if (!refusal.empty() || formats::usual_ending(*text, file) == ".urdf") {
      application::print_error(
          file.string() + ": " +
          (refusal.empty() ? "`fmt` rewrites files of the language (.hook), not URDF" : refusal));
      status = wrong_input;
      continue;
    }
    language::Diagnostics diagnostics;
    const std::string canonical = language::format(file, *text, diagnostics);
    application::print_diagnostics(diagnostics);
    if (diagnostics.has_errors()) {
      status = wrong_input;
    } else if (canonical == *text) {
      continue;
    } else if (check_only) {
      std::cout << file.string() << ": would change\n";
      status = truth_failed;
    } else {
      output::write_file(file, canonical);
      std::cout << file.string() << ": rewritten\n";
    }
  }
  return status;
}

int print(const std::filesystem::path& file, const application::Settings& settings,
          bool allow_plugins) {
  application::Application application(allow_plugins);
  const auto root = application.evaluate_set(application.locate(file), settings);
  if (!root) return wrong_input;
  std::cout << language::print(*root);
  return fine;
}

}  // namespace hookpoint::cli
