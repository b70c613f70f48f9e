// World.dynamics: mass matrix, bias forces, Jacobians of a robot as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

namespace hookpoint::python {

/// Adds the class RobotDynamics and, to World, the method that makes one. After add_world.
void add_dynamics(pybind11::module_& module);

}  // namespace hookpoint::python
