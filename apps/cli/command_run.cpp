#include <fmt/format.h>

#include <iostream>
#include <utility>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/run_loop.h"
#include "apps/shared/application.h"
#include "apps/shared/live_loader.h"
#include "apps/shared/robot_file.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/scene/load.h"
#include "text/shell_word.h"

namespace hookpoint::cli {
namespace {

/// `--for` is the World's duration.
application::Settings settings_with_duration(const RunArguments& arguments) {
  application::Settings settings = arguments.settings;
  if (arguments.duration) settings.world.emplace_back("duration", *arguments.duration);
  return settings;
}

void tell_windows(const language::Object& root, const std::filesystem::path& file) {
  if (root.children_of("Window").empty()) return;
  std::cerr << "hookpoint: note: the file's windows are not shown: `hookpoint view "
            << text::shell_word(file.string()) << "` does\n";
}

/// A run again in which people changed something.
int repeat(const RunArguments& arguments) {
  const std::string file = arguments.changes->string();
  std::vector<simulation::Change> changes = simulation::read_changes(*arguments.changes);
  application::LiveLoader loader(arguments.file, settings_with_duration(arguments),
                                 arguments.consent, arguments.movie);
  std::string problem;
  const simulation::LoadedExperiment* first = loader.load_first(problem);
  if (first == nullptr) {
    std::cerr << problem << '\n';
    return wrong_input;
  }
  tell_windows(loader.root(), arguments.file);
  tell_unread(loader.root(), first->experiment);
  tell_stability(first->experiment);
  const std::filesystem::path folder =
      arguments.out.value_or(std::filesystem::path("runs") / first->experiment.world);
  const auto load = [&](const std::vector<std::string>& overrides, std::string& why) {
    return loader.load(overrides, why);
  };
  try {
    simulation::LiveRun run(load, {folder, arguments.record, arguments.out.has_value()},
                            std::move(changes));
    const int status = step_through(run);
    run.close();
    tell_files(run.folder(), run.names());
    print_summary(run.experiment(), run.world().state());
    if (const std::size_t left = run.left_of_script(); left > 0)
      std::cerr << fmt::format(
          "hookpoint: note: the last {} of the changes in {} were not made: the run ended before "
          "their step\n",
          left, file);
    return status;
  } catch (const simulation::ChangesError& error) {
    throw simulation::ChangesError(fmt::format("{}, {}", file, error.what()));
  }
}

}  // namespace

int run(const RunArguments& arguments) {
  if (arguments.resume) return resume(arguments);
  if (arguments.file.empty() || arguments.at) {
    application::print_error(arguments.file.empty()
                                 ? "run takes a FILE, or --resume MOVIE"
                                 : "--at is a moment of a movie: it goes with --resume");
    return wrong_input;
  }
  if (arguments.viewed) return view(arguments);
  if (arguments.changes) {
    try {
      return repeat(arguments);
    } catch (const simulation::ChangesError& error) {
      application::print_error(error.what());
    } catch (const simulation::ExperimentError& error) {
      application::print_error(error.what());
    }
    return wrong_input;
  }
  application::Application application(arguments.consent);
  const std::filesystem::path file = application::file_with_world(
      application, application.locate(arguments.file), arguments.consent);
  const auto root = application.evaluate_set(file, settings_with_duration(arguments));
  if (!root) return wrong_input;
  auto experiment = application.load(*root);
  if (!experiment) return wrong_input;

  try {
    const std::filesystem::path folder =
        arguments.out.value_or(std::filesystem::path("runs") / experiment->world);
    simulation::write_chosen_step(*experiment, *root);
    if (arguments.movie) simulation::add_movie(*arguments.movie, *experiment);
    simulation::World world(*experiment, application.make_engine(*experiment));
    simulation::RunFiles files(
        *experiment, world, world.ports(),
        {folder, arguments.record, language::print(*root), arguments.out.has_value(),
         application.describe_engine(*experiment), language::sources_of(*root)});
    tell_windows(*root, arguments.file);
    tell_unread(*root, *experiment);
    tell_stability(*experiment);
    const std::int64_t steps = simulation::step_count(experiment->duration, experiment->deltat);
    // Truths are about the scene's own duration.
    std::optional<simulation::Expectations> expectations;
    if (!arguments.duration) expectations.emplace(*experiment, world.ports());
    const int status =
        step_through(*experiment, world, files, steps, expectations ? &*expectations : nullptr);
    files.close();
    tell_files(files.folder(), files.names());
    print_summary(*experiment, world.state());
    if (status == fine) print_not_judged(*experiment, expectations.has_value());
    if (status != fine || !expectations) return status;
    return print_expectations(*expectations);
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
