#include <fmt/format.h>

#include <algorithm>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/engine_check.h"
#include "text/display.h"

namespace hookpoint::cli {

int engine_check(const std::vector<std::string>& command) {
  using Verdict = application::EngineFinding::Verdict;
  const auto findings = application::check_engine({.name = "",
                                                   .command = command,
                                                   .folder = std::filesystem::current_path(),
                                                   .settings = {},
                                                   .files = {},
                                                   .install = "",
                                                   .refusal = ""});
  for (const application::EngineFinding& finding : findings)
    fmt::print("{:<22} {:<14} {}\n", finding.check,
               finding.verdict == Verdict::passed   ? "passed"
               : finding.verdict == Verdict::failed ? "FAILED"
                                                    : "not supported",
               text::printable(finding.text));
  const auto failed =
      std::ranges::count(findings, Verdict::failed, &application::EngineFinding::verdict);
  fmt::print("{} of {} checks failed\n", failed, findings.size());
  return failed > 0 ? truth_failed : fine;
}

}  // namespace hookpoint::cli
