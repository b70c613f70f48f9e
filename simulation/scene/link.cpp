// Link: a body of a chain and the joint that carries it.
#include <fmt/format.h>

#include <algorithm>

#include "simulation/experiment/start_problems.h"
#include "simulation/scene/body.h"
#include "simulation/scene/fixed_part.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"
#include "text/number.h"

namespace hookpoint::simulation {

using language::append;
using language::choice_field;
using language::Direction;
using language::Fields;
using language::FieldSchema;
using language::LoadedField;
using language::number_field;
using language::orientation_field;
using language::port_only;
using language::vector_field;

namespace {

namespace link_field {
constexpr const char *joint = "joint", *angle = "angle", *lower_limit = "lower_limit";
}
namespace friction_field {
constexpr const char *at_rest = "static_friction", *fall = "stribeck_velocity";
}

/// Where the link's frame is in the preceding one at joint angle 0.
const Fields<LinkSpec>& frame_fields() {
  static const Fields<LinkSpec> fields{
      vector_field("joint_location", "m", &LinkSpec::joint_location,
                   "of a fixed transform ahead of the dh numbers, preceding link's axes"),
      orientation_field("joint_orientation", &LinkSpec::joint_orientation,
                        "of that transform, to the preceding link's axes: quaternion w,x,y,z, or "
                        "roll,pitch,yaw angles"),
      number_field("dhlength", "m", &LinkSpec::a, "a: along the preceding frame's x"),
      number_field("dhtwist", "rad", &LinkSpec::alpha, "alpha: about the preceding frame's x"),
      number_field("dhoffset", "m", &LinkSpec::d, "d: along the link's own z"),
      number_field("dhangle", "rad", &LinkSpec::theta,
                   "theta: about the link's own z, at joint angle 0"),
  };
  return fields;
}

std::vector<std::string> joint_names() {
  std::vector<std::string> names;
  for (const JointType& type : joint_types) names.emplace_back(type.name);
  names.emplace_back(fixed_joint);
  return names;
}

/// In the unit that the joint's type gives the quantity.
template <class Described>
Described by_joint(const char* JointUnits::*quantity, Described field) {
  field.unit = joint_types[0].units.*quantity;
  for (const JointType& type : joint_types) {
    if (type.units.*quantity == field.unit) continue;
    field = or_unit(type.units.*quantity, link_field::joint, type.name, std::move(field));
  }
  return field;
}
LoadedField<LinkSpec> joint_field(std::string_view name, const char* JointUnits::*quantity,
                                  auto LinkSpec::*member, std::string doc) {
  return by_joint(quantity, number_field(name, "", member, std::move(doc)));
}
FieldSchema joint_port(std::string_view name, const char* JointUnits::*quantity, std::string doc) {
  return port_only(Direction::output,
                   by_joint(quantity, number_field(name, "", "", std::move(doc))));
}

/// A constant of joints of which each type has its own default: what it means, then "; if not
/// given, 1000 N.m/rad (prismatic: 100000 N/m)".
LoadedField<LinkSpec> constant_field(std::string_view name, const char* JointUnits::*quantity,
                                     double LinkSpec::*member, double JointDefaults::*usual,
                                     std::string doc) {
  const auto text = [&](const JointType& type) {
    return fmt::format("{} {}", text::rounded(type.defaults.*usual), type.units.*quantity);
  };
  doc += "; if not given, " + text(joint_types[0]);
  for (const JointType& type : joint_types) {
    if (text(type) != text(joint_types[0])) doc += fmt::format(" ({}: {})", type.name, text(type));
  }
  return without_default(joint_field(name, quantity, member, std::move(doc)));
}

const Fields<LinkSpec>& joint_fields() {
  using Units = JointUnits;
  using Usual = JointDefaults;
  static const Fields<LinkSpec> fields{
      choice_field(
          link_field::joint, joint_names(), joint_types[0].name,
          "turns about, or slides along, the link's own z; fixed: the link is a part of the "
          "body that carries it"),
      with_port(Direction::output,
                joint_field(link_field::angle, &Units::position, &LinkSpec::angle,
                            "joint variable, added to dhangle (prismatic: to dhoffset)")),
      with_port(Direction::output,
                joint_field("rate", &Units::rate, &LinkSpec::rate, "d(angle)/dt")),
      with_port(Direction::both, joint_field("torque", &Units::torque, &LinkSpec::torque,
                                             "of the joint's drive: constant unless wired")),
      joint_port("acceleration", &Units::acceleration, "d(rate)/dt, of the step just taken"),
      joint_port("total_torque", &Units::torque,
                 "of the drive, spring, damping, friction, stops and, of a coupled joint, the "
                 "coupling together, in the step just taken"),
      joint_port("gravity_torque", &Units::torque,
                 "what gravity takes of the drive to hold the joint where it is"),
      joint_port("bias_torque", &Units::torque,
                 "what gravity and velocities take of the drive at accelerations of 0"),
      port_only(
          Direction::output,
          vector_field("reaction_force", "N", "",
                       "of the body that carries it, at their joint, world axes: in balance with "
                       "the contact forces shown and the torques of the step just taken; "
                       "engine dts with a force law only")),
      port_only(Direction::output, vector_field("reaction_moment", "N.m", "",
                                                "the same: moment about the link's origin")),
      joint_field(link_field::lower_limit, &Units::position, &LinkSpec::lower_limit,
                  "least angle; none if not given"),
      joint_field("upper_limit", &Units::position, &LinkSpec::upper_limit,
                  "greatest angle; none if not given"),
      positive(constant_field("limit_stiffness", &Units::stiffness, &LinkSpec::limit_stiffness,
                              &Usual::limit_stiffness, "spring of the stop beyond a limit")),
      not_negative(constant_field("limit_damping", &Units::damping, &LinkSpec::limit_damping,
                                  &Usual::limit_damping, "damper of the stop")),
      not_negative(
          joint_field("damping", &Units::damping, &LinkSpec::damping, "torque = -damping rate")),
      not_negative(joint_field("friction", &Units::torque, &LinkSpec::friction,
                               "dry friction: a joint that carries less than this sticks; one that "
                               "slips is braked by it")),
      not_negative(joint_field(friction_field::at_rest, &Units::torque, &LinkSpec::static_friction,
                               "of a joint that sticks, at least `friction`: it starts to slip "
                               "beyond this; the same as `friction` if not given")),
      not_negative(joint_field(friction_field::fall, &Units::rate, &LinkSpec::stribeck_velocity,
                               "v_s of friction + (static_friction - friction) exp(-(rate/v_s)^2) "
                               "of a joint that slips; 0: friction falls as soon as it slips")),
      positive(constant_field("friction_deflection", &Units::position,
                              &LinkSpec::friction_deflection, &Usual::friction_deflection,
                              "deflection of a joint that sticks, as a spring, before it slips")),
      positive(constant_field("friction_speed", &Units::rate, &LinkSpec::friction_speed,
                              &Usual::friction_speed,
                              "rate at which a joint that sticks is damped by its whole friction")),
      not_negative(joint_field("stiffness", &Units::stiffness, &LinkSpec::stiffness,
                               "joint spring: torque = -stiffness (angle - rest_angle)")),
      joint_field("rest_angle", &Units::position, &LinkSpec::rest_angle,
                  "angle at which the joint spring is slack"),
      positive(joint_field("effort_limit", &Units::torque, &LinkSpec::effort_limit,
                           "greatest `torque` that the drive gives, either way: what is commanded "
                           "beyond it is not exerted, and a notice of the run says so; none if not "
                           "given")),
      positive(
          joint_field("velocity_limit", &Units::rate, &LinkSpec::velocity_limit,
                      "greatest `rate` to which the drive brings its joint, either way: of its "
                      "torque it holds back what would move it faster, and never brakes; none "
                      "if not given")),
      not_negative(joint_field("rotor_inertia", &Units::inertia, &LinkSpec::rotor_inertia,
                               "of motor and gears, as the joint sees it: gear ratio squared times "
                               "the rotor's own")),
  };
  return fields;
}

/// The joint of `object`'s type with the constants that such a joint has which states none.
LinkSpec usual_joint(const language::Object& object) {
  LinkSpec link;
  if (is_fixed(object)) return link;
  language::assign(*object.find(link_field::joint), link.joint);
  const JointDefaults& usual = joint_type(link.joint).defaults;
  link.friction_deflection = usual.friction_deflection;
  link.friction_speed = usual.friction_speed;
  link.limit_stiffness = usual.limit_stiffness;
  link.limit_damping = usual.limit_damping;
  return link;
}

void check_limits(const language::Object& object, const LinkSpec& link, Loading& loading) {
  if (link.lower_limit && link.upper_limit && *link.lower_limit >= *link.upper_limit) {
    return loading.error(place_of(object, link_field::lower_limit),
                         "lower_limit is not below upper_limit; exchange them");
  }
  if (const std::string problem = angle_problem(link); !problem.empty())
    loading.error(place_of(object, link_field::angle), problem);
}

void check_friction(const language::Object& object, const LinkSpec& link, Loading& loading) {
  if (link.static_friction && *link.static_friction < link.friction) {
    loading.error(place_of(object, friction_field::at_rest),
                  "static_friction is below friction; a joint that sticks holds at least as much "
                  "as one that slips");
  }
  if (!link.static_friction && object.given(friction_field::fall)) {
    loading.error(place_of(object, friction_field::fall),
                  "stribeck_velocity says how fast friction falls from static_friction: give that "
                  "too, or leave this out");
  }
}

/// A joint that does not move has nothing of its own.
void check_fixed(const language::Object& object, Loading& loading) {
  for (const language::FieldSchema& field : object.schema->fields) {
    if (field.name == link_field::joint || !is_of_joint(field.name) || !object.given(field.name))
      continue;
    loading.error(place_of(object, field.name),
                  fmt::format("a fixed joint has no `{}`: leave it out", field.name));
  }
}

}  // namespace

bool is_of_joint(std::string_view field) {
  const auto has = [&](const auto& fields) {
    return std::ranges::find(fields, field, &FieldSchema::name) != fields.end();
  };
  return has(joint_fields()) || has(coupling_fields());
}

void add_link_class(language::Schema& schema) {
  language::ClassSchema link;
  link.name = "Link";
  link.doc =
      "a segment and the joint that carries it, in modified Denavit-Hartenberg form: "
      "Rot_x(dhtwist) Trans_x(dhlength) Rot_z(dhangle) Trans_z(dhoffset) from the preceding frame, "
      "ahead of which may stand any fixed transform";
  link.naming = language::Naming::required;
  link.top_level = true;
  link.children = {"Shape.", "ContactPoint", "Chain"};
  append(link.children, component_families());
  link.fields = schemas(frame_fields());
  append(link.fields, mass_fields("link"));
  link.fields.push_back(foot_material_field(of_its_shapes));
  append(link.fields, schemas(joint_fields()));
  append(link.fields, coupling_fields());
  append(link.fields, motion_ports("location", "the link's"));
  append(link.fields, acceleration_ports("the link's origin"));
  append(link.fields, contact_ports());
  schema.add(std::move(link));
}

LinkSpec load_link(const language::Object& object, std::string name, Loading& loading) {
  LinkSpec link = usual_joint(object);
  link.body = load_body(object, std::move(name), false, loading);
  store_fields(object, frame_fields(), link);
  if (is_fixed(object)) {
    check_fixed(object, loading);
    return link;
  }
  store_fields(object, joint_fields(), link);
  check_limits(object, link, loading);
  check_friction(object, link, loading);
  return link;
}

}  // namespace hookpoint::simulation
