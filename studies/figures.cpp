#include "studies/figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "output/number.h"
#include "studies/figure_parts.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t thinned_buckets = 400;

/// A series is a subject, or with `series = <sweep>` a subject at one value of that sweep.
struct SeriesKey {
  int subject = 0;
  int value = 0;
  auto operator<=>(const SeriesKey&) const = default;
};

SeriesKey key_of(const StudyResult& study, const PlotSpec& spec, const RunResult& row) {
  const auto sweep = sweep_index(study, spec.series);
  if (!sweep) return {row.subject, 0};
  const auto& values = study.sweeps[*sweep].values;
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](double v) { return same(v, row.parameters[*sweep]); });
  return {row.subject, static_cast<int>(found - values.begin())};
}

/// "impulse", or "impulse, 3 mm/s" where a sweep tells curves apart.
std::string series_label(const StudyResult& study, const PlotSpec& spec, const SeriesKey& key) {
  const std::string& subject = study.subjects[static_cast<std::size_t>(key.subject)].name;
  const auto sweep = sweep_index(study, spec.series);
  if (!sweep) return subject;
  const SweepColumn& column = study.sweeps[*sweep];
  std::string value = output::rounded(column.values[static_cast<std::size_t>(key.value)], 6);
  if (!column.unit.empty()) value += " " + column.unit;
  return study.subjects.size() > 1 ? subject + ", " + value : value;
}

/// A subject's own; for one at several values of a sweep its colour, with a marker a value. A
/// single subject leaves the colours to the values.
int series_style(const StudyResult& study, const PlotSpec& spec, const SeriesKey& key) {
  if (!sweep_index(study, spec.series))
    return subject_styles(study)[static_cast<std::size_t>(key.subject)];
  if (study.subjects.size() == 1) return key.value;
  const int color = subject_styles(study)[static_cast<std::size_t>(key.subject)];
  return color % output::style_colors + output::style_colors * key.value;
}

/// Least and largest value of each bucket along x, in their order: what a line of this width can
/// show.
output::Curve thin(const output::Curve& curve, bool logarithmic) {
  if (curve.x.size() <= 2 * thinned_buckets) return curve;
  const auto place = [&](double x) { return logarithmic ? std::log(std::max(x, 1e-300)) : x; };
  const std::size_t start = logarithmic && curve.x.front() <= 0. ? 1 : 0;
  const double low = place(curve.x[start]);
  const double width = (place(curve.x.back()) - low) / static_cast<double>(thinned_buckets);
  output::Curve thinned;
  const auto keep = [&](std::size_t i) {
    thinned.x.push_back(curve.x[i]);
    thinned.y.push_back(curve.y[i]);
  };
  for (std::size_t begin = 0; begin < curve.x.size();) {
    const double bucket = std::floor((place(curve.x[begin]) - low) / width);
    std::size_t end = begin, least = begin, largest = begin;
    for (; end < curve.x.size() && std::floor((place(curve.x[end]) - low) / width) == bucket;
         ++end) {
      if (curve.y[end] < curve.y[least]) least = end;
      if (curve.y[end] > curve.y[largest]) largest = end;
    }
    keep(std::min(least, largest));
    if (least != largest) keep(std::max(least, largest));
    begin = end;
  }
  return thinned;
}

/// Points of one series while rows are read; by x, the largest magnitude wins.
struct Gathered {
  std::map<double, MetricValue> points;
  std::vector<double> unfinished;
  const RunResult* curve_of = nullptr;  ///< over time: the row whose curve goes farthest
  double reach = -1.;
};

void gather_point(Gathered& series, double x, const RunResult& row, std::size_t metric) {
  const MetricValue& value = row.metrics[metric];
  if (!value.measured || !std::isfinite(*value.measured)) {
    if (outcome_of(row) == RunOutcome::stopped) series.unfinished.push_back(x);
    return;
  }
  const auto [place, fresh] = series.points.try_emplace(x, value);
  if (!fresh && std::abs(*value.measured) > std::abs(*place->second.measured))
    place->second = value;
}

void gather_curve(Gathered& series, const RunResult& row, std::size_t plot) {
  if (plot >= row.traces.size()) return;
  double reach = 0.;
  for (const double value : row.traces[plot].value)
    if (std::isfinite(value)) reach = std::max(reach, std::abs(value));
  if (row.traces[plot].time.empty() || reach <= series.reach) return;
  series.curve_of = &row;
  series.reach = reach;
}

/// On a logarithmic axis without the sample at time 0, which is zero by definition.
output::Curve finite_part(const Trace& trace, bool logarithmic) {
  output::Curve curve;
  const bool from_zero = logarithmic && !trace.value.empty() && trace.value.front() == 0.;
  for (std::size_t i = from_zero ? 1 : 0; i < trace.time.size(); ++i) {
    if (!std::isfinite(trace.value[i])) continue;
    curve.x.push_back(trace.time[i]);
    curve.y.push_back(trace.value[i]);
  }
  return curve;
}

