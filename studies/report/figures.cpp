#include "studies/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "studies/report/figure_notes.h"
#include "studies/report/figure_parts.h"
#include "studies/results/seed_means.h"
#include "studies/results/summary.h"
#include "text/number.h"

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
                                  [&](double v) { return same_value(v, row.parameters[*sweep]); });
  return {row.subject, static_cast<int>(found - values.begin())};
}

/// "impulse", or "impulse, 3 mm/s" where a sweep tells curves apart.
std::string series_label(const StudyResult& study, const PlotSpec& spec, const SeriesKey& key) {
  const std::string& subject = study.subjects[static_cast<std::size_t>(key.subject)].name;
  const auto sweep = sweep_index(study, spec.series);
  if (!sweep) return subject;
  const SweepColumn& column = study.sweeps[*sweep];
  std::string value = label_of(column, column.values[static_cast<std::size_t>(key.value)]);
  if (!column.unit.empty()) value += " " + column.unit;
  return study.subjects.size() > 1 ? subject + ", " + value : value;
}

/// The subject's style. Where a series is a subject at one value of a sweep: the subject's colour,
/// its own variant for the first value and for others such as no subject of that colour has; when
/// there is only one subject, a style for the value.
int series_style(const StudyResult& study, const PlotSpec& spec, const SeriesKey& key) {
  const auto sweep = sweep_index(study, spec.series);
  if (sweep && study.subjects.size() == 1) return key.value;
  const std::vector<int> styles = subject_styles(study);
  const int style = styles[static_cast<std::size_t>(key.subject)];
  if (!sweep || key.value == 0) return style;
  const int color = style % output::style_colors, member = style / output::style_colors;
  const auto members = static_cast<int>(std::ranges::count_if(
      styles, [&](int other) { return other % output::style_colors == color; }));
  const int others = static_cast<int>(study.sweeps[*sweep].values.size()) - 1;
  return color + output::style_colors * (members + member * others + key.value - 1);
}

/// The curve cut into buckets along x, each with its least and its largest value: more cannot be
/// seen of a line as wide as a bucket.
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

/// What the rows read so far give one series. Of several values at one x the one of the largest
/// magnitude is kept.
struct Gathered {
  std::map<double, MetricValue> points;
  std::vector<double> unfinished;
  const RunResult* curve_of = nullptr;  ///< over time: the row whose curve goes farthest
  Trace curve;
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
  Trace trace = row.traces[plot].read();
  double reach = 0.;
  for (const double value : trace.value)
    if (std::isfinite(value)) reach = std::max(reach, std::abs(value));
  if (trace.time.empty() || reach <= series.reach) return;
  series.curve_of = &row;
  series.curve = std::move(trace);
  series.reach = reach;
}

/// The finite samples; on a logarithmic axis without that at time 0, whose displacement is zero by
/// definition.
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

void fill(output::Series& series, const Gathered& gathered, const PlotSpec& spec) {
  series.unfinished = gathered.unfinished;
  if (series.unfinished.size() > 2 * thinned_buckets) {
    std::ranges::sort(series.unfinished);
    const auto again = std::unique(series.unfinished.begin(), series.unfinished.end());
    series.unfinished.erase(again, series.unfinished.end());
  }
  if (gathered.curve_of != nullptr) {
    const Trace& trace = gathered.curve;
    series.measured = thin(finite_part(trace, spec.log_y), spec.log_x);
    if (outcome_of(*gathered.curve_of) == RunOutcome::stopped)
      series.unfinished.push_back(trace.time.back());
  }
  for (const auto& [x, value] : gathered.points) {
    series.measured.x.push_back(x);
    series.measured.y.push_back(*value.measured);
    if (value.half_width) series.half_widths.push_back(*value.half_width);
    if (!spec.show_predicted || !value.predicted) continue;
    series.predicted.x.push_back(x);
    series.predicted.y.push_back(*value.predicted);
  }
  if (gathered.points.size() <= 2 * thinned_buckets) return;
  series.half_widths.clear();
  series.measured = thin(series.measured, spec.log_x);
  series.predicted = thin(series.predicted, spec.log_x);
}

