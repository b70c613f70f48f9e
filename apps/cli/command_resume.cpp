#include <fmt/format.h>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/opened_movie.h"
#include "apps/cli/run_loop.h"
#include "simulation/engine_interface/step_count.h"

namespace hookpoint::cli {
namespace {

/// Steps from `first` on: as `--for` says, else to the World's duration.
std::int64_t last_step(const RunArguments& arguments, const simulation::Experiment& experiment,
                       std::int64_t first) {
  const double duration =
      arguments.duration ? seconds(*arguments.duration, "--for") : experiment.duration;
  const double begin = arguments.duration ? static_cast<double>(first) * experiment.deltat : 0.;
  const std::int64_t last = simulation::step_count(begin + duration, experiment.deltat);
  if (last > first) return last;
  throw output::MovieError(fmt::format(
      "nothing is left to run from {:.6g} s on: the World's duration is {:.6g} s; say --for "
      "how long, or an "
      "earlier moment with --at",
      static_cast<double>(first) * experiment.deltat, experiment.duration));
}

int go_on(const RunArguments& arguments) {
  OpenedMovie movie(*arguments.resume, arguments.consent);
  simulation::Experiment experiment = movie.load();
  if (arguments.movie) simulation::add_movie(*arguments.movie, experiment);
  simulation::World world = movie.make_world(experiment);
  simulation::Rewind rewind(experiment, movie.reader(), world);
  const std::int64_t first =
      arguments.at ? rewind.step_at(seconds(*arguments.at, "--at")) : rewind.last();
  const std::int64_t last = last_step(arguments, experiment, first);
  const int found = use_movie(rewind, [&] {
    rewind.approach(first);
    return fine;
  });
  if (found != fine) return found;
  const std::filesystem::path folder =
      arguments.out.value_or(std::filesystem::path("runs") / (experiment.world + "-resumed"));
  simulation::RunFiles files(experiment, world, world.ports(),
                             {folder,
                              arguments.record,
                              movie.reader().header().experiment,
                              arguments.out.has_value(),
                              movie.describe_engine(experiment),
                              {std::filesystem::absolute(*arguments.resume).string()}},
                             first);
  rewind.arrive(first);
  tell_stability(experiment);
  const int status = step_through(experiment, world, files, last);
  files.close();
  tell_files(files.folder(), files.names());
  print_summary(experiment, world.state());
  return status;
}

}  // namespace

int resume(const RunArguments& arguments) {
  if (!arguments.file.empty() || !arguments.settings.empty()) {
    application::print_error(
        "run --resume continues the experiment inside the movie: it takes neither a FILE nor "
        "--set or its short forms");
    return wrong_input;
  }
  if (arguments.changes) {
    application::print_error(
        "--changes are made from time 0 on: they go with a FILE, not with --resume");
    return wrong_input;
  }
  return use_movie([&] { return go_on(arguments); });
}

}  // namespace hookpoint::cli
