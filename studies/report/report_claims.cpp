#include "studies/report/report_claims.h"

#include "studies/report/page_parts.h"
#include "studies/report/report_page.h"
#include "studies/results/claims.h"

namespace hookpoint::studies {

std::string claim_lines(const StudyResult& study) {
  std::string text;
  for (const ClaimSpec& claim : study.claims) {
    const SaidClaim said = said_of(study, claim);
    const bool good = said.verdict == ClaimVerdict::holds;
    const bool bad = said.verdict == ClaimVerdict::fails ||
                     (said.verdict == ClaimVerdict::unsaid && !said.excused);
    const std::string tone = good ? "good" : bad ? "bad" : "soft";
    text += text_block("claim" + (bad ? std::string(" bad") : ""),
                       html(said.text) + " <small class=\"" + tone + "\">" +
                           (good  ? "✓ "
                            : bad ? "✗ "
                                  : "") +
                           html(said.why) + "</small>");
  }
  return text;
}

}  // namespace hookpoint::studies
