// What contacts of MuJoCo's kind do at rest and in an impact: MuJoCo's own, and Genesis', which has the
// same rows.
#pragma once

#include "reference/mujoco/settings.h"
#include "translation/situation.h"

namespace hookpoint::translation {

/// `friction`: mu. The rows scale with Situation::foot_inverse_weight.
Behaviour behaviour_of(const reference::MujocoSettings& settings, const reference::MujocoRow& row,
                       double friction, const Situation& at);

/// The row that is a material's spring and damper, and the ratio of the friction rows to it.
struct SoftRow {
  reference::MujocoSettings settings;
  reference::MujocoRow row;
  bool at_bound = false;  ///< the impedance is at one of its bounds: the contact is not this stiff
};
SoftRow nearest_soft_row(const DesiredContact& desired, const Situation& at);

}  // namespace hookpoint::translation
