#include <array>

#include "output/plot.h"

namespace hookpoint::output {

SeriesStyle series_style(int style) {
  // Seven hues of Okabe and Ito's palette that stand out on white and on black, and Tol's wine.
  // Neighbours in the list differ in lightness too, so that a grey print keeps them apart.
  constexpr std::array<const char*, 8> colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                 "#56B4E9", "#E69F00", "#AA3377", "#7F7F7F"};
  // Circle, square, triangle, diamond, pentagon: five and eight have no common factor, so pairs
  // repeat after forty only.
  constexpr std::array<int, 5> markers = {7, 5, 9, 13, 15};
  constexpr std::array<const char*, 4> dashes = {"solid", "'_.'", "'.. '", "'_..'"};
  const auto number = static_cast<std::size_t>(style);
  const int marker = markers[number % markers.size()];
  return {.color = colors[number % colors.size()],
          .filled_marker = marker,
          .hollow_marker = marker - 1,
          .dash = dashes[number / colors.size() % dashes.size()]};
}

}  // namespace hookpoint::output
