// Fix blocks: values of Params.
#pragma once

#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/results/assignment.h"

namespace hookpoint::studies {

struct StudyParts;

void add_fix_class(language::Schema& schema);

/// The value as text that the language reads back.
std::string fixed_text(const language::Object& fix);
/// The words of the value; empty of a number.
const std::vector<std::string>& fixed_words(const language::Object& fix);

/// The Fix blocks of a Study or of one of its Subjects. Errors for Params that there are not, or
/// that a Sweep or the Cases set.
std::vector<Assignment> load_fixes(const language::Object& owner, const StudyParts& so_far,
                                   language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
