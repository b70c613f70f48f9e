// Claim blocks: a sentence whose braces are numbers of the study.
#pragma once

#include <optional>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct StudyParts;

void add_claim_class(language::Schema& schema);

/// Nothing after an error in its text.
std::optional<ClaimSpec> load_claim(const language::Object& block, const StudyParts& so_far,
                                    language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
