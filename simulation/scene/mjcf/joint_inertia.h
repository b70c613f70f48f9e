// Inertias that MuJoCo's compiler counts with: of a servo that states its damping ratio, and of a
// joint that states the time constant of its spring and damper.
#pragma once

#include <vector>

#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

/// Inertia [kg m^2, kg] at a joint, that of its rotor included; 0 of one that is fixed or free.
struct JointInertia {
  double rigid = 0.;      ///< M_jj: of all that it carries, other joints held
  double effective = 0.;  ///< 1/(M^-1)_jj: other joints and a free base follow without force
};

/// One for each joint of `robot`, whose joints stand at `angle` and after those that carry them. Cost:
/// linear in the joints.
std::vector<JointInertia> joint_inertias(const UrdfRobot& robot);

}  // namespace hookpoint::simulation
