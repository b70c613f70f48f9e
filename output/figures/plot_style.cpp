#include <array>

#include "output/figures/plot.h"

namespace hookpoint::output {

SeriesStyle series_style(int style) {
  // Seven hues of Okabe and Ito's palette that stand out on white and on black, and Tol's wine.
  // Neighbours in the list differ in lightness too, so that a grey print keeps them apart.
  constexpr std::array<const char*, style_colors> colors = {
      "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#AA3377", "#7F7F7F"};
  // Circle, square, triangle, diamond, pentagon. Variants of a colour differ in marker, and so do
  // colours that stand beside each other.
  constexpr std::array<int, 5> markers = {7, 5, 9, 13, 15};
  const auto color = static_cast<std::size_t>(style % style_colors);
  const auto variant = static_cast<std::size_t>(style / style_colors);
  const int marker = markers[(color + variant) % markers.size()];
  return {.color = colors[color], .filled_marker = marker, .hollow_marker = marker - 1};
}

}  // namespace hookpoint::output
