// Loads an experiment from the language's text, as the command does.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "apps/view/widgets/schema.h"
#include "language/document/document.h"
#include "reference/engines.h"
#include "simulation/scene/load.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"
#include "tests/support/folders.h"

namespace hookpoint {

inline const language::Schema& experiment_schema() {
  static const language::Schema schema = [] {
    language::Schema classes;
    simulation::add_experiment_classes(classes, reference::peer_choices());
    view::add_display_classes(classes);
    studies::add_study_classes(classes);  // a Ghost holds Fixes
    return classes;
  }();
  return schema;
}

/// An experiment, or why there is none: `severity line:column message` for each diagnostic.
struct Loaded {
  std::optional<simulation::Experiment> experiment;
  std::string diagnostics;
};

inline Loaded load_file(const std::filesystem::path& file,
                        const language::EvaluateOptions& options = {},
                        simulation::RunOf run = simulation::RunOf::scene) {
  const std::filesystem::path configs = std::filesystem::path(testing::source_folder()) / "configs";
  language::Library library(experiment_schema(), {configs});
  language::Diagnostics diagnostics;
  Loaded loaded;
  const auto root = library.evaluate(file, options, diagnostics);
  if (root) loaded.experiment = simulation::load_experiment(*root, diagnostics, {configs}, {}, run);
  std::ostringstream text;
  for (const language::Diagnostic& diagnostic : diagnostics.all()) {
    constexpr const char* names[] = {"error", "warning", "note"};
    text << names[static_cast<int>(diagnostic.severity)];
    if (diagnostic.position.file != nullptr) {
      const language::LineColumn place = language::line_and_column(diagnostic.position);
      text << ' ' << place.line << ':' << place.column;
    }
    text << ' ' << diagnostic.message << '\n';
  }
  loaded.diagnostics = text.str();
  return loaded;
}

/// `text` as a file of its own.
inline Loaded load_text(const std::string& text, const language::EvaluateOptions& options = {},
                        simulation::RunOf run = simulation::RunOf::scene) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("hookpoint_load_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "text.hook";
  std::ofstream(file) << text;
  Loaded loaded = load_file(file, options, run);
  std::filesystem::remove_all(folder);
  return loaded;
}

}  // namespace hookpoint
