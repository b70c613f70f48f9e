// replay: a movie in the window, what it is, or a moment of it.
#include <fmt/format.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/movie_windows.h"
#include "apps/cli/open_browser.h"
#include "apps/cli/opened_movie.h"
#include "apps/cli/run_loop.h"
#include "apps/view/page_bundle.h"
#include "apps/view/session/movie_session.h"
#include "simulation/wiring/port_search.h"
#include "text/display.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::cli {
namespace {

using simulation::Port;

/// All ports, or those that are asked for under the names by which they are.
std::vector<Port> wanted_ports(const simulation::Experiment& experiment, simulation::World& world,
                               const std::vector<std::string>& patterns) {
  return simulation::find_all_ports(experiment, world.ports(),
                                    patterns.empty() ? std::vector<std::string>{"**"} : patterns);
}

void print_json(const std::string& world, const simulation::WorldState& state,
                const std::vector<Port>& ports) {
  text::JsonWriter json;
  json.begin_object().member("world", world).member("time", state.time).member("step", state.step);
  json.key("ports").begin_object();
  for (const Port& port : ports) json.member(port.trail, *port.value);
  json.end_object().end_object();
  std::cout << json.text();
}

void print_table(const simulation::WorldState& state, const std::vector<Port>& ports) {
  fmt::print("time {} s, step {}\n", text::rounded(state.time, 9), state.step);
  for (const Port& port : ports)
    fmt::print("{:<56} {} {}\n", port.trail, text::shortest(*port.value), port.unit);
}

void print_movie(const output::MovieReader& movie) {
  const output::MovieHeader& header = movie.header();
  fmt::print("movie {}, {}\n", text::printable(header.name),
             movie.complete() ? "complete" : "cut off: its last instants may be missing");
  for (const auto& [key, value] : header.annotations)
    fmt::print("  {:<12} {}\n", text::printable(key), text::printable(value));
  for (const output::MovieFile& file : header.files)
    fmt::print("  {:<12} {} ({} bytes)\n", "file", text::printable(file.name), file.content.size());
  const std::vector<double>& times = movie.times();
  fmt::print("  {:<12} {}, {} s apart\n", "instants", times.size(),
             text::rounded(header.period, 6));
  if (!times.empty())
    fmt::print("  {:<12} {} s to {} s\n", "time", text::rounded(times.front(), 9),
               text::rounded(times.back(), 9));
  fmt::print("  {:<12} {} numbers an instant\n", "state", header.size);
}

int show_moment(const ReplayArguments& arguments) {
  OpenedMovie movie(arguments.movie, arguments.consent);
  simulation::Experiment experiment = movie.load();
  simulation::World world = movie.make_world(experiment);
  simulation::Rewind rewind(experiment, movie.reader(), world);
  const std::int64_t step = rewind.step_at(seconds(*arguments.at, "--at"));
  const bool summary = arguments.record.empty() && !arguments.json;
  std::vector<Port> ports;
  if (!summary) ports = wanted_ports(experiment, world, arguments.record);
  const int status = use_movie(rewind, [&] {
    rewind.approach(step);
    rewind.arrive(step);
    return fine;
  });
  if (status != fine) return status;
  if (summary) {
    print_summary(experiment, world.state());
    std::cerr << fmt::format("{} ports have a value then: --record \"**\" prints all\n",
                             world.ports().size());
  } else if (arguments.json) {
    print_json(experiment.world, world.state(), ports);
  } else {
    print_table(world.state(), ports);
  }
  return fine;
}

/// In the windows of its experiment, until nobody wants to see more.
int show_window(const ReplayArguments& arguments) {
  const InterruptGuard guard;
  MovieWindows windows(arguments.movie, arguments.consent);
  view::Server server({arguments.view.bind, arguments.view.port,
                       arguments.view.token.value_or(view::fresh_token())},
                      page_bundle::index_html);
  view::Audience audience(server);
  view::MovieSession session(windows.movie(), audience,
                             {[&](const std::vector<Port>& ports) { return windows.show(ports); },
                              std::filesystem::absolute(arguments.movie).parent_path()});
  std::cout << server.url() << std::endl;
  if (arguments.view.open) open_browser(server.url());
  session.run(guard.stop());
  return fine;
}

int show(const ReplayArguments& arguments) {
  if (arguments.at) return show_moment(arguments);
  if (!arguments.about) return show_window(arguments);
  print_movie(OpenedMovie(arguments.movie, arguments.consent).reader());
  return fine;
}

/// "" or what does not go together.
std::string conflict(const ReplayArguments& arguments) {
  const bool film = !arguments.film.file.empty(), page = !arguments.page.empty();
  const bool moment = arguments.json || (!arguments.record.empty() && !page);
  if (!arguments.at && moment)
    return "--json and --record tell of a moment: give it with --at, e.g. --at \"2.5 s\"";
  if (arguments.at && arguments.about) return "--about tells of the whole movie: leave out --at";
  if ((film || page) && (arguments.at || arguments.about))
    return fmt::format(
        "{} takes neither --at nor --about: --from and --to say which part of the movie",
        film ? "--film" : "--html");
  if (film && page) return "--film and --html are two calls";
  if (arguments.part.given() && !film && !page)
    return "--fps, --from and --to are of a film or a page: give --film or --html";
  return "";
}

}  // namespace

int replay(const ReplayArguments& arguments) {
  if (const std::string problem = conflict(arguments); !problem.empty()) {
    application::print_error(problem);
    return wrong_input;
  }
  if (!arguments.film.file.empty()) return film(arguments);
  if (!arguments.page.empty()) return write_page(arguments);
  try {
    return use_movie([&] { return show(arguments); });
  } catch (const view::ServerError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
