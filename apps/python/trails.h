// Ports by the trails that Python gives: numbers, vectors and lists.
#pragma once

#include <string>
#include <vector>

#include "simulation/wiring/ports.h"

namespace hookpoint::python {

/// The port of that trail, or, of a vector, a quaternion or a list ("block.base.location"), those
/// of its elements in order. Their values are right from now on. Throws simulation::ExperimentError
/// naming the nearest trail. O(ports).
std::vector<simulation::Port> ports_of(const simulation::Experiment& experiment,
                                       const std::vector<simulation::Port>& ports,
                                       const std::string& trail);

/// The wire that drives the port; null where none does.
const simulation::WireSpec* wire_to(const simulation::Experiment& experiment,
                                    const simulation::Port& port);

/// Throws hookpoint.Error where nobody may write the port, or a wire does.
void require_writable(const simulation::Experiment& experiment, const simulation::Port& port);

}  // namespace hookpoint::python
