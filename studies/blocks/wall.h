// Wall blocks, with their Scenes: suites of scenes that bring their own truths.
#pragma once

#include <string>

#include "language/schema/schema.h"
#include "studies/blocks/block.h"

namespace hookpoint::studies {

/// A Wall block as its file has it.
struct WallBlock : Heading {
  bool score_card = false;  ///< whether it compares, and its truths need not hold
};

/// A Scene block as its file has it.
struct SceneBlock {
  std::string title;
  Placed<std::string> file;                   ///< left out: scenes/NAME.hook
  bool quick = true;                          ///< whether it runs under --quick
  const language::Field* accepted = nullptr;  ///< error that others accept; null: none
  std::string accepted_by;                    ///< who they are
};

void add_wall_classes(language::Schema& schema);

WallBlock wall_block(const language::Object& wall);
SceneBlock scene_block(const language::Object& scene);
/// The file of a Wall's Scene, as it is looked up.
std::string scene_file(const language::Object& scene);

}  // namespace hookpoint::studies