void fill(output::Series& series, const Gathered& gathered, const PlotSpec& spec,
          std::size_t plot) {
  series.unfinished = gathered.unfinished;
  if (gathered.curve_of != nullptr) {
    const Trace& trace = gathered.curve_of->traces[plot];
    series.measured = thin(finite_part(trace, spec.log_y), spec.log_x);
    if (outcome_of(*gathered.curve_of) == RunOutcome::stopped)
      series.unfinished.push_back(trace.time.back());
  }
  for (const auto& [x, value] : gathered.points) {
    series.measured.x.push_back(x);
    series.measured.y.push_back(*value.measured);
    if (!spec.show_predicted || !value.predicted) continue;
    series.predicted.x.push_back(x);
    series.predicted.y.push_back(*value.predicted);
  }
}

std::string caption_of(const StudyResult& study, const PlotSpec& spec, const output::Plot& plot) {
  std::string caption = plot.title + (plot.subtitle.empty() ? "." : " (" + plot.subtitle + ").");
  const bool predicted =
      std::any_of(plot.series.begin(), plot.series.end(),
                  [](const auto& series) { return !series.predicted.x.empty(); });
  if (predicted) caption += " Markers: measured; dashed: closed form.";
  if (spec.x == "time" && !undecided(study, spec).empty())
    caption +=
        " Of the runs that differ in " + undecided(study, spec) + ", the one that goes farthest.";
  const bool vanishing =
      std::any_of(plot.series.begin(), plot.series.end(), [&](const output::Series& series) {
        return std::any_of(series.measured.y.begin(), series.measured.y.end(),
                           [&](double y) { return std::abs(y) <= plot.y.floor; });
      });
  if (plot.y.logarithmic && vanishing)
    caption += " In the grey strip: at most " + output::rounded(plot.y.floor, 2) + " " +
               plot.y.unit + ", which is round-off.";
  if (spec.x == "time" && spec.log_y) caption += " The zero at time 0 is not drawn.";
  std::string absent;
  for (const SubjectInfo& subject : study.subjects)
    if (!subject.available) absent += (absent.empty() ? "" : ", ") + subject.name;
  if (!absent.empty()) caption += " Not on this machine: " + absent + ".";
  return caption;
}

}  // namespace

std::vector<int> subject_styles(const StudyResult& study) {
  std::vector<std::string> families;
  std::vector<int> members(output::style_colors, 0);
  std::vector<int> styles;
  const bool one_law = std::all_of(
      study.subjects.begin(), study.subjects.end(), [&](const SubjectInfo& subject) {
        return !subject.law.empty() && subject.law == study.subjects.front().law;
      });
  for (const SubjectInfo& subject : study.subjects) {
    const std::string& family = one_law               ? subject.integrator
                                : subject.law.empty() ? subject.engine
                                                      : subject.law;
    const auto place = std::find(families.begin(), families.end(), family);
    const auto color = (place - families.begin()) % output::style_colors;
    if (place == families.end()) families.push_back(family);
    int& member = members[static_cast<std::size_t>(color)];
    styles.push_back(static_cast<int>(color) + output::style_colors * member++);
  }
  return styles;
}

Figure make_figure(const StudyResult& study, std::size_t plot) {
  const PlotSpec& spec = study.plots[plot];
  if (!spec.color.empty()) return make_map(study, spec);
  const auto x = sweep_index(study, spec.x);
  const auto y = metric_index(study, spec.y);
  const auto cost = x ? std::nullopt : metric_index(study, spec.x);
  std::map<SeriesKey, Gathered> gathered;
  for (const RunResult& row : study.rows) {
    if (!selected(study, spec, row)) continue;
    Gathered& series = gathered[key_of(study, spec, row)];
    if (spec.x == "time") {
      gather_curve(series, row, plot);
    } else if (x && y && *y < row.metrics.size()) {
      gather_point(series, row.parameters[*x], row, *y);
    } else if (cost && y && row.metrics[*cost].measured) {
      gather_point(series, *row.metrics[*cost].measured, row, *y);
    }
  }
  Figure figure;
  figure.plot.name = spec.name;
  figure.plot.title = spec.title.empty() ? spoken(spec.y) + " over " + spoken(spec.x) : spec.title;
  figure.plot.subtitle = fixed_text(study, spec);
  const auto add_note = [&](const std::string& note) {
    figure.plot.subtitle += (figure.plot.subtitle.empty() ? "" : "; ") + note;
  };
  if (sweep_index(study, spec.series)) add_note("curves by " + spoken(spec.series));
  if (x && !undecided(study, spec).empty())
    add_note("largest over " + undecided(study, spec));
  const auto axis = [](const std::string& label, const std::string& name, const std::string& unit,
                       bool logarithmic) {
    return output::Axis{
        .label = label.empty() ? spoken(name) : label, .unit = unit, .logarithmic = logarithmic};
  };
  figure.plot.x = axis(spec.x_label, spec.x, spec.x_unit, spec.log_x);
  figure.plot.y = axis(spec.y_label, spec.y, spec.y_unit, spec.log_y);
  for (const auto& [key, points] : gathered) {
    output::Series series;
    series.label = series_label(study, spec, key);
    series.style = series_style(study, spec, key);
    fill(series, points, spec, plot);
    if (!series.measured.x.empty() || !series.unfinished.empty())
      figure.plot.series.push_back(std::move(series));
  }
  figure.caption = caption_of(study, spec, figure.plot);
  return figure;
}

}  // namespace hookpoint::studies
