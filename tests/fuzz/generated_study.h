// Files with a Study, a Tune or a Calibrate, drawn at random from the schema with a scene, tables
// of cases and measured curves beside them.
#pragma once

#include "tests/fuzz/generated_experiment.h"

namespace hookpoint::fuzz {

/// The file of `seed`, by the schema with the classes of studies.
GeneratedExperiment generate_study(const language::Schema& schema, std::uint64_t seed);

}  // namespace hookpoint::fuzz
