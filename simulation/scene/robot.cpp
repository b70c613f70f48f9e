// Robot: a base and its chains. Base: the body that carries them.
#include <fmt/format.h>

#include <algorithm>

#include "simulation/experiment/start_problems.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::boolean_field;
using language::choice_field;
using language::Direction;
using language::Fields;
using language::list_field;
using language::number_field;
using language::object_field;
using language::orientation_field;
using language::port_only;
using language::vector_field;

namespace {

/// A base's motion: the initial one when assigned, the present one when read.
const Fields<RobotSpec>& motion_fields() {
  static const Fields<RobotSpec> fields{
      with_port(Direction::output, vector_field(base_field::location, "m", &RobotSpec::location,
                                                "of the base frame's origin, world axes")),
      with_port(
          Direction::output,
          orientation_field(base_field::orientation, &RobotSpec::orientation,
                            "base to world axes: quaternion w,x,y,z, or roll,pitch,yaw angles")),
      with_port(Direction::output, vector_field(base_field::velocity, "m/s", &RobotSpec::velocity,
                                                "of the base frame's origin, world axes")),
      with_port(Direction::output, vector_field(base_field::angular_velocity, "rad/s",
                                                &RobotSpec::angular_velocity, "world axes")),
  };
  return fields;
}

constexpr const char* self_contact_field = "self_contact";

language::ClassSchema robot_class() {
  language::ClassSchema robot;
  robot.name = "Robot";
  robot.doc = "a base that carries any number of chains of links";
  robot.naming = language::Naming::required;
  robot.top_level = true;
  robot.children = {"Base.", "Chain", "Loop"};
  append(robot.children, component_families());
  robot.fields = {boolean_field(self_contact_field, "false",
                                "under touch = shapes: its bodies touch each other, but for those "
                                "that a joint joins")};
  append(robot.fields, motion_ports("position", "the base's"));
  append(robot.fields, acceleration_ports("the base's origin"));
  append(robot.fields, contact_ports());
  append(
      robot.fields,
      {port_only(Direction::output,
                 number_field("kinetic_energy", "J", "", "of all its bodies that move")),
       port_only(Direction::output,
                 number_field("potential_energy", "J", "",
                              "of the same in gravity, zero at the world's origin")),
       port_only(Direction::output,
                 number_field("numerical_energy", "J", "",
                              "change of both since it is read, less the work of all that acts on "
                              "the robot: what the integration has added; not in engine simbody "
                              "where there is ground")),
       port_only(Direction::output,
                 vector_field("center_of_mass", "m", "", "of the same, world axes")),
       port_only(Direction::output,
                 vector_field("center_of_mass_velocity", "m/s", "", "of that, world axes")),
       port_only(Direction::output, number_field("total_mass", "kg", "", "of the same"))});
  return robot;
}

language::ClassSchema base_class(std::string name, std::string doc) {
  language::ClassSchema base;
  base.name = std::move(name);
  base.doc = std::move(doc);
  const bool mobile = base.name != "Base.fixed";
  base.default_name = "base";
  base.children = {"Shape.", "ContactPoint"};
  base.fields = schemas(motion_fields());
  if (base.name == "Base.planar") {
    append(
        base.fields,
        {choice_field("plane", {planes.begin(), planes.end()}, "xz",
                      "of world axes, through the base frame's origin at the start: the base "
                      "moves in it and turns about its normal, and nothing moves it otherwise")});
  }
  if (mobile) {
    append(
        base.fields,
        {object_field(base_field::rest_on, "Terrain.",
                      "start at rest on this ground instead of at location and orientation: z "
                      "along the tile's normal, "
                      "lowest boundary points at the contact law's static penetration (touching, "
                      "for another engine)"),
         list_field(base_field::at, "m", 2, 2, "0,0",
                    "with rest_on: world x,y of the base frame's origin"),
         number_field(base_field::yaw, "rad", "0", "with rest_on: turn about the ground's normal"),
         boolean_field(base_field::settled, "true",
                       "with rest_on: start in static balance, leaning and with tangential springs "
                       "stretched by its weight, so that nothing moves at time 0; a robot with "
                       "joints only where this is written, as one rigid body; false: level on its "
                       "points, with slack springs")});
  }
  append(base.fields, mass_fields("base"));
  base.fields.push_back(foot_material_field(of_its_shapes));
  append(base.fields, acceleration_ports("the base's origin"));
  append(base.fields, contact_ports());
  return base;
}

/// The plane of a base that has one.
void load_plane(const language::Object& object, RobotSpec& robot) {
  if (object.type != "Base.planar") return;
  const auto plane = std::ranges::find(planes, object.word("plane"));
  robot.plane_normal = static_cast<std::size_t>(plane - planes.begin());
}

void load_base(const language::Object& object, RobotSpec& robot, Loading& loading) {
  robot.mobile = object.type != "Base.fixed";
  robot.base = load_body(object, object.name, robot.mobile, loading);
  store_fields(object, motion_fields(), robot);
  load_plane(object, robot);
  for (const auto& [field, problem] :
       {std::pair{base_field::velocity, velocity_problem(robot)},
        std::pair{base_field::angular_velocity, angular_velocity_problem(robot)}}) {
    if (!problem.empty()) loading.error(place_of(object, field), problem);
  }
  if (!robot.mobile) return;
  const bool rests = object.given(base_field::rest_on);
  for (const char* field : {base_field::location, base_field::orientation}) {
    if (!rests || !object.given(field)) continue;
    loading.error(place_of(object, field),
                  fmt::format("rest_on already places the base; leave out {} or rest_on (`at` and "
                              "`yaw` go with rest_on)",
                              field));
  }
  for (const char* field : {base_field::at, base_field::yaw, base_field::settled}) {
    if (rests || !object.given(field)) continue;
    loading.error(
        place_of(object, field),
        fmt::format("{} goes with rest_on; add `rest_on = TERRAIN` or use location and orientation",
                    field));
  }
}

/// The one base, or null after saying why there is none.
const language::Object* find_base(const language::Object& robot, Loading& loading) {
  const std::vector<const language::Object*> bases = robot.children_of("Base.");
  if (bases.empty()) {
    loading.error(
        robot.position,
        fmt::format("robot `{}` has no base; give it a Base.fixed, Base.mobile or Base.planar",
                    robot.name));
    return nullptr;
  }
  for (std::size_t i = 1; i < bases.size(); ++i) {
    loading.error(bases[i]->position, "a second base; a robot has exactly one");
    loading.diagnostics.note(bases[0]->position, "the first is here");
  }
  return bases[0];
}

}  // namespace

