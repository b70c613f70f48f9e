// Plot blocks: what is drawn over what.
#include <fmt/format.h>

#include <algorithm>

#include "studies/plan/plan_builder.h"
#include "studies/result.h"
#include "studies/summary.h"

namespace hookpoint::studies {

using language::Object;

/// The unit of the sweep that `field` names.
std::string PlanBuilder::sweep_unit(const Object& block, const char* field) {
  const int sweep = sweep_index(block.word(field));
  if (sweep >= 0) return plan_.sweeps[static_cast<std::size_t>(sweep)].column.unit;
  unknown(block.find(field)->position, "Sweep", block.word(field), sweep_names());
  return "";
}

/// The unit of the metric that `field` names and the study measures.
std::string PlanBuilder::metric_unit(const Object& block, const char* field) {
  const std::ptrdiff_t metric = measured_index(block.word(field));
  if (metric >= 0) return plan_.units[static_cast<std::size_t>(metric)].text;
  std::vector<std::string> known = metric_names();
  for (std::string& name : measured_names()) known.push_back(std::move(name));
  unknown(block.find(field)->position, "Measure of this study", block.word(field), known);
  return "";
}

void PlanBuilder::set_time_axes(PlotPlan& plot, const Object& block) {
  PlotSpec& spec = plot.spec;
  spec.x_unit = "s";
  plot.signal = find_signal(spec.y);
  if (plot.signal == nullptr) {
    std::vector<std::string> names;
    for (const SignalDefinition& signal : signal_table()) names.emplace_back(signal.name);
    unknown(block.find("y")->position, "signal", spec.y, names);
    return;
  }
  spec.y_unit = plot.signal->unit;
  if (!plot.signal->since_settle) return;
  spec.x_label = "time since settling";
  spec.y_label = spec.y + " downhill";
}

void PlanBuilder::set_map(PlotSpec& spec, const Object& block) {
  spec.color = block.word("colour");
  spec.color_unit = metric_unit(block, "colour");
  spec.y_unit = sweep_unit(block, "y");
  if (block.find("outline") == nullptr) return;
  spec.outline = block.word("outline");
  metric_unit(block, "outline");
}

void PlanBuilder::set_panels(PlotSpec& spec, const Object& block) {
  if (block.find("panels") == nullptr) return;
  spec.panels = block.find("panels")->words;
  spec.own_axes = block.word("axes") == "own";
  for (const std::string& sweep : spec.panels) {
    if (sweep_index(sweep) < 0)
      unknown(block.find("panels")->position, "Sweep", sweep, sweep_names());
    if (sweep == spec.x || sweep == spec.series)
      diagnostics_.error(block.find("panels")->position,
                         fmt::format("`{}` is already an axis or makes the curves", sweep));
  }
}

void PlanBuilder::set_references(PlotSpec& spec, const Object& block) {
  for (const Object* line : block.children_of("Reference")) {
    const bool titled = line->find("title") != nullptr;
    spec.references.push_back({.label = titled ? line->word("title") : spoken(line->name),
                               .value = number_in(*line, "value", spec.y_unit),
                               .where = plan_.admitted(conditions(*line))});
  }
}

void PlanBuilder::add_plot(const Object& block) {
  PlotPlan plot;
  PlotSpec& spec = plot.spec;
  spec.name = block.name;
  if (std::ranges::find(table_names, spec.name) != table_names.end())
    diagnostics_.error(block.position, fmt::format("the study itself leaves {}.csv; give the Plot "
                                                   "another name",
                                                   spec.name));
  spec.title = block.find("title") != nullptr ? block.word("title") : block.name;
  spec.x = block.word("x");
  spec.y = block.word("y");
  if (block.find("series") != nullptr) spec.series = block.word("series");
  const std::string& scale = block.word("scale");
  spec.log_x = scale == "log_x" || scale == "log_log";
  spec.log_y = scale == "log" || scale == "log_log";
  const bool over_time = spec.x == "time", map = block.find("colour") != nullptr;
  if (map ? over_time : block.find("outline") != nullptr)
    diagnostics_.error(
        block.position,
        "`colour` makes a map, whose x and y are sweeps; `outline` belongs to a map");
  if (over_time) {
    set_time_axes(plot, block);
  } else {
    const bool metric =
        sweep_index(spec.x) < 0 && (measured_index(spec.x) >= 0 || find_metric(spec.x) != nullptr);
    spec.x_unit = metric && !map ? metric_unit(block, "x") : sweep_unit(block, "x");
    if (map)
      set_map(spec, block);
    else
      spec.y_unit = metric_unit(block, "y");
  }
  const int x_sweep = sweep_index(spec.x);
  if (spec.log_x && x_sweep >= 0 &&
      !plan_.sweeps[static_cast<std::size_t>(x_sweep)].column.words.empty())
    diagnostics_.error(block.find("scale")->position,
                       fmt::format("`{}` has words: its axis cannot be logarithmic", spec.x));
  if (spec.series != "subject" && sweep_index(spec.series) < 0)
    unknown(block.find("series")->position, "Sweep", spec.series, sweep_names());
  spec.subjects = named_subjects(block);
  plot.only = conditions(block);
  spec.where = plan_.admitted(plot.only);
  spec.may_be_empty = block.boolean("may_be_empty");
  if (map && (block.find("panels") != nullptr || !block.children_of("Reference").empty()))
    diagnostics_.error(block.position,
                       "a map has a panel a subject: it takes neither `panels` nor Reference");
  if (block.find("floor") != nullptr) spec.floor = number_in(block, "floor", spec.y_unit);
  set_panels(spec, block);
  set_references(spec, block);
  plan_.plots.push_back(std::move(plot));
}

}  // namespace hookpoint::studies
