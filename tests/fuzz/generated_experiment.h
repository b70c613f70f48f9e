// Texts that look like experiments, drawn at random from the schema: every class where it may
// stand, every field with a value of its type, now and then a degenerate one. What is drawn depends
// on the seed alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "language/schema/schema.h"

namespace hookpoint::fuzz {

struct GeneratedExperiment {
  std::string text;                 ///< of a .hook file with one World, `w`
  std::vector<std::string> trails;  ///< scalar ports of it, to be recorded
};

/// The experiment of `seed`. Of three files one has no degenerate value, one a few, one many.
GeneratedExperiment generate_experiment(const language::Schema& schema, std::uint64_t seed);

}  // namespace hookpoint::fuzz
