// A scene of configs/ as a test wants it: loaded with parameters and overrides, or failing with the
// diagnostics.
#pragma once

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "language/document.h"
#include "reference/engines.h"
#include "simulation/scene/load.h"
#include "simulation/scene/schema.h"

namespace hookpoint::testing {

inline simulation::Experiment load_scene(const std::string& file,
                                         const std::map<std::string, std::string>& parameters,
                                         const std::vector<language::Override>& overrides = {}) {
  const std::filesystem::path configs = std::filesystem::path(HOOKPOINT_SOURCE_DIR) / "configs";
  language::Schema schema;
  simulation::add_experiment_classes(schema, reference::peer_choices());
  language::Library library(schema, {configs});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(configs / file, {parameters, overrides}, diagnostics);
  std::optional<simulation::Experiment> experiment;
  if (root) experiment = simulation::load_experiment(*root, diagnostics);
  if (!experiment) {
    std::ostringstream text;
    diagnostics.print(text, false);
    throw std::runtime_error(text.str());
  }
  return *experiment;
}

}  // namespace hookpoint::testing
