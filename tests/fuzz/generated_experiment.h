// Texts that look like experiments, drawn at random from the schema: every class where it may
// stand, every field with a value of its type, now and then a degenerate one. What is drawn depends
// on the seed alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "language/schema/schema.h"

namespace hookpoint::fuzz {

/// A file beside the experiment.
struct GeneratedFile {
  std::string name, content;
};

/// What runs it.
enum class GeneratedCommand { run, study, tune };

struct GeneratedExperiment {
  GeneratedCommand command = GeneratedCommand::run;
  std::string text;                  ///< of a .hook file: one World, `w`, or what is run of a scene
  std::vector<std::string> trails;   ///< scalar ports of a World, to be recorded
  std::vector<GeneratedFile> files;  ///< that it names
  bool dynamics = false;             ///< of a World: `hookpoint dynamics` too
};

/// The experiment of `seed`. Of three files one has no degenerate value, one a few, one many.
GeneratedExperiment generate_experiment(const language::Schema& schema, std::uint64_t seed);

}  // namespace hookpoint::fuzz
