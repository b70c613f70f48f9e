#include "apps/view/widgets/ghosts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/view/widgets/widget_fields.h"
#include "language/names.h"
#include "language/units.h"
#include "text/number.h"

namespace hookpoint::view {
namespace {

std::string colour_of(const language::Object& ghost) {
  if (!ghost.given(widget_field::colour)) return "";
  std::string colour = "#";
  for (const double share : ghost.numbers(widget_field::colour))
    colour += fmt::format("{:02X}", std::lround(255. * share));
  return colour;
}

/// A Fix's value as --set reads it.
std::string text_of(const language::Field& value) {
  if (!value.words.empty())
    return value.quoted.empty() || !value.quoted[0] ? value.words[0] : '"' + value.words[0] + '"';
  const std::string unit = language::unit_text(value.dimension);
  return text::shortest(value.numbers[0]) + (unit.empty() ? "" : " " + unit);
}

}  // namespace

std::vector<GhostSpec> load_ghosts(const language::Object& root) {
  std::vector<GhostSpec> ghosts;
  const auto worlds = root.children_of("World");
  if (worlds.empty()) return ghosts;
  for (const language::Object* ghost : root.children_of("Ghost")) {
    const bool labelled = ghost->given(widget_field::label);
    GhostSpec spec{ghost->name,
                   labelled ? ghost->word(widget_field::label) : ghost->name,
                   colour_of(*ghost),
                   {}};
    for (const language::Field& field : ghost->fields) {
      if (field.schema->name != widget_field::label && field.schema->name != widget_field::colour)
        spec.settings.push_back(worlds[0]->trail() + "." + field.schema->name + "=" +
                                field.words[0]);
    }
    for (const language::Object* fix : ghost->children_of("Fix"))
      spec.settings.push_back(fix->name + "=" + text_of(*fix->find("value")));
    ghosts.push_back(std::move(spec));
  }
  return ghosts;
}

void check_ghosts(const language::Object& root, language::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const language::ParameterValue& parameter : root.parameters) names.push_back(parameter.name);
  for (const language::Object* ghost : root.children_of("Ghost")) {
    for (const language::Object* fix : ghost->children_of("Fix")) {
      if (!fix->find("value")->words.empty() || std::ranges::find(names, fix->name) != names.end())
        continue;
      diagnostics.error(fix->position,
                        fmt::format("the file has no Param `{}` that is a number{}", fix->name,
                                    language::did_you_mean(fix->name, names)));
    }
  }
}

}  // namespace hookpoint::view
