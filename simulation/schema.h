// All classes of an experiment as the language sees them: world, robots, ground, controllers. One
// description each, from which checking, `describe` and the manual come.
#pragma once

#include "language/schema.h"

namespace hookpoint::simulation {

/// World, Simulator, Robot and what stands inside them, Controllers.
void add_experiment_classes(language::Schema& schema);

// The parts of it, one a file.
void add_world_classes(language::Schema& schema);
void add_robot_classes(language::Schema& schema);
void add_shape_classes(language::Schema& schema);
void add_ground_classes(language::Schema& schema);
void add_control_classes(language::Schema& schema);

}  // namespace hookpoint::simulation
