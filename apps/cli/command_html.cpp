// replay --html: a movie inside the page that shows it.
#include <fmt/format.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/movie_part.h"
#include "apps/view/page_bundle.h"
#include "apps/view/session/recording.h"
#include "output/files/file.h"
#include "output/files/progress.h"

namespace hookpoint::cli {
namespace {

int write(const ReplayArguments& arguments) {
  MovieWindows windows(arguments.movie, arguments.consent);
  view::RecordingRequest request;
  request.steps = steps_of(arguments.part, rate_of(arguments.part), windows);
  request.describe = [&](const std::vector<simulation::Port>& ports) {
    return windows.show(ports);
  };
  request.further = arguments.record;
  const InterruptGuard guard;
  output::Progress progress("page", request.steps.size());
  request.go_on = [&] {
    progress.advance();
    return !guard.stop();
  };
  const std::string page = view::recording_page(windows.movie(), page_bundle::index_html, request);
  if (page.empty()) return guard.status();
  output::write_file(arguments.page, page);
  std::cerr << fmt::format("wrote {}\n", arguments.page.string());
  return fine;
}

}  // namespace

int write_page(const ReplayArguments& arguments) {
  return use_movie([&] {
    try {
      return write(arguments);
    } catch (const view::FilmError& error) {
      application::print_error(error.what());
      return static_cast<int>(wrong_input);
    }
  });
}

}  // namespace hookpoint::cli
