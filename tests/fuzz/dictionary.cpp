// The words of the language as a dictionary for libFuzzer, from the tables of the lexer and the
// schema.
#include <cstdio>
#include <set>
#include <string>

#include "apps/view/widgets/schema.h"
#include "language/syntax/token.h"
#include "language/units.h"
#include "language/values/expression.h"
#include "reference/engines.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"

int main() {
  using namespace hookpoint;
  language::Schema schema;
  simulation::add_experiment_classes(schema, reference::peer_choices());
  view::add_display_classes(schema);
  studies::add_study_classes(schema);

  std::set<std::string> words{"FROM", "TO", "in",   "true", "false", "pi", "{",  "}",  "[",
                              "]",    "(",  ")",    ";",    "=",     ",",  "..", "//", "/*",
                              "*/",   "&&", "\\\"", "?",    ":",     "^",  "==", "<="};
  words.insert(std::begin(language::reserved_words), std::end(language::reserved_words));
  words.insert(language::unit_names().begin(), language::unit_names().end());
  words.insert(language::function_names().begin(), language::function_names().end());
  for (const auto& [name, type] : schema.classes()) {
    words.insert(name);
    for (const language::FieldSchema& field : type.fields) {
      words.insert(field.name);
      words.insert(field.choices.begin(), field.choices.end());
    }
  }
  for (const std::string& word : words) std::printf("\"%s\"\n", word.c_str());
}
