// The conformance suite of engines that are programs: experiments with known answers, which its
// author runs first (docs/engine_protocol.md).
#pragma once

#include <string>
#include <vector>

#include "reference/process/definition.h"

namespace hookpoint::application {

struct EngineFinding {
  enum class Verdict { passed, failed, not_supported };
  std::string check;  ///< "contact forces"
  Verdict verdict = Verdict::passed;
  std::string text;  ///< what was seen, and what was expected
};

/// Every check in turn; the first alone where the program does not say hello.
std::vector<EngineFinding> check_engine(reference::ProgramDefinition definition);

}  // namespace hookpoint::application
