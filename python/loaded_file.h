// A .hook file as the worlds of Python are made from it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "application/application.h"
#include "simulation/experiment.h"
#include "simulation/run/world.h"

namespace hookpoint::python {

/// An Application that keeps what it has to tell, for an exception.
class QuietApplication {
 public:
  explicit QuietApplication(bool allow_plugins);
  application::Application& operator*() { return *application_; }
  application::Application* operator->() { return application_.get(); }
  const application::Application* operator->() const { return application_.get(); }
  /// Throws hookpoint.FileError with what was told last.
  [[noreturn]] void fail() const;
  /// Warnings told since the last call become warnings of Python, each with its place.
  void pass_on_warnings();

 private:
  struct Told {
    language::Diagnostics last;
    std::vector<std::string> warnings;
  };
  std::shared_ptr<Told> told_;
  std::unique_ptr<application::Application> application_;
};

/// What a .hook file is, and what is changed in it before it is evaluated.
struct Source {
  std::filesystem::path file;
  std::optional<std::string> text;    ///< the file's, if it is none on disk
  std::vector<std::string> settings;  ///< trail=value
  std::optional<std::string> engine;
  bool allow_plugins = false;
};

/// Loaded once, however many worlds are made from it.
class LoadedFile {
 public:
  /// Throws hookpoint.FileError.
  explicit LoadedFile(const Source& source);

  const simulation::Experiment& experiment() const { return *experiment_; }
  /// The experiment after includes, loops, expressions and settings.
  const std::string& text() const { return text_; }
  /// The same with another value of a field of its World.
  std::string text_with(const std::string& field, const std::string& value);
  /// The same of a world with that seed, whether or not the file states it.
  std::string text_with_seed(std::uint64_t seed) { return text_with("seed", std::to_string(seed)); }
  const std::vector<std::string>& sources() const { return sources_; }
  simulation::EngineDescription describe_engine() const {
    return application_->describe_engine(*experiment_);
  }
  /// At time 0, of `experiment`, which is this file's but for its seed and outlives it. Throws
  /// simulation::ExperimentError when the engine cannot run it.
  std::unique_ptr<simulation::World> make_world(const simulation::Experiment& experiment) const {
    return std::make_unique<simulation::World>(experiment, application_->make_engine(experiment));
  }

 private:
  /// The settings with one more: a field of the file's World.
  std::vector<std::string> settings_with(const std::string& field, const std::string& value);

  Source source_;
  QuietApplication application_;
  std::optional<simulation::Experiment> experiment_;
  std::string text_;
  std::vector<std::string> sources_;  ///< files that it was made from
};

}  // namespace hookpoint::python
