#include "view/ghosts.h"

#include "view/widget_fields.h"

namespace hookpoint::view {

std::vector<GhostSpec> load_ghosts(const language::Object& root) {
  std::vector<GhostSpec> ghosts;
  const auto worlds = root.children_of("World");
  if (worlds.empty()) return ghosts;
  for (const language::Object* ghost : root.children_of("Ghost")) {
    const bool labelled = ghost->given(widget_field::label);
    GhostSpec spec{ghost->name, labelled ? ghost->word(widget_field::label) : ghost->name, {}};
    for (const language::Field& field : ghost->fields) {
      if (field.schema->name != widget_field::label)
        spec.settings.push_back(worlds[0]->trail() + "." + field.schema->name + "=" +
                                field.words[0]);
    }
    ghosts.push_back(std::move(spec));
  }
  return ghosts;
}

}  // namespace hookpoint::view
