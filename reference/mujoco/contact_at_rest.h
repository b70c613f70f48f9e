// A contact of MuJoCo at rest, in closed form: how deep it stands, and how it creeps.
#pragma once

#include "reference/mujoco/settings.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"

namespace hookpoint::reference {

/// A body at rest on a plane, of which each contact carries the same friction.
struct MujocoLoad {
  double inverse_weight = 0.;           ///< A [1/kg]
  double normal = 0., tangential = 0.;  ///< of a contact, in the mean [N]
  /// Least and largest normal load of a contact over the mean one.
  double least = 1., largest = 1.;
  double along = 0., across = 0.;  ///< parts of the pull along the two tangents, as magnitudes
  double turned = 0.;              ///< the product of the two with their signs
  double friction = 0.;            ///< mu
};

struct MujocoRest {
  simulation::CreepVelocity velocity;  ///< of the body
  double depth;                        ///< of a contact [m]
};
/// At rest the rows say B v + K d r + R f = 0, with r = 0 in a friction row: an elliptic contact
/// creeps at R f_t/B. A pyramid's rows, along normal +- mu tangent, mix both, and one that would
/// pull is left out. No closed form where a contact slips, or lacks a row that another one has.
simulation::ClosedForm<MujocoRest> mujoco_rest(const MujocoLoad& load,
                                               const MujocoSettings& settings, const MujocoRow& row,
                                               double dt);

}  // namespace hookpoint::reference
