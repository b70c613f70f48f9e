// Damping of other force laws that leaves the rebound of a spring and damper.
#pragma once

#include "translation/situation.h"

namespace hookpoint::translation {

/// Rebound e of the mass on the desired spring and damper.
double desired_rebound(const DesiredContact& desired, const Situation& at);
/// alpha [s/m] of a Hunt and Crossley force f (1 + alpha v) with that rebound at impact_speed.
double hunt_crossley_damping(const DesiredContact& desired, const Situation& at);
/// c [N s/m] of a damper with that rebound which acts only while the desired spring is pressed.
double one_sided_damping(const DesiredContact& desired, const Situation& at);

}  // namespace hookpoint::translation
