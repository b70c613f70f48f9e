// A file as a window is made from it: its tree, its experiment, and a run of it under our engine.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"

namespace hookpoint {

class Shown {
 public:
  explicit Shown(const std::filesystem::path& file) : library_(experiment_schema(), {configs()}) {
    root_ = library_.evaluate(file, {}, diagnostics_);
    if (root_) experiment_ = simulation::load_experiment(*root_, diagnostics_, {configs()});
    if (!experiment_) throw std::runtime_error(told());
  }

  const language::Object& root() const { return *root_; }
  const simulation::Experiment& experiment() const { return *experiment_; }
  language::Diagnostics& diagnostics() { return diagnostics_; }
  /// All that is wrong so far, as `line:column message`.
  std::string told() const {
    std::ostringstream text;
    for (const language::Diagnostic& diagnostic : diagnostics_.all()) {
      const language::LineColumn place = language::line_and_column(diagnostic.position);
      text << place.line << ':' << place.column << ' ' << diagnostic.message << '\n';
    }
    return text.str();
  }
  /// Made when it is first asked for.
  simulation::World& world() {
    if (!world_) world_.emplace(*experiment_, simulation::make_dts(*experiment_));
    return *world_;
  }

 private:
  static std::filesystem::path configs() {
    return std::filesystem::path(testing::source_folder()) / "configs";
  }

  language::Library library_;
  language::Diagnostics diagnostics_;
  std::unique_ptr<language::Object> root_;
  std::optional<simulation::Experiment> experiment_;
  std::optional<simulation::World> world_;
};

/// `text` as a file of its own.
class ShownText {
 public:
  explicit ShownText(const std::string& text) : file_(written(text)), shown_(file_) {}
  ~ShownText() { std::filesystem::remove(file_); }
  ShownText(const ShownText&) = delete;
  ShownText& operator=(const ShownText&) = delete;
  Shown& operator*() { return shown_; }
  Shown* operator->() { return &shown_; }

 private:
  static std::filesystem::path written(const std::string& text) {
    static int count = 0;
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("hookpoint_shown_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".hook");
    std::ofstream(file) << text;
    return file;
  }

  std::filesystem::path file_;
  Shown shown_;
};

}  // namespace hookpoint
