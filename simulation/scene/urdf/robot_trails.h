// Trails by which the objects of a robot that a file describes name each other. A file calls links and
// joints as it likes, and a name that stands nearer hides one that stands further out.
#pragma once

#include "language/report.h"
#include "language/tree/foreign.h"

namespace hookpoint::simulation {

/// Writes the fields `mimic` and the wires of the robot's objects, whose trails begin with the robot's
/// name, so that they reach what they name: a wire by the shortest trail that does, a field by the
/// longest. An error where none does. Cost: the depth of the objects, for each trail that is tried.
void settle_trails(language::ForeignObject& robot, language::Report& report);

}  // namespace hookpoint::simulation
