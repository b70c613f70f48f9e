// A movie inside the page that shows it: one file, which a browser opens without the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/view/session/reel.h"
#include "apps/view/session/shown.h"

namespace hookpoint::view {

/// A page above this is refused: browsers read it whole.
inline constexpr std::size_t most_bytes_of_page = std::size_t{256} << 20;

struct RecordingRequest {
  std::vector<std::int64_t> steps;  ///< of its instants
  /// The windows of a world with these ports.
  std::function<Shown(const std::vector<simulation::Port>&)> describe;
  std::vector<std::string> further;  ///< patterns of trails, beside those of the windows
  /// After each instant; false ends the work.
  std::function<bool()> go_on;
};

/// `page` with the movie's instants in it (docs/view_protocol.md#recordings); empty where the work was
/// ended. Throws FilmError where it would be larger than most_bytes_of_page, output::MovieError and
/// simulation::ExperimentError. O(steps of the movie).
std::string recording_page(const ShownMovie& movie, std::string_view page,
                           const RecordingRequest& request);

}  // namespace hookpoint::view