using SeriesTable = std::map<SeriesKey, output::Series>;

/// The curves of the rows that `spec` selects: over time, over a sweep, or one metric over another
/// (x). Those with nothing to draw are left out.
SeriesTable series_of(const StudyResult& study, const PlotSpec& spec, std::size_t plot) {
  const auto x = sweep_index(study, spec.x);
  const auto y = metric_index(study, spec.y);
  const auto x_metric = x ? std::nullopt : metric_index(study, spec.x);
  std::map<SeriesKey, Gathered> gathered;
  for (const RunResult& row : study.rows) {
    if (!selected(study, spec, row)) continue;
    Gathered& series = gathered[key_of(study, spec, row)];
    if (spec.x == "time") {
      gather_curve(series, row, plot);
    } else if (x && y && *y < row.metrics.size()) {
      gather_point(series, row.parameters[*x], row, *y);
    } else if (x_metric && y && row.metrics[*x_metric].measured) {
      gather_point(series, *row.metrics[*x_metric].measured, row, *y);
    }
  }
  SeriesTable table;
  for (const auto& [key, points] : gathered) {
    output::Series series;
    series.label = series_label(study, spec, key);
    series.style = series_style(study, spec, key);
    series.scattered = x && !study.sweeps[*x].words.empty();
    fill(series, points, spec);
    if (!series.measured.x.empty() || !series.unfinished.empty()) table.emplace(key, series);
  }
  return table;
}

/// The figure of the block without its curves: names, subtitle, axes.
output::Plot axes_of(const StudyResult& study, const PlotSpec& spec) {
  output::Plot plot;
  plot.name = spec.name;
  plot.title = spec.title.empty() ? spoken(spec.y) + " over " + spoken(spec.x) : spec.title;
  plot.subtitle = fixed_values_text(study, spec);
  const auto add_note = [&](const std::string& note) {
    plot.subtitle += (plot.subtitle.empty() ? "" : "; ") + note;
  };
  if (sweep_index(study, spec.series)) add_note("curves by " + spoken(spec.series));
  if (sweep_index(study, spec.x) && !undecided_sweeps(study, spec).empty())
    add_note("largest over " + undecided_sweeps(study, spec));
  const auto name_or = [](const std::string& label, const std::string& name) {
    return label.empty() ? spoken(name) : label;
  };
  plot.x = {.label = name_or(spec.x_label, spec.x), .unit = spec.x_unit, .logarithmic = spec.log_x};
  if (const auto x = sweep_index(study, spec.x)) plot.x.names = study.sweeps[*x].words;
  plot.y = {.label = name_or(spec.y_label, spec.y),
            .unit = spec.y_unit,
            .logarithmic = spec.log_y,
            .floor = spec.floor};
  return plot;
}

/// Labels of the block's references, each once: the place of one is its style.
std::vector<std::string> reference_labels(const PlotSpec& spec) {
  std::vector<std::string> labels;
  for (const ReferenceLine& reference : spec.references)
    if (std::ranges::find(labels, reference.label) == labels.end())
      labels.push_back(reference.label);
  return labels;
}

/// A horizontal line across the x of all that is drawn; empty where no run of the block has the
/// reference's values.
output::Series reference_line(const StudyResult& study, const PlotSpec& spec,
                              const ReferenceLine& reference, const output::Plot& plot) {
  const std::vector<std::string> labels = reference_labels(spec);
  const auto style = std::ranges::find(labels, reference.label) - labels.begin();
  output::Series line{.label = reference.label,
                      .style = static_cast<int>(style),
                      .measured = {},
                      .predicted = {},
                      .unfinished = {},
                      .reference = true};
  const bool meant = std::ranges::any_of(study.rows, [&](const RunResult& row) {
    return selected(study, spec, row) && admits(study, reference.where, row);
  });
  std::vector<double> drawn;
  for (const output::Series& series : plot.series) {
    drawn.insert(drawn.end(), series.measured.x.begin(), series.measured.x.end());
    drawn.insert(drawn.end(), series.unfinished.begin(), series.unfinished.end());
  }
  if (!meant || drawn.empty()) return line;
  const auto [least, largest] = std::ranges::minmax(drawn);
  line.predicted = {{least, largest}, {reference.value, reference.value}};
  return line;
}

