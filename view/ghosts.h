// What a file steps beside its run, to be drawn in the same scene.
#pragma once

#include <string>
#include <vector>

#include "language/tree/object.h"

namespace hookpoint::view {

struct GhostSpec {
  std::string name;
  std::string label;                  ///< in legends
  std::vector<std::string> settings;  ///< what it has otherwise, as --set takes it: "w.engine=ode"
};

/// In file order; none without a World.
std::vector<GhostSpec> load_ghosts(const language::Object& root);

}  // namespace hookpoint::view
