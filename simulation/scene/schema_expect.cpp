// What a scene says that a run of it must show.
#include "simulation/run/expectation.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"

namespace hookpoint::simulation {
namespace {

FieldSchema words_field(std::string name, int most, std::string doc) {
  FieldSchema field = make_field(FieldType::words, std::move(name), std::move(doc));
  field.max_count = most;
  return field;
}

}  // namespace

void add_expectation_classes(language::Schema& schema) {
  language::ClassSchema expect;
  expect.name = "Expect";
  expect.doc =
      "a truth of the scene: what a port must come to, by a closed form; `run` prints it beside "
      "what came out, a Wall shows it for every law";
  expect.top_level = true;
  expect.naming = language::Naming::required;
  expect.fields = {
      required(words_field("of", 1, "the port")),
      choice_field("take", reduction_names(), "final",
                   "what becomes of its values: the last, the largest, ..., `slope` by least "
                   "squares, `time_at` when it first crosses `level`"),
      required(number_field("equals", "?", "", "the closed form, of the scene's Params")),
      not_negative(number_field("tolerance", "", "0", "allowed difference relative to `equals`")),
      not_negative(number_field("within", "?", "", "allowed absolute difference")),
      number_field("level", "?", "", "of `time_at`"),
      not_negative(number_field("from", "s", "0", "values before do not count")),
      positive(number_field("to", "s", "", "values after do not count; default: the run's end")),
      words_field("laws", 20, "contact laws that it holds for; default: all"),
      words_field("except_laws", 20, "contact laws that it says nothing of"),
      words_field("integrators", 20, "integrators that it holds for; default: all"),
      text_field("source", "where the closed form comes from"),
  };
  schema.add(std::move(expect));
}

}  // namespace hookpoint::simulation