void add_references(output::Plot& plot, const StudyResult& study, const PlotSpec& spec) {
  std::vector<output::Series> lines;
  for (const ReferenceLine& reference : spec.references)
    lines.push_back(reference_line(study, spec, reference, plot));
  plot.series.insert(plot.series.end(), lines.begin(), lines.end());
}

template <class Holds>
bool any_series(const std::vector<output::Plot>& plots, Holds holds) {
  return std::ranges::any_of(
      plots, [&](const output::Plot& plot) { return std::ranges::any_of(plot.series, holds); });
}

std::string caption_of(const StudyResult& study, const PlotSpec& spec, const output::Plot& axes,
                       const std::vector<output::Plot>& plots) {
  std::string caption = axes.title + (axes.subtitle.empty() ? "." : " (" + axes.subtitle + ").");
  if (any_series(plots, [](const output::Series& series) {
        return !series.reference && !series.predicted.x.empty();
      }))
    caption += " Markers: measured; dashed: closed form.";
  if (any_series(plots, [](const output::Series& series) { return !series.half_widths.empty(); }))
    caption += " Bars: the mean's 95 % interval over the seeds (Student's t).";
  else if (study.runs != nullptr)
    caption += " Means over the seeds.";
  constexpr std::array lines{"dashed", "dotted", "dash-dotted", "dash-dot-dotted"};
  const std::vector<std::string> labels = reference_labels(spec);
  for (std::size_t i = 0; i < labels.size(); ++i)
    caption += fmt::format(" Black, {}: {}.", lines[i % lines.size()], labels[i]);
  if (spec.x == "time" && !undecided_sweeps(study, spec).empty())
    caption += " Of the runs that differ in " + undecided_sweeps(study, spec) +
               ", the one that goes farthest.";
  const bool vanishing = any_series(plots, [&](const output::Series& series) {
    return std::ranges::any_of(series.measured.y,
                               [&](double y) { return std::abs(y) <= axes.y.floor; });
  });
  if (axes.y.logarithmic && vanishing)
    caption += " In the grey strip: at most " + text::rounded(axes.y.floor, 2) + " " + axes.y.unit +
               ", which counts as zero.";
  if (spec.x == "time" && spec.log_y) caption += " The zero at time 0 is not drawn.";
  caption += edge_note(plots) + coinciding_note(plots) + vanishing_note(spec, plots);
  std::string absent;
  for (const SubjectInfo& subject : study.subjects)
    if (!subject.available) absent += (absent.empty() ? "" : ", ") + subject.name;
  if (!absent.empty()) caption += " Not on this machine: " + absent + ".";
  return caption;
}

/// One Plot for each panel. Every panel has every series, empty where it has no runs of it, so that
/// one legend and one scale serve all.
std::vector<output::Plot> panel_plots(const StudyResult& study, const PlotSpec& spec,
                                      std::size_t plot) {
  const std::vector<PanelSpec> panels = panel_specs(study, spec);
  std::vector<SeriesTable> tables;
  SeriesTable names;
  for (const PanelSpec& panel : panels) {
    tables.push_back(series_of(study, panel.spec, plot));
    for (const auto& [key, series] : tables.back())
      names.try_emplace(key, output::Series{series.label, series.style, {}, {}, {}});
  }
  std::vector<output::Plot> plots;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    output::Plot panel = axes_of(study, spec);
    panel.title = panels[i].title;
    tables[i].insert(names.begin(), names.end());
    for (const auto& [key, series] : tables[i]) panel.series.push_back(series);
    add_references(panel, study, panels[i].spec);
    plots.push_back(std::move(panel));
  }
  return plots;
}

