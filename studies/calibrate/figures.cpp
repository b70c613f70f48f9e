#include "studies/calibrate/figures.h"

#include <algorithm>

#include "output/figures/plot.h"
#include "studies/measurements/trace_residual.h"

namespace hookpoint::studies {
namespace {

using output::Plot;
using output::Series;

/// More points than a figure has room for are thinned.
constexpr std::size_t most_points = 200;

/// A trace with the index of its first sample among all.
struct PlacedTrace {
  const TracePlan* trace = nullptr;
  std::size_t first = 0;
};

std::vector<PlacedTrace> drawn_traces(const CalibrationPlan& plan) {
  std::vector<PlacedTrace> traces;
  std::size_t first = 0;
  for (const CalibrationCase& one : plan.cases) {
    for (const TracePlan& trace : one.traces) {
      if (traces.size() < most_trace_figures) traces.push_back({&trace, first});
      first += trace.residuals();
    }
  }
  return traces;
}

std::string curve_name(const TracePlan& trace) { return "trace_" + trace.name; }
std::string rest_name(const TracePlan& trace) { return "residuals_" + trace.name; }

/// What was measured is grey, and no subject is.
constexpr int measured_style = output::grey_style + 2 * output::style_colors;

int subject_style(std::size_t subject) {
  constexpr int others = output::style_colors - 1;
  const int number = static_cast<int>(subject), color = number % others;
  return color + (color < output::grey_style ? 0 : 1) + output::style_colors * (number / others);
}

/// The value of a sample from the trace's residuals.
using SampleValue = double (*)(const TracePlan&, std::size_t sample, std::span<const double>);

double measured_value(const TracePlan& trace, std::size_t sample, std::span<const double>) {
  return measured(trace, sample).front();
}
double modelled_value(const TracePlan& trace, std::size_t sample,
                      std::span<const double> residuals) {
  return modelled(trace, sample, residuals).front();
}
double residual(const TracePlan& /*trace*/, std::size_t sample, std::span<const double> residuals) {
  return residuals[sample];
}

bool has_parts(const TracePlan& trace) { return trace.parts.size() > 1; }

output::Curve curve_of(const TracePlan& trace, std::span<const double> residuals,
                       SampleValue value) {
  const std::size_t count = trace.measured.time.size();
  const std::size_t stride = (count + most_points - 1) / most_points;
  output::Curve curve;
  for (std::size_t i = 0; i < count; i += stride) {
    curve.x.push_back(trace.measured.time[i]);
    curve.y.push_back(value(trace, i, residuals));
  }
  return curve;
}

void add_subjects(Plot& plot, const CalibrationPlan& plan, const CalibrationResult& result,
                  const PlacedTrace& placed, SampleValue value) {
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    const auto residuals = residuals_of(result.subjects[i].residuals, *placed.trace, placed.first);
    if (residuals.empty()) continue;
    Series series{plan.subjects[i].info.name, subject_style(i), {}, {}, {}};
    // Their points are samples of one run: a line.
    series.measured = curve_of(*placed.trace, residuals, value);
    plot.series.push_back(std::move(series));
  }
}

/// Of a vector or an orientation the first part.
Plot curve_figure(const CalibrationPlan& plan, const CalibrationResult& result,
                  const PlacedTrace& placed) {
  const TracePlan& trace = *placed.trace;
  Plot plot;
  plot.name = curve_name(trace);
  plot.title = trace.name + ": measured and calibrated";
  plot.x = {.label = "time", .unit = "s"};
  plot.y = {.label = trace.parts.front(), .unit = trace.port_unit};
  Series points{"measured", measured_style, {}, {}, {}};
  points.measured = curve_of(trace, {}, measured_value);
  points.scattered = true;
  plot.series.push_back(std::move(points));
  add_subjects(plot, plan, result, placed, modelled_value);
  return plot;
}

/// Of a vector or an orientation the length of the difference.
Plot rest_figure(const CalibrationPlan& plan, const CalibrationResult& result,
                 const PlacedTrace& placed) {
  const bool length = has_parts(*placed.trace);
  Plot plot;
  plot.name = rest_name(*placed.trace);
  plot.title = placed.trace->name + ": what the fits leave";
  plot.x = {.label = "time", .unit = "s"};
  plot.y = {.label = length ? "distance of model and measured, times weight"
                            : "model less measured, times weight",
            .unit = ""};
  add_subjects(plot, plan, result, placed, length ? distance : residual);
  return plot;
}

ReportFigure drawn(const Plot& plot, std::string caption, const std::filesystem::path& folder) {
  output::PlotOutcome outcome = output::draw(plot, folder);
  return {plot.name, std::move(caption), std::move(outcome.svg), std::move(outcome.message)};
}

}  // namespace

std::vector<std::string> calibration_figure_names(const CalibrationPlan& plan) {
  std::vector<std::string> names;
  for (const PlacedTrace& placed : drawn_traces(plan)) {
    names.push_back(curve_name(*placed.trace));
    names.push_back(rest_name(*placed.trace));
  }
  return names;
}

std::vector<ReportFigure> draw_calibration_figures(const CalibrationPlan& plan,
                                                   const CalibrationResult& result,
                                                   const std::filesystem::path& folder) {
  std::vector<ReportFigure> figures;
  const bool any = std::ranges::any_of(
      result.subjects, [](const SubjectCalibration& found) { return !found.residuals.empty(); });
  if (!any) return figures;
  for (const PlacedTrace& placed : drawn_traces(plan)) {
    const TracePlan& trace = *placed.trace;
    figures.push_back(drawn(curve_figure(plan, result, placed),
                            "The samples of " + trace.column +
                                " and each subject's run with its own "
                                "calibrated constants.",
                            folder));
    // A case that no fold holds out has been predicted by none.
    const Plot rest = rest_figure(plan, result, placed);
    if (rest.series.empty()) continue;
    figures.push_back(drawn(rest,
                            "Residuals: of a model that fits, noise of size 1 without a "
                            "pattern, where the weight is 1 over the noise.",
                            folder));
  }
  return figures;
}

}  // namespace hookpoint::studies
