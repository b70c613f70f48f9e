#include <fmt/format.h>

#include <cmath>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "cli/run_loop.h"

namespace hookpoint::cli {
namespace {

/// `--for` is the World's duration.
std::vector<std::string> settings_with_duration(Application& application,
                                                const RunArguments& arguments) {
  std::vector<std::string> settings = arguments.settings;
  if (!arguments.duration) return settings;
  for (std::string& setting :
       application.world_settings(arguments.file, "duration", *arguments.duration))
    settings.push_back(std::move(setting));
  return settings;
}

}  // namespace

int run(const RunArguments& arguments) {
  if (arguments.resume) return resume(arguments);
  if (arguments.file.empty() || arguments.at) {
    print_error(arguments.file.empty() ? "run takes a FILE, or --resume MOVIE"
                                       : "--at is a moment of a movie: it goes with --resume");
    return wrong_input;
  }
  Application application(arguments.allow_plugins);
  if (!application.load_plugins(arguments.file)) return wrong_input;
  const std::vector<std::string> settings = settings_with_duration(application, arguments);
  const auto root = application.evaluate(arguments.file, settings);
  if (!root) return wrong_input;
  auto experiment = application.load(*root);
  if (!experiment) return wrong_input;

  try {
    const std::filesystem::path folder =
        arguments.out.value_or(std::filesystem::path("runs") / experiment->world);
    if (arguments.movie) simulation::add_movie(*arguments.movie, *experiment);
    simulation::World world(*experiment, application.make_engine(*experiment));
    simulation::RunFiles files(
        *experiment, world, world.ports(),
        {folder, arguments.record, language::print(*root), arguments.out.has_value()});
    tell_stability(*experiment);
    const auto steps =
        static_cast<std::int64_t>(std::llround(experiment->duration / experiment->deltat));
    // Truths are about the scene's own duration.
    std::optional<simulation::Expectations> expectations;
    if (!arguments.duration) expectations.emplace(*experiment, world.ports());
    const int status =
        step_through(*experiment, world, files, steps, expectations ? &*expectations : nullptr);
    files.close();
    print_summary(*experiment, world.state());
    if (status != fine || !expectations) return status;
    return print_expectations(*expectations);
  } catch (const simulation::ExperimentError& error) {
    print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
