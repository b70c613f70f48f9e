// Whether a number may be written to a port.
#pragma once

#include <string>

#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// "" or what is wrong, as a predicate to the port's trail: "takes a finite number".
std::string value_problem(const Port& port, double value);

}  // namespace hookpoint::simulation
