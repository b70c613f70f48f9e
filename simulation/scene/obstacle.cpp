// Obstacle: a body of the world that no robot carries; it stands, moves as prescribed, or is free.
#include <fmt/format.h>

#include <algorithm>

#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::boolean_field;
using language::Direction;
using language::Fields;
using language::number_field;
using language::object_field;
using language::orientation_field;
using language::port_only;
using language::vector_field;

namespace {

namespace obstacle_field {
constexpr const char *material = "material", *free = "free";
}

const Fields<ObstacleSpec>& placed_obstacle_fields() {
  static const Fields<ObstacleSpec> fields{
      vector_field("location", "m", &ObstacleSpec::location,
                   "of the shape's frame at first, world axes"),
      orientation_field("orientation", &ObstacleSpec::orientation,
                        "at first, shape to world axes: quaternion w,x,y,z, or roll,pitch,yaw "
                        "angles"),
      with_port(Direction::both, vector_field("velocity", "m/s", &ObstacleSpec::velocity,
                                              "of its frame's origin, world axes; it moves by it "
                                              "whatever touches it")),
      with_port(Direction::both, vector_field("angular_velocity", "rad/s",
                                              &ObstacleSpec::angular_velocity, "world axes")),
  };
  return fields;
}

language::ClassSchema obstacle_class(const std::string& kind, const char* what,
                                     std::vector<FieldSchema> own) {
  language::ClassSchema obstacle;
  obstacle.name = "Obstacle." + kind;
  obstacle.doc = fmt::format("{} that robots touch under touch = shapes", what);
  obstacle.naming = language::Naming::required;
  obstacle.top_level = true;
  obstacle.fields = std::move(own);
  append(obstacle.fields, schemas(placed_obstacle_fields()));
  append(obstacle.fields,
         {object_field(obstacle_field::material, "Material",
                       "of its surface; if not given, a material with all defaults"),
          boolean_field(obstacle_field::free, "false",
                        "true: it has mass and moves as what touches it makes it move, a Robot "
                        "with this one shape")});
  append(obstacle.fields, mass_fields("shape"));
  append(obstacle.fields,
         {port_only(Direction::output,
                    number_field("work", "J", "", "of its motion on bodies since the start")),
          port_only(Direction::output,
                    vector_field("position", "m", "", "of its frame's origin now, world axes"))});
  append(obstacle.fields, surface_contact_ports());
  return obstacle;
}

/// A robot without chains whose base has the one shape.
void add_free(const language::Object& object, ObstacleSpec obstacle, Loading& loading) {
  RobotSpec robot;
  robot.name = std::move(obstacle.name);
  robot.mobile = true;
  robot.base = load_single_shape(object, std::move(obstacle.geometry), loading);
  robot.location = obstacle.location;
  robot.orientation = obstacle.orientation;
  robot.velocity = obstacle.velocity;
  robot.angular_velocity = obstacle.angular_velocity;
  loading.bodies.emplace(
      &object,
      BodyIndex{static_cast<int>(loading.experiment.robots.size()), 0, {}, 0, robot.base.mass});
  loading.bases.push_back(&object);
  loading.experiment.robots.push_back(std::move(robot));
}

/// Whether robots touch obstacles that are not free; says what to do where they do not. A peer that
/// has none says so by itself.
bool obstacles_touch(const language::Object& object, Loading& loading) {
  if (loading.experiment.touch == "shapes") return true;
  loading.error(object.position,
                "bodies touch obstacles under touch = shapes alone; write it in the World");
  return false;
}

}  // namespace

void add_obstacle_classes(language::Schema& schema) {
  schema.add(obstacle_class("Box", "a box", geometry_fields("Box")));
  schema.add(obstacle_class("Sphere", "a ball", geometry_fields("Sphere")));
  schema.add(obstacle_class("Cylinder", "a cylinder about its z", geometry_fields("Cylinder")));
  schema.add(obstacle_class("Capsule", "a cylinder about its z with half a ball at each end",
                            geometry_fields("Capsule")));
  schema.add(obstacle_class("Hull", "the convex hull of points", geometry_fields("Hull")));
}

void load_obstacles(const language::Object& world, Loading& loading) {
  for (const language::Object* object : world.children_of("Obstacle.")) {
    const std::size_t errors_before = loading.diagnostics.error_count();
    ObstacleSpec obstacle = load_fields(*object, placed_obstacle_fields());
    obstacle.name = name_within(*object, world);
    obstacle.geometry = load_geometry(*object, loading);
    if (loading.diagnostics.error_count() != errors_before) continue;
    if (object->boolean(obstacle_field::free)) {
      add_free(*object, std::move(obstacle), loading);
      continue;
    }
    for (const char* field : {mass_field::mass, mass_field::center_of_mass, mass_field::inertia}) {
      if (object->given(field))
        loading.error(
            place_of(*object, field),
            fmt::format("{} is that of a free obstacle; add `free = true` or leave it out", field));
    }
    if (!obstacles_touch(*object, loading)) continue;
    obstacle.material = material_index(*object, loading);
    loading.experiment.obstacles.push_back(std::move(obstacle));
  }
}

}  // namespace hookpoint::simulation
