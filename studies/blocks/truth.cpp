#include "studies/blocks/truth.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "language/names.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/subject.h"
#include "studies/blocks/written_values.h"
#include "text/number.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

enum class Equals { predicted, value };

struct TruthBlock {
  Placed<std::string> metric;
  Placed<Equals> equals;
  Placed<double> value;
  double tolerance = 0.;
  Placed<double> within, above, below;
  Placed<std::string> same_over;
  Placed<std::vector<std::string>> subjects;
  bool may_be_empty = false;
};

const Fields<TruthBlock>& truth_fields() {
  static const Fields<TruthBlock> fields{
      words_field("metric", 1, &TruthBlock::metric, "the metric, where the name is a label"),
      choice_field("equals", {"predicted", "value"}, &TruthBlock::equals,
                   "the closed form, or the number in `value`"),
      number_field("value", "?", &TruthBlock::value, "the number that the metric must equal"),
      not_negative(number_field("tolerance", "", &TruthBlock::tolerance,
                                "allowed difference relative to the expected value")),
      not_negative(number_field("within", "?", &TruthBlock::within, "allowed absolute difference")),
      number_field("above", "?", &TruthBlock::above, "the metric must be greater"),
      number_field("below", "?", &TruthBlock::below, "the metric must be less"),
      words_field("same_over", 1, &TruthBlock::same_over,
                  "the value must be that at this sweep's first value"),
      words_field("subjects", 100, &TruthBlock::subjects, "subjects that it covers; default: all"),
      may_be_empty_field(&TruthBlock::may_be_empty, "it judges no run")};
  return fields;
}

/// ", mu = 0.8, slope from 15 deg".
std::string conditions_words(const std::vector<Condition>& conditions, const StudyParts& so_far) {
  std::string words;
  for (const Condition& condition : conditions) {
    const SweepPlan& sweep = so_far.sweeps[static_cast<std::size_t>(condition.sweep)];
    std::vector<std::string> held;
    for (std::size_t i = 0; i < sweep.si.size(); ++i)
      if (condition.holds(sweep.si[i])) held.push_back(sweep.texts[i]);
    if (held.empty()) continue;
    const bool all_given = held.size() < 3 || condition.values;
    words += ", " + sweep.column.name +
             (all_given ? " = " + language::join(held, " or ")
                        : " from " + held.front() + " to " + held.back());
  }
  return words;
}

/// The number in the unit that the field has it in, else in `unit`: "0.5 deg"; "" of one left out.
std::string number_text(const Placed<double>& number, const std::string& unit) {
  if (!number) return "";
  const WrittenUnit written = written_unit(*number.field);
  const WrittenUnit shown =
      written.text.empty()
          ? WrittenUnit{unit, language::parse_unit(unit).value_or(language::Unit{})}
          : written;
  return text::rounded(shown.from_si(*number)) + (shown.text.empty() ? "" : " " + shown.text);
}

/// "creep_speed equals predicted within 1 %, mu = 0.8 (ours)"
std::string truth_words(const TruthBlock& block, const TruthPlan& truth, const StudyParts& so_far) {
  const std::string& unit = so_far.metrics[truth.metric].unit.text;
  std::vector<std::string> parts;
  if (truth.predicted) parts.emplace_back("equals predicted");
  if (truth.value) parts.push_back("equals " + number_text(block.value, unit));
  if (truth.same_over >= 0)
    parts.push_back("is the same over " +
                    so_far.sweeps[static_cast<std::size_t>(truth.same_over)].column.name);
  if (!parts.empty()) parts.back() += allowed_words(truth, number_text(block.within, unit));
  if (truth.above) parts.push_back("is above " + number_text(block.above, unit));
  if (truth.below) parts.push_back("is below " + number_text(block.below, unit));
  std::string words(so_far.metrics[truth.metric].definition->name);
  words += " " + language::join(parts, " and ");
  words += conditions_words(truth.only, so_far);
  if (block.subjects) words += " (" + language::join(*block.subjects, ", ") + ")";
  return words;
}

}  // namespace

void add_truth_class(language::Schema& schema) {
  schema.add(block_class(
      "Truth", "What a metric must be; its name is the metric's unless `metric` says otherwise.",
      schemas(truth_fields()), {"Only"}));
}

std::string allowed_words(const TruthPlan& truth, const std::string& within) {
  std::string words;
  if (truth.tolerance > 0.) words += " within " + text::rounded(100. * truth.tolerance) + " %";
  if (truth.within > 0.) words += (truth.tolerance > 0. ? " or " : " within ") + within;
  return words;
}

std::optional<TruthPlan> load_truth(const Object& object, const StudyParts& so_far,
                                    Diagnostics& diagnostics) {
  const TruthBlock block = load_fields(object, truth_fields());
  const std::string& metric = block.metric ? *block.metric : object.name;
  const std::ptrdiff_t found = so_far.metric_index(metric);
  if (found < 0) {
    report_unknown(object.position, "Measure of this study", metric, so_far.metric_names(),
                   diagnostics);
    return std::nullopt;
  }
  TruthPlan truth;
  truth.metric = static_cast<std::size_t>(found);
  const auto in_unit_of_metric = [&](const Placed<double>& number) {
    return number ? std::optional(number_in(*number.field, so_far.metrics[truth.metric].unit.text,
                                            diagnostics))
                  : std::nullopt;
  };
  truth.value = in_unit_of_metric(block.value);
  truth.above = in_unit_of_metric(block.above);
  truth.below = in_unit_of_metric(block.below);
  truth.within = in_unit_of_metric(block.within).value_or(0.);
  truth.tolerance = block.tolerance;
  if (block.same_over) {
    truth.same_over = so_far.sweep_index(*block.same_over);
    if (truth.same_over < 0)
      report_unknown(block.same_over.position(), "Sweep", *block.same_over, so_far.sweep_names(),
                     diagnostics);
  }
  truth.predicted = block.equals.value == Equals::predicted;
  if (!truth.predicted && !truth.value && !truth.above && !truth.below && !block.same_over)
    diagnostics.error(
        object.position,
        "a Truth needs `equals = predicted`, `value`, `above`, `below` or `same_over`");
  if (truth.predicted && truth.value)
    diagnostics.error(block.value.position(), "a Truth equals the prediction or a value, not both");
  truth.subjects = named_subjects(block.subjects.field, so_far, diagnostics);
  truth.only = load_conditions(object, so_far, diagnostics);
  truth.may_be_empty = block.may_be_empty;
  truth.name = object.name;
  truth.words = truth_words(block, truth, so_far);
  return truth;
}

}  // namespace hookpoint::studies
