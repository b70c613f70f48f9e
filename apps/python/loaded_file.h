// A .hook file as the worlds of Python are made from it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/application.h"
#include "simulation/experiment/experiment.h"
#include "simulation/run/world.h"

namespace hookpoint::python {

/// An Application that stores its diagnostics, for an exception.
class QuietApplication {
 public:
  explicit QuietApplication(application::Consent consent);
  application::Application& operator*() { return *application_; }
  application::Application* operator->() { return application_.get(); }
  const application::Application* operator->() const { return application_.get(); }
  /// Throws hookpoint.FileError with the last diagnostics.
  [[noreturn]] void fail() const;
  /// The warnings since the last call, each with its place.
  std::vector<std::string> take_warnings();
  /// The same as warnings of Python.
  void pass_on_warnings();

 private:
  struct Received {
    language::Diagnostics last;
    std::vector<std::string> warnings;
  };
  std::shared_ptr<Received> received_;
  std::unique_ptr<application::Application> application_;
};

/// What a .hook file is, and what is changed in it before it is evaluated.
struct Source {
  std::filesystem::path file;
  std::optional<std::string> text;    ///< the file's, if it is none on disk
  std::vector<std::string> settings;  ///< trail=value
  std::optional<std::string> engine;
  application::Consent consent;
};

/// "deltat 0.01 s is above the largest stable step ..."; "" where the step is stable.
std::string warning_of_step(const simulation::Experiment& experiment);

/// Loaded once, however many worlds are made from it.
class LoadedFile {
 public:
  /// Throws hookpoint.FileError.
  explicit LoadedFile(const Source& source);

  const Source& source() const { return source_; }
  const simulation::Experiment& experiment() const { return *experiment_; }
  /// The experiment after includes, loops, expressions and settings.
  const std::string& text() const { return text_; }
  /// The same with another value of a field of its World.
  std::string text_with(const std::string& field, const std::string& value);
  /// The same of a world with that seed, whether or not the file states it.
  std::string text_with_seed(std::uint64_t seed) { return text_with("seed", std::to_string(seed)); }

  /// What a world of a Batch has of its own.
  struct Variant {
    std::vector<std::string> settings;  ///< trail=value, all of them
    /// Of its World, and of the Param `seed` where the file declares one and no setting gives it.
    std::optional<std::uint64_t> seed;
    auto operator<=>(const Variant&) const = default;
  };
  /// The experiment of a variant, or its diagnostics where it is wrong. Several threads may call
  /// it.
  struct LoadedVariant {
    std::optional<simulation::Experiment> experiment;
    language::Diagnostics diagnostics;
  };
  LoadedVariant load_variant(const Variant& variant);
  /// Its text, with the seed of its World whether or not the file states it.
  std::string text_of(const Variant& variant, const simulation::Experiment& experiment);
  /// What the command says of the file beside errors: warnings with their places, a step that is
  /// not stable.
  const std::vector<std::string>& notices() const { return notices_; }
  const std::vector<std::string>& sources() const { return sources_; }
  simulation::EngineDescription describe_engine() const {
    return application_->describe_engine(*experiment_);
  }
  /// At time 0, of `experiment`, which is this file's or a variant's and outlives it. Throws
  /// simulation::ExperimentError when the engine cannot run it.
  std::unique_ptr<simulation::World> make_world(const simulation::Experiment& experiment) const {
    return std::make_unique<simulation::World>(experiment, application_->make_engine(experiment));
  }

 private:
  /// The file's settings, that of its engine, and one more: a field of its World.
  std::vector<std::string> settings_with(const std::string& field, const std::string& value);

  language::EvaluateOptions options_of(const Variant& variant) const;

  Source source_;
  QuietApplication application_;
  std::optional<simulation::Experiment> experiment_;
  std::string text_;
  std::vector<std::string> sources_;  ///< files that it was made from
  std::vector<std::string> notices_;
  std::vector<std::string> engine_settings_;  ///< the World's engine, where the user chose one
  bool declares_seed_ = false;                ///< a Param of that name
};

}  // namespace hookpoint::python