void add_robot_classes(language::Schema& schema) {
  schema.add(robot_class());
  schema.add(base_class("Base.fixed", "a robot's body, held in the world; its mass plays no part"));
  schema.add(base_class("Base.mobile", "a robot's body, free to move"));
  schema.add(
      base_class("Base.planar", "a robot's body that moves in a plane, as a robot on a boom does"));
}

void load_robots(const language::Object& world, Loading& loading) {
  for (const language::Object* object : world.children_of("Robot")) {
    LoadedRobot robot;
    robot.spec.name = name_within(*object, world);
    robot.spec.self_contact = object->boolean(self_contact_field);
    const language::Object* base = find_base(*object, loading);
    if (base == nullptr) continue;
    load_base(*base, robot.spec, loading);
    const BodyIndex body{
        static_cast<int>(loading.experiment.robots.size()), 0, {}, 0, robot.spec.base.mass};
    loading.bodies.emplace(base, body);
    const std::size_t errors_before = loading.diagnostics.error_count();
    for (const language::Object* chain : object->children_of("Chain"))
      load_chain(*chain, *object, body, robot, loading);
    if (loading.diagnostics.error_count() == errors_before) check_joints(robot, loading);
    loading.bases.push_back(base);
    loading.experiment.robots.push_back(std::move(robot.spec));
  }
}

}  // namespace hookpoint::simulation
