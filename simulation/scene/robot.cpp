#include <fmt/format.h>

#include "output/text/number.h"
#include "simulation/experiment.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"

namespace hookpoint::simulation {
namespace {

std::vector<FieldSchema> mass_fields(const std::string& axes) {
  return {
      not_negative(
          number_field("mass", "kg", "",
                       "of the body; shared over shapes without a mass of their own, by volume")),
      vector_field("center_of_mass", "m", "",
                   axes + " axes; if not given, that of the shapes, or the origin"),
      list_field("inertia", "kg.m^2", 6, 6, "",
                 "matrix elements Ixx,Iyy,Izz,Ixy,Ixz,Iyz about the centre of mass, " + axes +
                     " axes; if not given, that of the shapes"),
  };
}

/// What every body publishes of its contact with the ground.
std::vector<FieldSchema> contact_ports() {
  return {
      port_only(Direction::output,
                vector_field("contact.force", "N", "",
                             "impulse of the ground on the body over the last step by the step's "
                             "length, world axes; at first 0")),
      port_only(Direction::output,
                number_field("contact.count", "", "",
                             "boundary points that carried force in the last step"))};
}

/// How a body's velocities change, for whom `body` is.
std::vector<FieldSchema> acceleration_ports(const std::string& body) {
  return {port_only(Direction::output,
                    vector_field("linear_acceleration", "m/s^2", "",
                                 "change of `velocity` of " + body +
                                     " over the last step by its length, world axes; at first 0")),
          port_only(Direction::output, vector_field("angular_acceleration", "rad/s^2", "",
                                                    "the same of `angular_velocity`"))};
}

/// A base's motion: the initial one when assigned, the present one when read.
std::vector<FieldSchema> motion_fields() {
  return {
      with_port(Direction::output,
                vector_field("location", "m", "0,0,0", "of the base frame's origin, world axes")),
      with_port(
          Direction::output,
          orientation_field("orientation",
                            "base to world axes: quaternion w,x,y,z, or roll,pitch,yaw angles")),
      with_port(Direction::output,
                vector_field("velocity", "m/s", "0,0,0", "of the base frame's origin, world axes")),
      with_port(Direction::output,
                vector_field("angular_velocity", "rad/s", "0,0,0", "world axes")),
  };
}

/// The same of a body that moves with others: read only. `position` is the name of its place.
std::vector<FieldSchema> motion_ports(const std::string& position, const std::string& body) {
  return {
      port_only(Direction::output,
                vector_field(position, "m", "", "of " + body + " frame's origin, world axes")),
      port_only(Direction::output,
                orientation_field("orientation", body + " to world axes, w,x,y,z")),
      port_only(Direction::output,
                vector_field("velocity", "m/s", "", "of " + body + " frame's origin, world axes")),
      port_only(Direction::output,
                vector_field("angular_velocity", "rad/s", "", "of " + body + ", world axes")),
  };
}

language::ClassSchema robot_class() {
  language::ClassSchema robot;
  robot.name = "Robot";
  robot.doc = "a base that carries any number of chains of links";
  robot.naming = language::Naming::required;
  robot.top_level = true;
  robot.children = {"Base.", "Chain"};
  append(robot.children, component_families());
  robot.fields = motion_ports("position", "the base's");
  append(robot.fields, acceleration_ports("the base's origin"));
  append(robot.fields, contact_ports());
  append(robot.fields,
         {port_only(Direction::output,
                    number_field("kinetic_energy", "J", "", "of all its bodies that move")),
          port_only(Direction::output,
                    number_field("potential_energy", "J", "",
                                 "of the same in gravity, zero at the world's origin")),
          port_only(Direction::output,
                    vector_field("center_of_mass", "m", "", "of the same, world axes"))});
  return robot;
}

language::ClassSchema base_class(bool mobile) {
  language::ClassSchema base;
  base.name = mobile ? "Base.mobile" : "Base.fixed";
  base.doc = mobile ? "a robot's body, free to move"
                    : "a robot's body, held in the world; its mass plays no part";
  base.default_name = "base";
  base.children = {"Shape.", "ContactPoint"};
  base.fields = motion_fields();
  if (mobile) {
    append(
        base.fields,
        {object_field("rest_on", "Terrain.",
                      "start at rest on this ground instead of at location and orientation: z "
                      "along the tile's normal, "
                      "lowest boundary points at the contact law's static penetration (touching, "
                      "for a peer)"),
         list_field("at", "m", 2, 2, "0,0", "with rest_on: world x,y of the base frame's origin"),
         number_field("yaw", "rad", "0", "with rest_on: turn about the ground's normal")});
  }
  append(base.fields, mass_fields("base"));
  append(base.fields, acceleration_ports("the base's origin"));
  append(base.fields, contact_ports());
  return base;
}

language::ClassSchema chain_class() {
  language::ClassSchema chain;
  chain.name = "Chain";
  chain.doc = "a leg or an arm: links in series, joined to the base at the hip";
  chain.naming = language::Naming::required;
  chain.top_level = true;
  chain.children = {"Link"};
  append(chain.children, component_families());
  chain.fields = {
      vector_field("hip_distance", "m", "0,0,0", "the hip's position, base axes"),
      orientation_field("hip_orientation",
                        "hip to base axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
      port_only(Direction::output,
                vector_field("hip_force", "N", "",
                             "of the chain on the base in the step just taken, world axes; "
                             "engine dts with a force law only")),
      port_only(Direction::output,
                vector_field("hip_moment", "N.m", "", "the same: moment about the hip")),
  };
  return chain;
}

/// A number in `unit` for a revolute joint, in `sliding` for a prismatic one.
FieldSchema joint_field(std::string name, std::string unit, std::string sliding,
                        std::string default_text, std::string doc) {
  return or_unit(
      std::move(sliding), "joint", "prismatic",
      number_field(std::move(name), std::move(unit), std::move(default_text), std::move(doc)));
}

/// "if not given, 1000 N.m/rad (prismatic: 1e5 N/m)".
std::string unless_given(double (*usual)(JointKind), const char* unit, const char* sliding) {
  return fmt::format("if not given, {} {} (prismatic: {} {})",
                     output::rounded(usual(JointKind::revolute)), unit,
                     output::rounded(usual(JointKind::prismatic)), sliding);
}

std::vector<FieldSchema> joint_fields() {
  return {
      choice_field("joint", {"revolute", "prismatic"}, "revolute",
                   "turns about, or slides along, the link's own z"),
      with_port(Direction::output,
                joint_field("angle", "rad", "m", "0",
                            "joint variable, added to dhangle (prismatic: to dhoffset)")),
      with_port(Direction::output, joint_field("rate", "rad/s", "m/s", "0", "d(angle)/dt")),
      with_port(Direction::both, joint_field("torque", "N.m", "N", "0",
                                             "of the joint's drive: constant unless wired")),
      port_only(Direction::output, joint_field("acceleration", "rad/s^2", "m/s^2", "",
                                               "d(rate)/dt, of the step just taken")),
      port_only(Direction::output,
                joint_field("total_torque", "N.m", "N", "",
                            "of the drive, spring, damping, friction and stops together, in the "
                            "step just taken")),
      joint_field("lower_limit", "rad", "m", "", "least angle; none if not given"),
      joint_field("upper_limit", "rad", "m", "", "greatest angle; none if not given"),
      positive(joint_field("limit_stiffness", "N.m/rad", "N/m", "",
                           "spring of the stop beyond a limit; " +
                               unless_given(default_limit_stiffness, "N.m/rad", "N/m"))),
      not_negative(joint_field(
          "limit_damping", "N.m.s/rad", "N.s/m", "",
          "damper of the stop; " + unless_given(default_limit_damping, "N.m.s/rad", "N.s/m"))),
      not_negative(joint_field("damping", "N.m.s/rad", "N.s/m", "0", "torque = -damping rate")),
      not_negative(joint_field("friction", "N.m", "N", "0",
                               "dry friction: a joint that carries less than this sticks; one that "
                               "slips is braked by it")),
      positive(joint_field("friction_deflection", "rad", "m", "",
                           "so far a joint that sticks gives way, as a spring, before it slips; " +
                               unless_given(default_friction_deflection, "rad", "m"))),
      positive(joint_field("friction_speed", "rad/s", "m/s", "",
                           "rate at which a joint that sticks is damped by its whole friction; " +
                               unless_given(default_friction_speed, "rad/s", "m/s"))),
      not_negative(joint_field("stiffness", "N.m/rad", "N/m", "0",
                               "joint spring: torque = -stiffness (angle - rest_angle)")),
      joint_field("rest_angle", "rad", "m", "0", "angle at which the joint spring is slack"),
  };
}

language::ClassSchema link_class() {
  language::ClassSchema link;
  link.name = "Link";
  link.doc =
      "a segment and the joint that carries it, in modified Denavit-Hartenberg form: "
      "Rot_x(dhtwist) Trans_x(dhlength) Rot_z(dhangle) Trans_z(dhoffset) from the preceding frame, "
      "ahead of which may stand any fixed transform";
  link.naming = language::Naming::required;
  link.top_level = true;
  link.children = {"Shape.", "ContactPoint"};
  append(link.children, component_families());
  link.fields = {
      vector_field("joint_location", "m", "0,0,0",
                   "of a fixed transform ahead of the dh numbers, preceding link's axes"),
      orientation_field("joint_orientation",
                        "of that transform, to the preceding link's axes: quaternion w,x,y,z, or "
                        "roll,pitch,yaw angles"),
      number_field("dhlength", "m", "0", "a: along the preceding frame's x"),
      number_field("dhtwist", "rad", "0", "alpha: about the preceding frame's x"),
      number_field("dhoffset", "m", "0", "d: along the link's own z"),
      number_field("dhangle", "rad", "0", "theta: about the link's own z, at joint angle 0"),
  };
  append(link.fields, mass_fields("link"));
  append(link.fields, joint_fields());
  append(link.fields, motion_ports("location", "the link's"));
  append(link.fields, acceleration_ports("the link's origin"));
  append(link.fields, contact_ports());
  return link;
}

}  // namespace

void add_robot_classes(language::Schema& schema) {
  schema.add(robot_class());
  schema.add(base_class(false));
  schema.add(base_class(true));
  schema.add(chain_class());
  schema.add(link_class());
}

}  // namespace hookpoint::simulation
