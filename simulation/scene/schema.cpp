#include "simulation/scene/schema.h"

#include "simulation/scene/absent.h"
#include "simulation/scene/mjcf/mjcf.h"
#include "simulation/scene/sdf/sdf.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

using language::Direction;
using language::FieldSchema;
using language::FieldType;

namespace {

/// Every number of an object is readable by its trail.
void make_readable(language::ClassSchema& schema) {
  for (FieldSchema& field : schema.fields) {
    const bool numeric = field.type == FieldType::number || field.type == FieldType::integer ||
                         field.type == FieldType::numbers || field.type == FieldType::boolean ||
                         field.type == FieldType::orientation;
    if (numeric && field.port == Direction::none) field.port = Direction::output;
  }
}

}  // namespace

void add_experiment_classes(language::Schema& schema, const PeerChoices& peers) {
  for (const char* ending : {".urdf", ".xacro"}) schema.add_reader(ending, include_urdf);
  schema.add_reader(".mjcf", include_mjcf);
  schema.add_reader(".sdf", include_sdf);
  add_absent_words();
  language::Schema classes;
  add_world_classes(classes, peers);
  add_force_classes(classes);
  add_robot_classes(classes);
  add_loop_class(classes);
  add_chain_class(classes);
  add_link_class(classes);
  add_shape_classes(classes);
  add_obstacle_classes(classes);
  add_contact_point_class(classes);
  add_material_class(classes);
  add_terrain_classes(classes);
  add_component_classes(classes);
  add_record_class(classes);
  add_movie_class(classes);
  add_expect_class(classes);
  for (const auto& [name, type] : classes.classes()) {
    if (schema.find(name) != nullptr) continue;  // the language's own
    language::ClassSchema readable = type;
    make_readable(readable);
    schema.add(std::move(readable));
  }
}

}  // namespace hookpoint::simulation
