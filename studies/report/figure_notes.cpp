#include "studies/report/figure_notes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hookpoint::studies {
namespace {

constexpr double marker_width = 0.01;     // of the axis
constexpr double counts_as_zero = 1e-12;  // in the unit of y

/// Where `y` stands on the axis; nothing for what is drawn in the strip below it.
std::optional<double> place_on(const output::Axis& axis, double y) {
  if (!axis.logarithmic) return y;
  if (std::abs(y) <= axis.floor) return std::nullopt;
  return std::log10(std::abs(y));
}

/// From the lowest to the highest point of the panel.
double height_of(const output::Plot& panel) {
  std::vector<double> places;
  for (const output::Series& series : panel.series)
    for (const output::Curve* curve : {&series.measured, &series.predicted})
      for (const double y : curve->y)
        if (const auto place = place_on(panel.y, y)) places.push_back(*place);
  if (places.empty()) return 0.;
  const auto [least, greatest] = std::ranges::minmax(places);
  return greatest - least;
}

/// Values in the strip below a logarithmic axis have a lane a series there: they never coincide.
bool coincide(const output::Plot& panel, const output::Curve& one, const output::Curve& other) {
  if (one.x != other.x) return false;
  const double width = marker_width * height_of(panel);
  for (std::size_t i = 0; i < one.y.size(); ++i) {
    const auto place = place_on(panel.y, one.y[i]), beside = place_on(panel.y, other.y[i]);
    if (!place || !beside || std::abs(*place - *beside) > width) return false;
    if (panel.y.logarithmic && (one.y[i] < 0.) != (other.y[i] < 0.)) return false;
  }
  return true;
}

/// Whether the two series do in every panel, and are drawn in one at least.
bool coincide(const std::vector<output::Plot>& panels, std::size_t one, std::size_t other) {
  const bool drawn = std::ranges::any_of(
      panels, [&](const output::Plot& panel) { return !panel.series[one].measured.x.empty(); });
  return drawn && std::ranges::all_of(panels, [&](const output::Plot& panel) {
           return coincide(panel, panel.series[one].measured, panel.series[other].measured);
         });
}

}  // namespace

std::string coinciding_note(const std::vector<output::Plot>& panels) {
  if (panels.empty()) return "";
  const std::vector<output::Series>& series = panels.front().series;
  std::vector<bool> named(series.size(), false);
  std::string text;
  for (std::size_t one = 0; one < series.size(); ++one) {
    if (named[one] || series[one].reference) continue;
    std::string group = series[one].label;
    bool several = false;
    for (std::size_t other = one + 1; other < series.size(); ++other) {
      if (named[other] || series[other].reference || !coincide(panels, one, other)) continue;
      group += " = " + series[other].label;
      named[other] = several = true;
    }
    if (several) text += (text.empty() ? " Coincide, one marker hides the others: " : "; ") + group;
  }
  return text.empty() ? "" : text + ".";
}

std::string vanishing_note(const PlotSpec& spec, const std::vector<output::Plot>& panels) {
  bool drawn = false;
  for (const output::Plot& panel : panels) {
    for (const output::Series& series : panel.series) {
      if (series.reference) continue;
      drawn = drawn || !series.measured.y.empty();
      if (panel.y.logarithmic || std::ranges::any_of(series.measured.y, [](double y) {
            return std::abs(y) > counts_as_zero;
          }))
        return "";
    }
  }
  if (!drawn) return "";
  const bool along_ground = spec.x == "time" && (spec.y == "displacement" || spec.y == "drift");
  std::string text = " All that is measured here is zero";
  if (along_ground)
    text += ": " + spec.y + " is along the ground, and what goes straight down has none";
  return text + ".";
}

std::string edge_note(const std::vector<output::Plot>& panels) {
  const auto has_no_place = [](const output::Series& series) {
    const auto not_positive = [](double x) { return x <= 0.; };
    return !series.reference && (std::ranges::any_of(series.measured.x, not_positive) ||
                                 std::ranges::any_of(series.unfinished, not_positive));
  };
  for (const output::Plot& panel : panels)
    if (panel.x.logarithmic && std::ranges::any_of(panel.series, has_no_place))
      return " At the left edge: " + panel.x.label +
             " of 0 or less, for which a logarithmic axis has no place.";
  return "";
}

}  // namespace hookpoint::studies
