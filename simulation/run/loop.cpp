#include "simulation/run/loop.h"

#include <fmt/format.h>

namespace hookpoint::simulation {

std::string failure_text(const StepStatus& status) {
  return fmt::format("at {:.6g} s ({}): {}", status.time, status.body, status.advice);
}

}  // namespace hookpoint::simulation
