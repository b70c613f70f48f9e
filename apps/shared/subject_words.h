// A subject as one writes it on the command line: `--with mujoco:recommended`, `--with rk4`.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "language/schema/schema.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::application {

/// What is written names no engine, setting, law or integrator; the message is for the user.
struct SubjectError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The World's fields that the words set, which colons join: an engine, its settings, a law, an
/// integrator, each at most once. A law or an integrator is of our engine unless one is named.
/// `given_as`: what the words stand behind, for an error. Throws SubjectError.
std::vector<std::pair<std::string, std::string>> subject_fields(
    const language::Schema& schema, const std::string& words,
    const std::string& given_as = "--with");

/// What tells an experiment from the same one under other words: our law, or the engine and its
/// settings.
std::string subject_name(const simulation::Experiment& experiment);

}  // namespace hookpoint::application
