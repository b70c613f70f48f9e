#include "studies/blocks/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "output/latex/latex.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/subject.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

enum class Axes { same, own };
enum class Scale { linear, log_y, log_x, log_both };

struct PlotBlock {
  Placed<std::string> title, x, y, colour, outline, series;
  Placed<std::vector<std::string>> panels;
  Axes axes = Axes::same;
  Placed<double> floor;
  Placed<std::vector<std::string>> subjects;
  Placed<Scale> scale = Scale::linear;
  bool may_be_empty = false;
};

const Fields<PlotBlock>& plot_fields() {
  static const Fields<PlotBlock> fields{
      text_field("title", &PlotBlock::title, "heading; default: the name"),
      required(words_field("x", 1, &PlotBlock::x,
                           "a sweep, a metric (a curve of cost against error), or time")),
      required(words_field("y", 1, &PlotBlock::y,
                           "a metric; over time a signal: displacement, drift, speed, "
                           "penetration, energy; with `colour` a sweep")),
      words_field("colour", 1, &PlotBlock::colour,
                  "a metric: makes a map over the sweeps x and y, a panel a subject"),
      words_field("outline", 1, &PlotBlock::outline,
                  "in a map: a metric whose closed form draws the line between cells"),
      words_field("series", 1, &PlotBlock::series, "what makes a curve: subject, or a sweep"),
      words_field("panels", 2, &PlotBlock::panels,
                  "a panel for each value of a sweep; of two, the first down, the second across"),
      choice_field("axes", {"same", "own"}, &PlotBlock::axes,
                   "whether panels share the scale of y"),
      positive(number_field("floor", "?", &PlotBlock::floor,
                            "what counts as zero where y is logarithmic; default: 1e-16 of y's "
                            "unit")),
      words_field("subjects", 100, &PlotBlock::subjects, "subjects that are drawn; default: all"),
      choice_field("scale", {"linear", "log", "log_x", "log_log"}, &PlotBlock::scale,
                   "axes that are logarithmic: log is y; of a map log is the colour"),
      may_be_empty_field(&PlotBlock::may_be_empty, "no run of it has a value")};
  return fields;
}

struct ReferenceBlock {
  Placed<std::string> title;
  const language::Field* value = nullptr;
};

const Fields<ReferenceBlock>& reference_fields() {
  static const Fields<ReferenceBlock> fields{
      text_field("title", &ReferenceBlock::title, "in the legend; default: the name"),
      required(number_field("value", "?", &ReferenceBlock::value, "where it stands, in y"))};
  return fields;
}

/// One Plot block.
class PlotLoader {
 public:
  PlotLoader(const Object& object, const StudyParts& so_far, Diagnostics& diagnostics)
      : object_(object),
        block_(load_fields(object, plot_fields())),
        so_far_(so_far),
        diagnostics_(diagnostics) {}

  PlotPlan load() {
    PlotSpec& spec = plot_.spec;
    spec.name = object_.name;
    if (std::ranges::find(table_names, spec.name) != table_names.end())
      error(object_.position,
            fmt::format("the study itself leaves {}.csv; give the Plot another name", spec.name));
    if (std::ranges::find(output::latex_names, spec.name) != output::latex_names.end())
      error(object_.position,
            fmt::format("the study itself leaves {}.tex; give the Plot another name", spec.name));
    spec.title = block_.title.value.value_or(object_.name);
    spec.x = *block_.x;
    spec.y = *block_.y;
    if (block_.series) spec.series = *block_.series;
    spec.log_x = *block_.scale == Scale::log_x || *block_.scale == Scale::log_both;
    spec.log_y = *block_.scale == Scale::log_y || *block_.scale == Scale::log_both;
    set_axes();
    const int x_sweep = so_far_.sweep_index(spec.x);
    if (spec.log_x && x_sweep >= 0 &&
        !so_far_.sweeps[static_cast<std::size_t>(x_sweep)].column.words.empty())
      error(block_.scale.position(),
            fmt::format("`{}` has words: its axis cannot be logarithmic", spec.x));
    if (spec.series != "subject" && so_far_.sweep_index(spec.series) < 0)
      report_unknown(block_.series.position(), "Sweep", spec.series, so_far_.sweep_names(),
                     diagnostics_);
    spec.subjects = named_subjects(block_.subjects.field, so_far_, diagnostics_);
    plot_.only = load_conditions(object_, so_far_, diagnostics_);
    spec.where = so_far_.admitted(plot_.only);
    spec.may_be_empty = block_.may_be_empty;
    if (block_.colour && (block_.panels || !object_.children_of("Reference").empty()))
      error(object_.position,
            "a map has a panel a subject: it takes neither `panels` nor Reference");
    if (block_.floor) spec.floor = number_in(*block_.floor.field, spec.y_unit, diagnostics_);
    set_panels();
    set_references();
    return std::move(plot_);
  }

