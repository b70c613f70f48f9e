// MuJoCo's friction in closed form: the directions of its contact frames, and how a contact that
// sticks creeps. Needs no MuJoCo.
#pragma once

#include <array>
#include <optional>

#include "simulation/creep_velocity.h"
#include "simulation/experiment.h"

namespace hookpoint::reference {

/// The two tangents of a contact with that unit `normal`, along which the pyramid of friction has
/// its edges: the world's y made orthogonal to the normal (z where the normal leans to y by 30 deg
/// or more), and normal x that.
std::array<Vector3d, 2> mujoco_tangents(const Vector3d& normal);

/// Velocity of a single body that sticks to a plane. At rest the rows of a contact say
/// B v + K d r + R f = 0 with r = 0 in a friction row, so it creeps: an elliptic contact at R
/// f_t/B. A pyramid's rows, along normal +- mu tangent, mix both, and one that would pull is left
/// out. Nothing where that has no closed form: other robots and grounds, and where a contact slips
/// or lacks a row that another one has (the friction's moment takes load off the uphill contacts).
/// The impedance d is taken at the mean depth. Nothing with no-slip iterations.
std::optional<simulation::CreepVelocity> mujoco_creep(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
