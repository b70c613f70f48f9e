#include "apps/cli/movie_part.h"

#include <fmt/format.h>

#include <charconv>

#include "apps/view/session/film.h"
#include "text/number.h"

namespace hookpoint::cli {
namespace {

using view::FilmError;

constexpr double greatest_rate = 1000.;
constexpr int most_pictures = 1'000'000;

}  // namespace

double rate_of(const MoviePart& part) {
  const std::string text = part.rate.value_or("30");
  double rate = 0.;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rate);
  if (error != std::errc{} || end != text.data() + text.size() || !(rate > 0.) ||
      rate > greatest_rate)
    throw FilmError(
        fmt::format("--fps takes a number of pictures a second, above 0 and up to {}; not `{}`",
                    greatest_rate, text));
  return rate;
}

std::vector<std::int64_t> steps_of(const MoviePart& part, double rate, MovieWindows& windows) {
  view::Reel reel(windows.movie());
  const double deltat = windows.experiment().deltat;
  const double first = static_cast<double>(reel.first()) * deltat;
  const double last = static_cast<double>(reel.last()) * deltat;
  const auto moment = [&](const std::optional<std::string>& text, const char* option,
                          double otherwise) {
    if (!text) return otherwise;
    const double time = seconds(*text, option);
    if (time >= first - deltat / 2. && time <= last + deltat / 2.) return time;
    throw FilmError(fmt::format("{} is no moment of the movie: it goes from {} s to {} s", option,
                                text::rounded(first, 6), text::rounded(last, 6)));
  };
  const double from = moment(part.from, "--from", first);
  const double to = moment(part.to, "--to", last);
  if (to < from)
    throw FilmError(fmt::format("--to, {} s, lies before --from, {} s", text::rounded(to, 6),
                                text::rounded(from, 6)));
  if (const double pictures = (to - from) * rate; !(pictures <= most_pictures))
    throw FilmError(
        fmt::format("{} pictures are more than a film may have ({}): choose a part with "
                    "--from and --to, or a lower --fps",
                    text::rounded(pictures), most_pictures));
  return view::film_steps(from, to, rate, deltat);
}

}  // namespace hookpoint::cli
