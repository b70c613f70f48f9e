#include "output/figures/plot_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text/number.h"

namespace hookpoint::output {
namespace {

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

/// Axes end here, so that their spans, ratios and margins stay finite; points beyond lie outside.
constexpr double farthest = 1e300, farthest_logarithmic = 1e150;

void include_all(Extent& extent, const std::vector<double>& values, const Axis& axis) {
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (!axis.logarithmic) {
      extent.include(std::clamp(value, -farthest, farthest));
    } else if (std::abs(value) > axis.floor) {
      extent.include(std::clamp(std::abs(value), 1. / farthest_logarithmic, farthest_logarithmic));
    }
  }
}

/// A step of 1, 2 or 5 times a power of ten that divides `span` into at most `most` parts.
double tick_step(double span, int most) {
  const double coarse = span / most;
  const double power = std::pow(10., std::floor(std::log10(coarse)));
  for (const double factor : {1., 2., 5.})
    if (coarse <= factor * power * (1. + 1e-9)) return factor * power;
  return 10. * power;
}

void add_tick(std::string& list, const std::string& label, double value, bool minor) {
  list += list.empty() ? "" : ", ";
  list += "'" + label + "' " + text::shortest(value) + (minor ? " 1" : "");
}

std::string minus_sign(const std::string& number) {
  return number.front() == '-' ? "−" + number.substr(1) : number;
}

std::string linear_ticks(const Scale& scale) {
  const double step = tick_step(scale.high - scale.low, 7);
  std::string list;
  const auto first = static_cast<long>(std::ceil(scale.low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(scale.high / step + 1e-9));
  for (long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    add_tick(list, minus_sign(text::rounded(value, 6)), value, false);
  }
  return "(" + list + ")";
}

/// A tick under the middle of each name that is drawn.
std::string name_ticks(const Scale& scale, const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto place = static_cast<double>(i);
    if (place < scale.low || place > scale.high) continue;
    list += (list.empty() ? "" : ", ") + gnuplot_quoted(gnuplot_escaped(names[i])) + " " +
            std::to_string(i);
  }
  return "(" + list + ")";
}

std::string decade_label(int decade, bool plain) {
  if (plain) return text::rounded(std::pow(10., decade), 6);
  return "10^{" + minus_sign(std::to_string(decade)) + "}";
}

std::string logarithmic_ticks(const Scale& scale, int most) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low)));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high)));
  const int step = std::max(1, (last - first + most - 1) / most);
  const bool plain = first >= -3 && last <= 3;
  const bool crowded = last - first > 8;
  const bool sparse = std::log10(scale.high / scale.low) < 1.5;
  std::string list;
  for (int decade = first; decade <= last; ++decade) {
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10., decade);
      if (value < scale.low * (1. - 1e-9) || value > scale.high * (1. + 1e-9)) continue;
      if (digit == 1 && decade % step == 0) {
        add_tick(list, decade_label(decade, plain), value, false);
      } else if (sparse && (digit == 2 || digit == 5)) {
        add_tick(list, text::rounded(value, 3), value, false);
      } else if (digit == 1 || !crowded) {
        add_tick(list, "", value, true);
      }
    }
  }
  return "(" + list + ")";
}

void widen(Scale& scale, double margin) {
  if (scale.logarithmic) {
    const double factor = std::pow(scale.high / scale.low, margin);
    scale.low /= factor;
    scale.high *= factor;
  } else {
    const double pad = margin * (scale.high - scale.low);
    scale.low -= pad;
    scale.high += pad;
  }
}

Scale resolve(const Axis& axis, const Extent& extent, bool whole_decades) {
  Scale scale;
  scale.logarithmic = axis.logarithmic;
  scale.floor = axis.floor;
  scale.low = extent.empty() ? 0.1 : extent.low;
  scale.high = extent.empty() ? 1. : extent.high;
  if (axis.logarithmic && whole_decades) {
    scale.low = std::pow(10., std::floor(std::log10(scale.low) + 1e-9));
    scale.high = std::pow(10., std::ceil(std::log10(scale.high) - 1e-9));
  }
  if (scale.low == scale.high) {
    if (axis.logarithmic) {
      scale.low /= 2.;
      scale.high *= 2.;
    } else {
      const double half = scale.low == 0. ? 1. : 0.1 * std::abs(scale.low);
      scale.low -= half;
      scale.high += half;
    }
  }
  if (!(axis.logarithmic && whole_decades)) widen(scale, 0.04);
  return scale;
}