 private:
  void error(const language::Position& position, std::string message) {
    diagnostics_.error(position, std::move(message));
  }

  void set_axes() {
    PlotSpec& spec = plot_.spec;
    const bool over_time = spec.x == "time", map = block_.colour.given();
    if (map ? over_time : block_.outline.given())
      error(object_.position,
            "`colour` makes a map, whose x and y are sweeps; `outline` belongs to a map");
    if (over_time) return set_time_axes();
    const bool metric = so_far_.sweep_index(spec.x) < 0 &&
                        (so_far_.metric_index(spec.x) >= 0 || find_metric(spec.x) != nullptr);
    spec.x_unit =
        metric && !map ? metric_unit(block_.x, so_far_, diagnostics_) : sweep_unit(block_.x);
    if (map)
      set_map();
    else
      spec.y_unit = metric_unit(block_.y, so_far_, diagnostics_);
  }

  void set_time_axes() {
    PlotSpec& spec = plot_.spec;
    spec.x_unit = "s";
    plot_.signal = find_signal(spec.y);
    if (plot_.signal == nullptr) {
      std::vector<std::string> names;
      for (const SignalDefinition& signal : signal_table()) names.emplace_back(signal.name);
      report_unknown(block_.y.position(), "signal", spec.y, names, diagnostics_);
      return;
    }
    spec.y_unit = plot_.signal->unit;
    if (!plot_.signal->since_settle) return;
    spec.x_label = "time since settling";
    spec.y_label = spec.y + " downhill";
  }

  void set_map() {
    PlotSpec& spec = plot_.spec;
    spec.color = *block_.colour;
    spec.color_unit = metric_unit(block_.colour, so_far_, diagnostics_);
    spec.y_unit = sweep_unit(block_.y);
    if (spec.y == spec.x)
      error(block_.y.position(), fmt::format("`{}` is the axis x already", spec.y));
    if (!block_.outline) return;
    spec.outline = *block_.outline;
    metric_unit(block_.outline, so_far_, diagnostics_);
  }

  /// The unit of the sweep that the field names.
  std::string sweep_unit(const Placed<std::string>& name) {
    const int sweep = so_far_.sweep_index(*name);
    if (sweep >= 0) return so_far_.sweeps[static_cast<std::size_t>(sweep)].column.unit;
    report_unknown(name.position(), "Sweep", *name, so_far_.sweep_names(), diagnostics_);
    return "";
  }

  void set_panels() {
    if (!block_.panels) return;
    PlotSpec& spec = plot_.spec;
    spec.panels = *block_.panels;
    spec.own_axes = block_.axes == Axes::own;
    for (const std::string& sweep : spec.panels) {
      if (so_far_.sweep_index(sweep) < 0)
        report_unknown(block_.panels.position(), "Sweep", sweep, so_far_.sweep_names(),
                       diagnostics_);
      if (sweep == spec.x || sweep == spec.series)
        error(block_.panels.position(),
              fmt::format("`{}` is already an axis or makes the curves", sweep));
    }
  }

  void set_references() {
    for (const Object* line : object_.children_of("Reference")) {
      const ReferenceBlock block = load_fields(*line, reference_fields());
      plot_.spec.references.push_back(
          {.label = block.title ? *block.title : spoken(line->name),
           .value = number_in(*block.value, plot_.spec.y_unit, diagnostics_),
           .where = so_far_.admitted(load_conditions(*line, so_far_, diagnostics_))});
    }
  }

  const Object& object_;
  const PlotBlock block_;
  const StudyParts& so_far_;
  Diagnostics& diagnostics_;
  PlotPlan plot_;
};

}  // namespace

void add_plot_class(language::Schema& schema) {
  language::ClassSchema plot = block_class(
      "Plot",
      "A figure: a metric over a sweep, two sweeps or another metric, or a signal over time.",
      schemas(plot_fields()), {"Only", "Reference"});
  plot.only_in = "Study";
  schema.add(std::move(plot));
}

void add_reference_class(language::Schema& schema) {
  schema.add(block_class("Reference",
                         "A line across a Plot at a value to hold the measured ones against.",
                         schemas(reference_fields()), {"Only"}));
}

PlotPlan load_plot(const Object& block, const StudyParts& so_far, Diagnostics& diagnostics) {
  return PlotLoader(block, so_far, diagnostics).load();
}

}  // namespace hookpoint::studies