std::size_t panels_across(const StudyResult& study, const PlotSpec& spec) {
  // Panels of a single sweep go on in the next row.
  constexpr std::size_t most = 3;
  const std::size_t last = drawn_values(study, spec, spec.panels.back()).size();
  return spec.panels.size() > 1 ? last : std::min(last, most);
}

/// What a subject shares its colour with: its law, or the engine of one without a law; its integrator
/// where all have one law; nothing where they have one integrator too.
std::vector<std::string> families_of(const StudyResult& study) {
  const SubjectInfo& first = study.subjects.front();
  const auto all_have = [&](std::string SubjectInfo::*word) {
    return !(first.*word).empty() && std::ranges::all_of(study.subjects, [&](const auto& subject) {
      return subject.*word == first.*word;
    });
  };
  const bool one_law = all_have(&SubjectInfo::law);
  const bool one_integrator = one_law && all_have(&SubjectInfo::integrator);
  std::vector<std::string> families;
  for (const SubjectInfo& subject : study.subjects)
    families.push_back(one_integrator        ? subject.name
                       : one_law             ? subject.integrator
                       : subject.law.empty() ? subject.engine
                                             : subject.law);
  return families;
}

}  // namespace

std::vector<int> subject_styles(const StudyResult& study) {
  // Subjects that have a run come first: the others take no colour from them.
  std::vector<bool> runs(study.subjects.size(), false);
  for (const RunResult& row : study.rows) {
    const auto subject = static_cast<std::size_t>(row.subject);
    runs[subject] = study.subjects[subject].available;
  }
  std::vector<std::size_t> order;
  for (const bool running : {true, false})
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (runs[i] == running) order.push_back(i);
  const std::vector<std::string> families = families_of(study);
  std::vector<std::string> colored;  // families, by the number of their colour
  for (const std::size_t i : order)
    if (std::ranges::find(colored, families[i]) == colored.end()) colored.push_back(families[i]);
  // A family that has more members than there are markers goes on with colours that none has.
  std::vector<int> members(output::style_colors, 0);
  std::vector<int> styles(study.subjects.size(), 0);
  for (const std::size_t i : order) {
    auto color =
        static_cast<std::size_t>(std::ranges::find(colored, families[i]) - colored.begin()) %
        members.size();
    if (members[color] >= output::style_shapes) {
      const auto free = static_cast<std::ptrdiff_t>(std::min(colored.size(), members.size() - 1));
      const auto other = std::ranges::find_if(members.begin() + free, members.end(), [](int count) {
        return count < output::style_shapes;
      });
      if (other != members.end()) color = static_cast<std::size_t>(other - members.begin());
    }
    styles[i] = static_cast<int>(color) + output::style_colors * members[color]++;
  }
  return styles;
}

Figure make_figure(const StudyResult& study, std::size_t plot) {
  if (study.seed_sweep) return make_figure(over_seeds(study), plot);
  const PlotSpec& spec = study.plots[plot];
  if (!spec.color.empty()) return make_map(study, spec);
  Figure figure;
  figure.plot = axes_of(study, spec);
  if (!spec.panels.empty()) {
    figure.panels = {.name = spec.name,
                     .title = figure.plot.title,
                     .subtitle = figure.plot.subtitle,
                     .across = panels_across(study, spec),
                     .own_axes = spec.own_axes,
                     .panels = panel_plots(study, spec, plot)};
    figure.caption = caption_of(study, spec, figure.plot, figure.panels->panels);
    return figure;
  }
  for (auto& [key, series] : series_of(study, spec, plot))
    figure.plot.series.push_back(std::move(series));
  add_references(figure.plot, study, spec);
  std::erase_if(figure.plot.series,
                [](const auto& series) { return series.reference && series.predicted.x.empty(); });
  figure.caption = caption_of(study, spec, figure.plot, {figure.plot});
  return figure;
}

}  // namespace hookpoint::studies
