#include "simulation/wiring/port_value.h"

#include <fmt/format.h>

#include <cmath>

#include "text/number.h"

namespace hookpoint::simulation {

std::string value_problem(const Port& port, double value) {
  if (!std::isfinite(value)) return "takes a finite number";
  if (value >= port.minimum && value <= port.maximum) return "";
  return fmt::format("takes numbers from {} to {}, not {}", text::rounded(port.minimum, 6),
                     text::rounded(port.maximum, 6), text::rounded(value, 6));
}

}  // namespace hookpoint::simulation
