// Each body with all that it carries, its joints held: what the mass matrix and the centre of mass
// are made of (Featherstone 2008, section 6.2). All about one point, in world axes, so that bodies
// taken together are sums.
#pragma once

#include <vector>

#include "dts/workspace.h"

namespace hookpoint::dts {

/// The bodies of a model at one posture, world axes, about the base's origin O.
struct CompositeBodies {
  std::vector<RigidInertia<double>> carried;  ///< one a body: itself and all that hangs on it
  std::vector<Motion<double>> freedoms;  ///< one a link: S, the motion at O of a unit joint rate
  std::vector<double> rotor_inertias;    ///< one a link: I_r [kg m^2, kg]
};

/// At the posture that forward_kinematics saw last. A fixed base counts as massless. O(links).
CompositeBodies composite_bodies(const Model<double>& model, const Workspace<double>& workspace);

}  // namespace hookpoint::dts
