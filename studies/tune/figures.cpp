#include "studies/tune/figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "output/figures/bar_chart.h"
#include "output/figures/plot.h"
#include "studies/results/statistics.h"

namespace hookpoint::studies {
namespace {

using output::Axis;
using output::Plot;
using output::Series;

/// Colours that mean the same in every figure.
enum TuneStyle : int {
  tuned_style = 0,
  own_style = 1,
  analytic_style = 2,
  front_style = 3,
  candidate_style = 7
};

/// "foot_slip" as a reader says it.
std::string with_blanks(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string label_text(const TunePlan& plan, const ObjectivePlan& objective) {
  return with_blanks(plan.label_of(objective));
}

Axis axis_of(const TunePlan& plan, const ObjectivePlan& objective) {
  return {.label = label_text(plan, objective), .unit = plan.unit_of(objective)};
}

/// The metric that an objective is of, mean over the seeds.
std::optional<double> metric_of(const ObjectivePlan& objective, const Candidate& candidate) {
  if (!objective.target) return value_of(objective, candidate);
  const auto values = values_of_seeds(candidate, objective.metric);
  return values ? std::optional(mean(*values)) : std::nullopt;
}

/// A logarithmic axis where positive values reach over more than two decades.
void choose_scale(Axis& axis, const std::vector<double>& values) {
  constexpr double two_decades = 100.;
  if (values.empty()) return;
  const auto [least, greatest] = std::ranges::minmax(values);
  axis.logarithmic = least > 0. && greatest > two_decades * least;
}

int style_of(const TuneReference& reference) {
  return reference.key == "own" ? own_style : analytic_style;
}

Series points_of(const std::string& label, int style) {
  Series series{label, style, {}, {}, {}};
  series.scattered = true;
  return series;
}

void add_point(output::Curve& curve, double x, double y) {
  curve.x.push_back(x);
  curve.y.push_back(y);
}

std::string front_name(const TunePlan& plan, std::size_t other) {
  return "pareto_front" + (other == 1 ? "" : "_" + plan.name_of(plan.objectives[other]));
}

/// The first objective and another one of every feasible candidate of the search.
Plot front_figure(const TunePlan& plan, const TuneResult& result, std::size_t other) {
  const ObjectivePlan &one = plan.objectives[0], &two = plan.objectives[other];
  Plot plot;
  plot.name = front_name(plan, other);
  plot.title = label_text(plan, one) + " and " + label_text(plan, two);
  plot.x = axis_of(plan, one);
  plot.y = axis_of(plan, two);
  Series all = points_of("candidates", candidate_style);
  Series front = points_of("Pareto set", front_style);
  front.scattered = plan.objectives.size() > 2;
  const auto add = [&](Series& series, std::size_t index) {
    const auto x = value_of(one, result.candidates[index]);
    const auto y = value_of(two, result.candidates[index]);
    if (x && y) add_point(series.measured, *x, *y);
  };
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    const bool searched = result.candidates[i].stage == CandidateStage::search;
    if (searched && is_feasible(plan, result.candidates[i])) add(all, i);
  }
  for (const std::size_t member : result.pareto) add(front, member);
  plot.series = {std::move(all), std::move(front)};
  for (const TuneReference& reference : result.references) {
    plot.series.push_back(points_of(reference.name, style_of(reference)));
    add(plot.series.back(), reference.candidate);
  }
  plot.series.push_back(points_of("recommended", tuned_style));
  add(plot.series.back(), result.recommended->candidate);
  std::vector<double> x, y;
  for (const Series& series : plot.series) {
    x.insert(x.end(), series.measured.x.begin(), series.measured.x.end());
    y.insert(y.end(), series.measured.y.begin(), series.measured.y.end());
  }
  choose_scale(plot.x, x);
  choose_scale(plot.y, y);
  std::erase_if(plot.series, [](const Series& series) { return series.measured.x.empty(); });
  return plot;
}

std::string convergence_name(const TunePlan& plan, const ObjectivePlan& objective) {
  return "convergence_" + plan.name_of(objective);
}

/// The best feasible value up to each generation, with the references beside it.
Plot convergence_figure(const TunePlan& plan, const TuneResult& result,
                        const ObjectivePlan& objective) {
  std::map<int, double> best;  // by generation
  const auto better = [&](double a, double b) { return objective.maximise ? a > b : a < b; };
  for (const Candidate& candidate : result.candidates) {
    if (candidate.stage != CandidateStage::search || !is_feasible(plan, candidate)) continue;
    const auto value = value_of(objective, candidate);
    if (!value) continue;
    const auto [entry, is_new] = best.try_emplace(candidate.generation, *value);
    if (!is_new && better(*value, entry->second)) entry->second = *value;
  }
  Plot plot;
  plot.name = convergence_name(plan, objective);
  plot.title = std::string(objective.target ? "The least " : "The best ") +
               label_text(plan, objective) + " so far";
  plot.x = {.label = "generation", .unit = ""};
  plot.y = axis_of(plan, objective);
  Series found{"best of the search", tuned_style, {}, {}, {}};
  std::optional<double> so_far;
  for (const auto& [generation, value] : best) {
    if (!so_far || better(value, *so_far)) so_far = value;
    add_point(found.measured, generation, *so_far);
  }
  if (found.measured.x.empty()) return plot;
  plot.series.push_back(std::move(found));
  for (const TuneReference& reference : result.references) {
    const auto value = value_of(objective, result.candidates[reference.candidate]);
    if (!value) continue;
    Series line{reference.name, style_of(reference), {}, {}, {}};
    for (const double generation : {best.begin()->first, best.rbegin()->first})
      add_point(line.measured, generation, *value);
    plot.series.push_back(std::move(line));
  }
  std::vector<double> values;
  for (const Series& series : plot.series)
    values.insert(values.end(), series.measured.y.begin(), series.measured.y.end());
  choose_scale(plot.y, values);
  return plot;
}

std::string one_at_a_time_name(const TunePlan& plan, const ObjectivePlan& objective) {
  return "one_at_a_time_" + plan.name_of(objective);
}

Plot one_at_a_time_figure(const TunePlan& plan, const TuneResult& result,
                          const ObjectivePlan& objective) {
  Plot plot;
  plot.name = one_at_a_time_name(plan, objective);
  plot.title = with_blanks(plan.name_of(objective)) + ", one constant at a time";
  plot.subtitle = "the others as recommended";
  plot.x = {.label = "place in the constant's range, 0 least, 1 greatest", .unit = ""};
  plot.y = {.label = with_blanks(plan.name_of(objective)), .unit = plan.unit_of(objective)};
  std::vector<double> all;
  for (std::size_t i = 0; i < result.one_at_a_time.size(); ++i) {
    const OneAtATime& one = result.one_at_a_time[i];
    Series series{with_blanks(plan.varied[i].name), static_cast<int>(i), {}, {}, {}};
    for (std::size_t k = 0; k < one.shares.size(); ++k) {
      const auto value = metric_of(objective, result.candidates[one.candidates[k]]);
      if (value) {
        add_point(series.measured, one.shares[k], *value);
        all.push_back(*value);
      } else {
        series.unfinished.push_back(one.shares[k]);
      }
    }
    plot.series.push_back(std::move(series));
  }
  if (objective.target && !plot.series.empty()) {
    Series line{"target", 0, {}, {{0., 1.}, {*objective.target, *objective.target}}, {}};
    line.reference = true;
    plot.series.push_back(std::move(line));
    all.push_back(*objective.target);
  }
  choose_scale(plot.y, all);
  return plot;
}

constexpr const char* indices_name = "sobol_indices";
constexpr const char* depth_name = "depth_over_time";

void add_bar(output::BarSeries& bars, double value, const IndexInterval& interval) {
  bars.values.push_back(value);
  bars.low.push_back(interval.low);
  bars.high.push_back(interval.high);
}

output::BarChart indices_figure(const TunePlan& plan, const TuneResult& result) {
  output::BarChart chart;
  chart.name = indices_name;
  chart.title = "What part of an objective's variance each constant explains";
  chart.subtitle = "thin bars: 95 % intervals";
  chart.value = {.label = "Sobol index", .unit = ""};
  chart.series = {{"alone (first order)", tuned_style, {}},
                  {"in all (total order)", front_style, {}}};
  for (std::size_t i = 0; i < result.indices.size(); ++i) {
    if (!result.indices[i]) continue;
    for (std::size_t c = 0; c < plan.varied.size(); ++c) {
      chart.groups.push_back(label_text(plan, plan.objectives[i]) + ": " +
                             with_blanks(plan.varied[c].name));
      const SobolIndices& indices = *result.indices[i];
      add_bar(chart.series[0], indices.first[c], indices.first_interval[c]);
      add_bar(chart.series[1], indices.total[c], indices.total_interval[c]);
    }
  }
  return chart;
}

Plot depth_figure(const TuneResult& result) {
  Plot plot;
  plot.name = depth_name;
  plot.title = "How deep the robot stands in the ground";
  plot.subtitle = "deepest point, the first seed's run";
  plot.x = {.label = "time", .unit = "s"};
  plot.y = {.label = "depth", .unit = "mm"};
  constexpr double millimetres = 1e3;
  const int styles[] = {tuned_style, own_style, analytic_style};
  for (std::size_t i = 0; i < result.depths.size(); ++i) {
    Series series{result.depths[i].name, styles[i], {}, {}, {}};
    const Trace& trace = result.depths[i].trace;
    for (std::size_t k = 0; k < trace.time.size(); ++k)
      if (std::isfinite(trace.value[k]))
        add_point(series.measured, trace.time[k], millimetres * trace.value[k]);
    if (!series.measured.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Draws what has something in it.
class FigureList {
 public:
  explicit FigureList(const std::filesystem::path& folder) : folder_(folder) {}

  void add(const Plot& plot, const std::string& caption) {
    if (plot.series.empty()) return;
    keep(plot.name, caption, output::draw(plot, folder_));
  }
  void add(const output::BarChart& chart, const std::string& caption) {
    if (chart.groups.empty()) return;
    keep(chart.name, caption, output::draw(chart, folder_));
  }
  std::vector<ReportFigure> take() { return std::move(figures_); }

 private:
  void keep(const std::string& name, const std::string& caption, const output::PlotOutcome& drawn) {
    figures_.push_back({name, caption, drawn.svg, drawn.message});
  }
  const std::filesystem::path& folder_;
  std::vector<ReportFigure> figures_;
};

}  // namespace

std::vector<std::string> tune_figure_names(const TunePlan& plan) {
  std::vector<std::string> names{indices_name, depth_name};
  for (std::size_t i = 1; i < plan.objectives.size(); ++i) names.push_back(front_name(plan, i));
  for (const ObjectivePlan& objective : plan.objectives) {
    names.push_back(convergence_name(plan, objective));
    names.push_back(one_at_a_time_name(plan, objective));
  }
  return names;
}

std::vector<ReportFigure> draw_tune_figures(const TunePlan& plan, const TuneResult& result,
                                            const std::filesystem::path& folder) {
  FigureList figures(folder);
  if (!result.recommended) return {};
  for (std::size_t i = 1; i < plan.objectives.size(); ++i)
    figures.add(front_figure(plan, result, i),
                "Every candidate of the search that meets the requirements, and of them the "
                "Pareto set: those that no other is as good as in every objective and better "
                "than in one. A reference that misses a requirement is drawn all the same.");
  figures.add(depth_figure(result),
              "What the constants do: depth of the deepest boundary point over time with the "
              "recommended constants, the file's own and the analytic guess.");
  for (const ObjectivePlan& objective : plan.objectives)
    figures.add(one_at_a_time_figure(plan, result, objective),
                "One constant at a time over its whole range, on the scale on which it is "
                "searched; means over the seeds. A cross: a run that gave no value." +
                    std::string(objective.target ? " Black, dashed: the target." : ""));
  if (!result.indices.empty())
    figures.add(indices_figure(plan, result),
                "Sobol's indices over the whole box. First order: the part of the variance that "
                "goes if the constant were known. Total order: the part that stays if all others "
                "were; where it is larger, the constant acts together with others. Thin bars: 95 % "
                "intervals by a bootstrap over the samples.");
  for (const ObjectivePlan& objective : plan.objectives)
    figures.add(convergence_figure(plan, result, objective),
                "The best value of a candidate that meets the requirements, generation by "
                "generation.");
  return figures.take();
}

}  // namespace hookpoint::studies
