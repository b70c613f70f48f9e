// Damping of other force laws that leaves the rebound of a spring and damper.
#pragma once

#include "translation/situation.h"

namespace hookpoint::translation {

/// Rebound e of the mass on the wanted spring and damper.
double wanted_rebound(const Wanted& wanted, const Situation& at);
/// alpha [s/m] of a Hunt and Crossley force f (1 + alpha v) with that rebound at impact_speed.
double hunt_crossley_damping(const Wanted& wanted, const Situation& at);
/// c [N s/m] of a damper with that rebound which acts only while the wanted spring is pressed.
double one_sided_damping(const Wanted& wanted, const Situation& at);

}  // namespace hookpoint::translation
