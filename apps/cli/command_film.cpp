// replay --film: a movie as a film, drawn by a browser without a display.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/headless_browser.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/movie_part.h"
#include "apps/view/page_bundle.h"
#include "apps/view/session/film_session.h"
#include "output/files/progress.h"

namespace hookpoint::cli {
namespace {

using view::Film;
using view::FilmError;
using view::FilmFormat;

constexpr int least_side = 16, greatest_side = 8192;

/// "1280x720".
void read_size(const std::string& text, Film& film) {
  const char *at = text.data(), *end = at + text.size();
  const auto [width_end, width_error] = std::from_chars(at, end, film.width);
  const bool crossed = width_error == std::errc{} && width_end != end && *width_end == 'x';
  const auto [height_end, height_error] =
      crossed ? std::from_chars(width_end + 1, end, film.height) : std::from_chars_result{at, {}};
  const auto fits = [](int side) { return side >= least_side && side <= greatest_side; };
  if (!crossed || height_error != std::errc{} || height_end != end || !fits(film.width) ||
      !fits(film.height))
    throw FilmError(
        fmt::format("--size takes WIDTHxHEIGHT in pixels, from {} to {}, such as "
                    "1280x720; not `{}`",
                    least_side, greatest_side, text));
  const bool video = film.format == FilmFormat::webm || film.format == FilmFormat::mp4;
  if (video && (film.width % 2 != 0 || film.height % 2 != 0))
    throw FilmError(fmt::format("a video's width and height are even numbers, not {}", text));
}

std::string camera_of(const FilmArguments& arguments, MovieWindows& windows) {
  const std::vector<std::string> cameras = windows.cameras();
  if (!arguments.camera) return cameras.front();
  if (std::ranges::find(cameras, *arguments.camera) != cameras.end()) return *arguments.camera;
  throw FilmError(fmt::format("there is no camera `{}`; there {} {}", *arguments.camera,
                              cameras.size() == 1 ? "is" : "are", fmt::join(cameras, ", ")));
}

/// Numbered pictures of an older, longer film would look like the end of this one.
void refuse_other_pictures(const Film& film) {
  std::error_code none;
  const std::filesystem::path next = picture_file(film, film.steps.size());
  if (film.format == FilmFormat::png && std::filesystem::exists(next, none))
    throw FilmError(fmt::format(
        "{} is there already, of a longer film: remove its pictures, or name another folder",
        next.string()));
}

int make(const ReplayArguments& arguments) {
  Film film;
  film.file = arguments.film.file;
  film.format = view::film_format(film.file);
  read_size(arguments.film.size, film);
  film.quality = arguments.film.quality;
  if (arguments.film.bare)
    film.caption.reset();
  else
    film.caption = arguments.film.caption;
  film.rate = rate_of(arguments.part);
  MovieWindows windows(arguments.movie, arguments.consent);
  film.camera = camera_of(arguments.film, windows);
  film.steps = steps_of(arguments.part, film.rate, windows);
  refuse_other_pictures(film);
  find_headless_browser();

  const InterruptGuard guard;
  view::Server server({}, page_bundle::index_html);
  view::Audience audience(server);
  output::Progress progress("film", film.steps.size());
  HeadlessBrowser browser(server.url() + "&film=1", film.width, film.height);
  view::FilmSessionRequest request;
  request.film = film;
  request.describe = [&](const std::vector<simulation::Port>& ports) {
    return windows.show(ports, &film);
  };
  request.lost = [&] {
    const auto said = browser.ended();
    return said ? "the browser has ended by itself; it said: " + *said : std::string();
  };
  request.advance = [&] { progress.advance(); };
  view::FilmSession session(windows.movie(), audience, std::move(request));
  if (!session.run(guard.stop())) return guard.status();
  return fine;
}

}  // namespace

int film(const ReplayArguments& arguments) {
  try {
    const int status = use_movie([&] {
      try {
        return make(arguments);
      } catch (const FilmError& error) {
        application::print_error(error.what());
        return static_cast<int>(wrong_input);
      }
    });
    if (status == fine) std::cerr << fmt::format("wrote {}\n", arguments.film.file.string());
    return status;
  } catch (const BrowserMissing& error) {
    application::print_error(error.what());
  } catch (const view::DrawingError& error) {
    application::print_error(error.what());
  } catch (const view::ServerError& error) {
    application::print_error(error.what());
  }
  return missing;
}

}  // namespace hookpoint::cli
