// Claims with their numbers filled in, and whether the Truths behind them hold.
#pragma once

#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// Unjudged: no Truth says anything of its runs. Unsaid: no run has one of its numbers.
enum class ClaimVerdict { holds, fails, unjudged, unsaid };

struct SaidClaim {
  std::string text;
  ClaimVerdict verdict = ClaimVerdict::unjudged;
  std::string why;       ///< in words: "the Truth creep holds in all 12 runs"
  bool excused = false;  ///< of an unsaid one: the file allows it, or its runs were left out here
};

/// Why the claim lacks one of its numbers, if it does.
Idleness idleness_of(const StudyResult& study, const ClaimSpec& claim);

/// The claim as the study's rows tell it. Cost: its numbers times the rows.
SaidClaim said_of(const StudyResult& study, const ClaimSpec& claim);

}  // namespace hookpoint::studies
