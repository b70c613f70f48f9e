// The Study block itself.
#pragma once

#include <filesystem>
#include <string>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "studies/blocks/block.h"
#include "studies/blocks/times.h"

namespace hookpoint::studies {

struct StudyParts;

/// A Study block as its file has it.
struct StudyBlock : Heading, TimesBlock {
  Placed<std::string> scene;
  const language::Field* body = nullptr;
  Placed<int> seeds;
  Placed<std::string> match;
  bool expects = true;
};

void add_study_class(language::Schema& schema);
StudyBlock study_block(const language::Object& block);

/// What the block itself says, but for `seeds`; the scene's file, empty after an error.
std::filesystem::path load_study(const language::Object& study, StudyParts& parts,
                                 language::Diagnostics& diagnostics);
/// The runs of each row, after all that may name other sweeps.
void load_seeds(const language::Object& study, StudyParts& so_far,
                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
