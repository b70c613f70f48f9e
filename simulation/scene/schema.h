// All classes of an experiment as the language sees them: world, robots, ground, controllers. One
// description each, from which checking, `describe` and the manual come.
#pragma once

#include <string>
#include <vector>

#include "control/registry.h"
#include "language/schema/schema.h"
#include "simulation/scene/peer_choices.h"

namespace hookpoint::simulation {

/// World, Simulator, Robot and what stands inside them, Controllers; and robots written as URDF.
void add_experiment_classes(language::Schema& schema, const PeerChoices& peers);

// The parts of it, one a file that loads their objects, too.
void add_world_classes(language::Schema& schema, const PeerChoices& peers);
void add_force_classes(language::Schema& schema);
void add_loop_class(language::Schema& schema);
void add_robot_classes(language::Schema& schema);
void add_chain_class(language::Schema& schema);
void add_link_class(language::Schema& schema);
void add_obstacle_classes(language::Schema& schema);
void add_shape_classes(language::Schema& schema);
void add_contact_point_class(language::Schema& schema);
void add_material_class(language::Schema& schema);
void add_terrain_classes(language::Schema& schema);
void add_component_classes(language::Schema& schema);
void add_record_class(language::Schema& schema);
void add_movie_class(language::Schema& schema);
void add_expect_class(language::Schema& schema);

/// A component class as the language sees it: its ports, and the fields of the stub around it.
language::ClassSchema component_schema(const control::ComponentClass& type);
/// "" or why a class that the program did not come with cannot join the classes of `schema`.
std::string component_class_problem(const language::Schema& schema,
                                    const control::ComponentClass& type);
/// "Controller.", "Sensor.", "Gain", ...: what may stand wherever a controller may.
std::vector<std::string> component_families();

}  // namespace hookpoint::simulation
