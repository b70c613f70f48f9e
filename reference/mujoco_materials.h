// Contacts between Materials that state MuJoCo's own parameters.
#pragma once

#include "contact/mujoco_contact.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// Row of a contact between a foot of material `foot` and ground of material `ground`, indices into
/// Experiment::materials or no_material: that of a Pair's material, of the side that alone states one,
/// or both mixed as MuJoCo does. MuJoCo's default where neither does.
contact::MujocoRow mujoco_row_of(const simulation::Experiment& experiment, int foot, int ground);

/// Cone and impratio, which MuJoCo has once for a world; its defaults where no Material states them.
/// Throws simulation::ExperimentError where two Materials state others.
contact::MujocoFriction mujoco_friction_of(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
