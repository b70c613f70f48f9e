#include <algorithm>
#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "apps/shared/task_file.h"
#include "output/files/file.h"
#include "simulation/analysis/step_warning.h"
#include "text/formats.h"

namespace hookpoint::cli {
namespace {

/// The warning that a run of the file's World begins with.
void warn_of_step(const application::Application& application, const language::Object& root,
                  const simulation::Experiment& experiment) {
  const auto warning = simulation::step_warning(experiment);
  if (!warning) return;
  language::Diagnostics diagnostics;
  diagnostics.warning(root.children_of("World").front()->position, *warning);
  application.tell(diagnostics);
}

/// What `run`, `study` and `tune` would find before anything runs, found.
bool can_run(application::Application& application, const language::Object& root,
             const std::filesystem::path& file, application::Consent consent) {
  if (!root.children_of("World").empty()) {
    const auto experiment = application.load(root);
    if (!experiment) return false;
    warn_of_step(application, root, *experiment);
  }
  application::TaskArguments arguments;
  arguments.file = file;
  arguments.consent = consent;
  return std::ranges::all_of(
      application::task_commands, [&](const application::TaskCommand* command) {
        return !studies::holds_task(root, command->name) ||
               application::TaskApplication(application, *command, arguments).plan(root);
      });
}

}  // namespace

int check(const std::vector<std::filesystem::path>& files, application::Consent consent) {
  application::Application application(consent);
  int status = fine;
  for (const std::filesystem::path& named : files) {
    const std::filesystem::path file = application.locate(named);
    const auto root = application.evaluate(file, {});
    if (root && can_run(application, *root, file, consent)) {
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
    const std::string refusal = text::refusal(*text, file, text::Use::experiment);
    const std::string_view ending = text::usual_ending(*text, file);
    if (!refusal.empty() || ending == ".urdf" || ending == ".mjcf" || ending == ".sdf") {
      application::print_error(
          file.string() + ": " +
          (refusal.empty() ? "`fmt` rewrites files of the language (.hook), not URDF, MJCF or SDF"
                           : refusal));
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
          application::Consent consent) {
  application::Application application(consent);
  const auto root = application.evaluate_set(application.locate(file), settings);
  if (!root) return wrong_input;
  std::cout << language::print(*root);
  return fine;
}

}  // namespace hookpoint::cli
