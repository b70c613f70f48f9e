#include <array>

#include "output/figures/plot.h"

namespace hookpoint::output {
namespace {

constexpr std::size_t shape_count = style_shapes;

}  // namespace

std::string dash_type(const Dashes& dashes) {
  std::string text;
  for (const int length : dashes) text += (text.empty() ? " dt (" : ",") + std::to_string(length);
  return text.empty() ? text : text + ")";
}

Dashes predicted_dashes() { return {7, 4}; }

Dashes reference_dashes(int style) {
  const std::array<Dashes, 4> all{predicted_dashes(), {2, 3}, {12, 4, 2, 4}, {12, 4, 2, 4, 2, 4}};
  return all[static_cast<std::size_t>(style) % all.size()];
}

int SeriesStyle::filled_marker() const {
  constexpr std::array<int, shape_count> types = {7, 5, 9, 13, 15};
  return types[static_cast<std::size_t>(shape)];
}

SeriesStyle series_style(int style) {
  // Seven hues of Okabe and Ito's palette ("Color universal design", 2008) that stand out on white
  // and on black, and Tol's wine ("Colour schemes", SRON/EPS/TN/09-002, 2021). Neighbours in the
  // list differ in lightness too, so that a grey print keeps them apart. The twelve after them were
  // chosen one by one, as Glasbey et al. do (Color Res. Appl. 32, 2007): each is the one of
  // lightness 38 to 72 that is farthest in CIEDE2000 from all before it, and, as red-green-blind
  // eyes see them (Machado et al. 2009), from those that have the same marker. The least distance
  // of two is 15.
  constexpr std::array<const char*, style_colors> colors = {
      "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#AA3377",
      "#7F7F7F", "#666600", "#6622EE", "#CC0022", "#8888EE", "#22CC00", "#AAAA66",
      "#226666", "#66AAAA", "#AA6666", "#CC44EE", "#6666AA", "#886644"};
  // None is a closed form's.
  const std::array<Dashes, 4> lines{Dashes{}, {2, 3}, {12, 3, 2, 3}, {12, 3, 2, 3, 2, 3}};
  const auto color = static_cast<std::size_t>(style % style_colors);
  const auto variant = static_cast<std::size_t>(style / style_colors);
  // Variants of a colour differ in marker, and so do colours that stand beside each other.
  return {.color = colors[color],
          .shape = static_cast<int>((color + variant) % shape_count),
          .dashes = lines[variant / shape_count % lines.size()]};
}

}  // namespace hookpoint::output
