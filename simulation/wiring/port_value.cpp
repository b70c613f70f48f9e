#include "simulation/wiring/port_value.h"

#include <fmt/format.h>

#include <cmath>

#include "output/text/number.h"

namespace hookpoint::simulation {

std::string value_problem(const Port& port, double value) {
  if (!std::isfinite(value)) return "takes a finite number";
  if (value >= port.minimum && value <= port.maximum) return "";
  return fmt::format("takes numbers from {} to {}, not {}", output::shortest(port.minimum),
                     output::shortest(port.maximum), output::shortest(value));
}

}  // namespace hookpoint::simulation