/// Opens room for the strips: shares `below` and `above` of the drawing.
void open_strips(Scale& scale, double below, double above) {
  const double whole = 1. - below - above;
  if (scale.logarithmic) {
    const double span = std::log10(scale.high / scale.low);
    scale.range_low = scale.low * std::pow(10., -span * below / whole);
    scale.range_high = scale.high * std::pow(10., span * above / whole);
  } else {
    const double span = scale.high - scale.low;
    scale.range_low = scale.low - span * below / whole;
    scale.range_high = scale.high + span * above / whole;
  }
}

bool any_below_floor(const Curve& curve, const Axis& axis) {
  return axis.logarithmic && std::any_of(curve.y.begin(), curve.y.end(), [&](double value) {
           return std::abs(value) <= axis.floor;
         });
}

}  // namespace

double Scale::at(double fraction) const {
  return logarithmic ? range_low * std::pow(range_high / range_low, fraction)
                     : range_low + fraction * (range_high - range_low);
}

double Scale::fraction(double value) const {
  return logarithmic ? std::log(value / range_low) / std::log(range_high / range_low)
                     : (value - range_low) / (range_high - range_low);
}

bool Scale::below_floor(double value) const { return logarithmic && std::abs(value) <= floor; }

double strip_height(std::size_t lanes) {
  return lanes == 0 ? 0. : std::min(0.06 + 0.034 * static_cast<double>(lanes - 1), 0.4);
}

double Layout::floor_lane(int lane) const {
  const double count = static_cast<double>(strips.below_floor.size());
  return y.at(strip_height(strips.below_floor.size()) * (1. - (lane + 0.5) / count));
}

double Layout::unfinished_lane(int lane) const {
  const double count = static_cast<double>(strips.unfinished.size());
  return y.at(1. - strip_height(strips.unfinished.size()) * (lane + 0.5) / count);
}

Layout lay_out(const Plot& plot) {
  Layout layout;
  Extent x, y;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    for (const Curve* curve : {&series.measured, &series.predicted}) {
      include_all(x, curve->x, plot.x);
      include_all(y, curve->y, plot.y);
    }
    for (std::size_t k = 0; k < series.half_widths.size(); ++k)
      include_all(y,
                  {series.measured.y[k] - series.half_widths[k],
                   series.measured.y[k] + series.half_widths[k]},
                  plot.y);
    include_all(x, series.unfinished, plot.x);
    if (any_below_floor(series.measured, plot.y) || any_below_floor(series.predicted, plot.y))
      layout.strips.below_floor.push_back(static_cast<int>(i));
    if (!series.unfinished.empty()) layout.strips.unfinished.push_back(static_cast<int>(i));
  }
  layout.x = resolve(plot.x, x, false);
  if (!plot.x.names.empty() && !x.empty()) {
    layout.x.low = x.low - 0.5;
    layout.x.high = x.high + 0.5;
  }
  layout.y = resolve(plot.y, y, true);
  open_strips(layout.x, 0., 0.);
  open_strips(layout.y, strip_height(layout.strips.below_floor.size()),
              strip_height(layout.strips.unfinished.size()));
  layout.x.ticks = !plot.x.names.empty()  ? name_ticks(layout.x, plot.x.names)
                   : layout.x.logarithmic ? logarithmic_ticks(layout.x, 8)
                                          : linear_ticks(layout.x);
  layout.y.ticks = layout.y.logarithmic ? logarithmic_ticks(layout.y, 9) : linear_ticks(layout.y);
  return layout;
}

}  // namespace hookpoint::output
