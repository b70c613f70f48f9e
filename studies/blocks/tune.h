// The Tune block itself.
#pragma once

#include <cstdint>
#include <string>

#include "language/schema/schema.h"
#include "studies/blocks/times.h"
#include "studies/blocks/varied_scene.h"

namespace hookpoint::studies {

struct TuneBlock : VariedSceneBlock, TimesBlock {
  Placed<std::string> method = std::string("nsga2");
  Placed<int> population = 40;
  int generations = 25, seeds = 4;
  std::uint64_t seed = 1;
  int samples = 32;
};

void add_tune_class(language::Schema& schema);

/// Under --quick with smaller numbers.
TuneBlock load_tune(const language::Object& block, bool quick);

}  // namespace hookpoint::studies
