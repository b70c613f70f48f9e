#include "studies/blocks/only.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "language/names.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

const Fields<OnlyBlock>& only_fields() {
  static const Fields<OnlyBlock> fields{
      or_words(values_field("values", &OnlyBlock::values, "exactly these values")),
      number_field("from", "?", &OnlyBlock::from, "least value"),
      number_field("to", "?", &OnlyBlock::to, "greatest value")};
  return fields;
}

Condition load_condition(const Object& object, int sweep, const SweepPlan& swept,
                         Diagnostics& diagnostics) {
  const OnlyBlock block = only_block(object);
  const bool words = !swept.column.words.empty();
  Condition condition;
  condition.sweep = sweep;
  if (block.values != nullptr) {
    if (block.values->words.empty() == words)
      diagnostics.error(
          block.values->position,
          fmt::format("the values of `{}` are {}", swept.column.name,
                      words ? "words: " + language::join(swept.texts, ", ") : "numbers"));
    condition.values = words ? word_values(swept, *block.values, diagnostics)
                             : number_values(swept, *block.values, diagnostics);
  }
  for (const Placed<double>& end : {block.from, block.to})
    if (words && end.given())
      diagnostics.error(
          end.position(),
          fmt::format("`{}` has words, which have no order: give `values`", swept.column.name));
  condition.from = block.from.value;
  condition.to = block.to.value;
  const bool ranged = !words && (condition.from || condition.to) && !condition.values;
  if (ranged && std::ranges::none_of(swept.declared, [&](double v) { return condition.holds(v); }))
    diagnostics.error(
        object.position,
        fmt::format("no value of the Sweep `{}` lies there; it has {}", swept.column.name,
                    swept.values_near(condition.from ? condition.from : condition.to)));
  return condition;
}

}  // namespace

void add_only_class(language::Schema& schema) {
  schema.add(block_class(
      "Only", "Restricts its owner to some values of a swept Param, or Cases to some of a column.",
      schemas(only_fields())));
}

OnlyBlock only_block(const Object& block) { return load_fields(block, only_fields()); }

bool Condition::holds(double value) const {
  const double slack = 1e-9 * std::abs(value);
  if (from && value < *from - slack) return false;
  if (to && value > *to + slack) return false;
  if (!values) return true;
  return std::any_of(values->begin(), values->end(),
                     [&](double allowed) { return std::abs(allowed - value) <= slack; });
}

std::vector<Condition> load_conditions(const Object& owner, const StudyParts& so_far,
                                       Diagnostics& diagnostics) {
  std::vector<Condition> result;
  for (const Object* block : owner.children_of("Only")) {
    const int sweep = so_far.sweep_index(block->name);
    if (sweep < 0)
      report_unknown(block->position, "Sweep", block->name, so_far.sweep_names(), diagnostics);
    else
      result.push_back(load_condition(*block, sweep, so_far.sweeps[static_cast<std::size_t>(sweep)],
                                      diagnostics));
  }
  return result;
}

}  // namespace hookpoint::studies
