// Which moments of a movie a film or a page has: --fps, --from and --to.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/movie_windows.h"

namespace hookpoint::cli {

/// Pictures a second. Throws view::FilmError.
double rate_of(const MoviePart& part);

/// From `--from` to `--to`, or all of the movie. Throws view::FilmError.
std::vector<std::int64_t> steps_of(const MoviePart& part, double rate, MovieWindows& windows);

}  // namespace hookpoint::cli
