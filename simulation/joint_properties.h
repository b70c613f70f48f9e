// What a joint does by itself, as its Link says.
#pragma once

#include "dts/joint_forces.h"
#include "simulation/experiment.h"

namespace hookpoint::simulation {

/// Springs, dampers, dry friction and stops of the link's joint.
dts::JointProperties<double> joint_properties(const LinkSpec& link);

}  // namespace hookpoint::simulation
