// What a file steps beside its run, to be drawn in the same scene.
#pragma once

#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/object.h"

namespace hookpoint::view {

struct GhostSpec {
  std::string name;
  std::string label;                  ///< in legends
  std::string colour;                 ///< "#0072B2"; "" is one of the figures'
  std::vector<std::string> settings;  ///< what it has otherwise, as --set takes it: "w.engine=ode";
                                      ///< none: it is the run itself that it names and colours
};

/// In file order; none without a World.
std::vector<GhostSpec> load_ghosts(const language::Object& root);

/// Tells of each Fix whose number is of no Param of the file.
void check_ghosts(const language::Object& root, language::Diagnostics& diagnostics);

}  // namespace hookpoint::view
