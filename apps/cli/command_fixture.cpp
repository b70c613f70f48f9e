#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/fixture.h"
#include "apps/shared/subject_words.h"

namespace hookpoint::cli {

int run_fixture(const FixtureArguments& arguments) {
  application::Application application(arguments.tasks.consent);
  if (arguments.engines && !application.evaluate(application.locate(*arguments.engines), {}))
    return wrong_input;
  application::TaskArguments tasks = arguments.tasks;
  tasks.file = "fixture.hook";
  tasks.words = {"fixture", "run"};
  tasks.words.insert(tasks.words.end(), arguments.subjects.begin(), arguments.subjects.end());
  if (arguments.engines) {
    tasks.words.emplace_back("--engines");
    tasks.words.push_back(arguments.engines->string());
  }
  try {
    application.give(tasks.file, application::fixture_wall(application, arguments.subjects));
  } catch (const application::SubjectError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
  return run_tasks(application, application::study_command, tasks);
}

int export_fixture(const std::filesystem::path& folder) {
  application::Application application;
  return application::export_fixture(application, folder) ? fine : wrong_input;
}

}  // namespace hookpoint::cli
