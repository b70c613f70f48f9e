// The Claims of a study, as HTML.
#pragma once

#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// A paragraph a Claim, each with a mark and words, so that it can be read without colours; "" of a
/// study without.
std::string claim_lines(const StudyResult& study);

}  // namespace hookpoint::studies
