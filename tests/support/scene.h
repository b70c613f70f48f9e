// A scene of configs/ as a test wants it: loaded with parameters and overrides, or failing with the
// diagnostics.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/folders.h"
#include "tests/support/load_text.h"

namespace hookpoint::testing {

inline simulation::Experiment load_scene(const std::string& file,
                                         const std::map<std::string, std::string>& parameters,
                                         const std::vector<language::Override>& overrides = {}) {
  const std::filesystem::path configs = std::filesystem::path(testing::source_folder()) / "configs";
  const Loaded loaded = load_file(configs / file, {parameters, overrides});
  if (!loaded.experiment) throw std::runtime_error(loaded.diagnostics);
  return *loaded.experiment;
}

}  // namespace hookpoint::testing
