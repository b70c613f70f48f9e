#include "studies/blocks/objective.h"

#include <utility>

namespace hookpoint::studies {

namespace {

constexpr const char *minimise_class = "minimise", *maximise_class = "maximise";

const Fields<ObjectiveBlock>& objective_fields() {
  static const Fields<ObjectiveBlock> fields{
      choice_field("take", {"mean", "worst"}, &ObjectiveBlock::take,
                   "what is taken of the seeds' values"),
      number_field("target", "?", &ObjectiveBlock::target,
                   "in the place of minimise and maximise: what the metric should be; minimised "
                   "is its distance from it, run by run"),
      may_be_empty_field(&ObjectiveBlock::may_be_empty,
                         "every candidate has the same value of it, or none has one; a run "
                         "without a value is then the worst in it")};
  return fields;
}

const Fields<RequireBlock>& require_fields() {
  static const Fields<RequireBlock> fields{
      number_field("equals", "?", &RequireBlock::equals, "the value"),
      not_negative(number_field("within", "?", &RequireBlock::within,
                                "allowed difference from `equals`; default 0")),
      number_field("above", "?", &RequireBlock::above, "it must be greater"),
      number_field("below", "?", &RequireBlock::below, "it must be less"),
      may_be_empty_field(&RequireBlock::may_be_empty,
                         "no run has a value of it; a run without one then meets it")};
  return fields;
}

/// What an Objective is required with: a word by itself.
language::ClassSchema direction_class(std::string name, std::string doc) {
  language::ClassSchema direction;
  direction.name = std::move(name);
  direction.only_in = "Objective";
  direction.doc = std::move(doc);
  direction.naming = language::Naming::forbidden;
  return direction;
}

}  // namespace

void add_objective_classes(language::Schema& schema) {
  schema.add(block_class("Objective",
                         "A metric to make small or great, or to bring to a target, by its name.",
                         schemas(objective_fields()), {minimise_class, maximise_class}));
  schema.add(direction_class(minimise_class, "the less the better"));
  schema.add(direction_class(maximise_class, "the more the better"));
}

void add_require_class(language::Schema& schema) {
  schema.add(block_class("Require", "What a metric must be with every seed, by its name.",
                         schemas(require_fields())));
}

ObjectiveBlock objective_block(const language::Object& block) {
  ObjectiveBlock objective = load_fields(block, objective_fields());
  objective.minimise = !block.children_of(minimise_class).empty();
  objective.maximise = !block.children_of(maximise_class).empty();
  return objective;
}

RequireBlock require_block(const language::Object& block) {
  return load_fields(block, require_fields());
}

}  // namespace hookpoint::studies
