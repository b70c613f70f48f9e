#include "simulation/scene/urdf/robot_include.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"
#include "simulation/scene/urdf/inertia_repair.h"
#include "simulation/scene/urdf/joint_rules.h"
#include "simulation/scene/urdf/robot_trails.h"
#include "simulation/wiring/port_search.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignField;
using language::ForeignObject;
using language::Position;
using language::Value;
using language::ValueKind;

/// Arguments that are fields of the base.
constexpr std::array base_fields{"location", "orientation", "velocity", "angular_velocity",
                                 "rest_on",  "at",          "yaw",      "settled"};
/// What follows the name of a joint in the argument that gives its rotor's inertia.
constexpr const char* rotor_argument = "_rotor_inertia";
/// What follows it in the argument for its initial angle where the name alone is another argument.
constexpr const char* angle_suffix = "_angle";

bool moves(const UrdfJoint& joint) {
  return joint.type != UrdfJointType::fixed && joint.type != UrdfJointType::floating;
}

/// A chain is called as its first joint; the base has its name already.
std::string chain_name(const UrdfJoint& hip) {
  const std::string name = identifier(hip.name);
  return name == "base" ? "base_" : name;
}

ForeignField word(const char* name, const std::string& text, const Position& place) {
  Value value;
  value.kind = ValueKind::word;
  value.text = text;
  value.position = place;
  return {name, {value}, place};
}

/// Position and orientation, unless they are the identity, to the fields of those names.
void add_pose(const Pose& X, const char* position, const char* orientation, const Position& place,
              ForeignObject& object) {
  const auto& [p, q] = X;
  if (p != Vector3d{}) object.fields.push_back(numbers(position, {p.x, p.y, p.z}, place));
  if (q != Quaterniond{})
    object.fields.push_back(numbers(orientation, {q.w, q.x, q.y, q.z}, place));
}

ForeignObject shape_object(const UrdfShape& of) {
  ForeignObject object{"", "", of.place, {}, {}};
  object.type = "Shape." + add_shape_fields(of, object);
  if (!of.touches) {
    Value no;
    no.kind = ValueKind::boolean;
    no.position = of.place;
    object.fields.push_back({"contact", {no}, of.place});
  }
  return object;
}

/// The turn about the world's z, from -pi to pi, of which `q` is a tilt away: q = tilt turn, where the
/// tilt's axis is level. 0 where the base's z points down.
double yaw_of(const Quaterniond& q) {
  constexpr double rounding = 1e-6;
  if (std::hypot(q.w, q.z) < rounding) return 0.;
  return q.w < 0. ? 2. * std::atan2(-q.z, -q.w) : 2. * std::atan2(q.z, q.w);
}

/// What a body weighs and how it looks to the ground.
void add_body(const UrdfBody& body, ForeignObject& object) {
  const auto& [mass, c, I] = body.mass;
  if (body.has_inertial) {
    const Position& place = body.inertial_place;
    object.fields.push_back(numbers("mass", {mass}, place));
    object.fields.push_back(numbers("center_of_mass", {c.x, c.y, c.z}, place));
    object.fields.push_back(numbers("inertia", {I.xx, I.yy, I.zz, I.xy, I.xz, I.yz}, place));
  }
  for (const UrdfShape& shape : body.shapes) object.children.push_back(shape_object(shape));
  for (const auto& [p, place, material] : body.points) {
    ForeignObject point{"ContactPoint", "", place, {}, {}};
    point.fields.push_back(numbers("location", {p.x, p.y, p.z}, place));
    if (!material.empty()) point.fields.push_back(word("material", material, place));
    object.children.push_back(std::move(point));
  }
}

ForeignObject material_object(const SurfaceMaterial& material, const std::string& name) {
  ForeignObject object{"Material", name, material.place, {}, {}};
  const auto add = [&](const char* field, const std::optional<double>& value) {
    if (value) object.fields.push_back(numbers(field, {*value}, material.place));
  };
  add("static_friction", material.friction);
  add("kinetic_friction", material.friction);
  add("normal_stiffness", material.stiffness);
  add("normal_damping", material.damping);
  add("restitution", material.restitution);
  add("rolling_resistance", material.rolling);
  add("spinning_resistance", material.spinning);
  if (!material.mujoco) return object;
  const contact::MujocoContact& stated = *material.mujoco;
  const auto add_list = [&](const char* field, const auto& values) {
    object.fields.push_back(numbers(field, {values.begin(), values.end()}, material.place));
  };
  add_list("solref", stated.row.reference);
  add_list("solimp", stated.row.impedance);
  add("impratio", stated.friction.impedance_ratio);
  Value cone;
  cone.kind = ValueKind::word;
  cone.text = stated.friction.elliptic ? "elliptic" : "pyramidal";
  cone.position = material.place;
  object.fields.push_back({"cone", {cone}, material.place});
  return object;
}

/// The controller `servo` of a joint, in the link that it drives, whose trail is `link`.
ForeignObject servo_object(const UrdfJoint& joint, const std::string& link,
                           const ForeignField& angle) {
  const UrdfServo& servo = *joint.servo;
  const bool slides = joint.type == UrdfJointType::prismatic;
  const Position& place = servo.place;
  ForeignObject object{"Controller.PD", "servo", place, {}, {}};
  const auto add = [&](const char* name, double value, const language::Dimension& unit) {
    object.fields.push_back(numbers(name, {value}, place));
    object.fields.back().values[0].quantity.dimension = unit;
  };
  const int length = slides ? 1 : 0, time = servo.of_rate ? -1 : 0;
  const language::Dimension measured{0, length, time, 1 - length};
  // Of N or N m per error, and per error a second.
  const language::Dimension gain{1, 2 - 2 * length, -2 - time, length - 1};
  const language::Dimension damping{1, gain.length, gain.time + 1, gain.angle};
  if (servo.goal || servo.of_rate) {
    add("goal", servo.goal.value_or(0.), measured);
  } else {
    object.fields.push_back({"goal", angle.values, place});
    object.fields.back().values[0].quantity.dimension = measured;
  }
  add("pconstant", servo.gain, gain);
  add("dconstant", servo.damping, damping);
  object.wires = {{link + (servo.of_rate ? ".rate" : ".angle"), "current"},
                  {"output", link + ".torque"}};
  if (!servo.of_rate) object.wires.push_back({link + ".rate", "rate_in"});
  return object;
}

}  // namespace

std::string add_shape_fields(const UrdfShape& of, ForeignObject& object) {
  const Position& place = of.place;
  std::string kind;
  const auto add = [&](const char* name, const std::vector<double>& values) {
    object.fields.push_back(numbers(name, values, place));
  };
  if (const auto* box = std::get_if<Box>(&of.spec.geometry)) {
    kind = "Box";
    add("dimensions", {box->dimensions.x, box->dimensions.y, box->dimensions.z});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&of.spec.geometry)) {
    kind = "Cylinder";
    add("radius", {cylinder->radius});
    add("length", {cylinder->length});
  } else if (const auto* capsule = std::get_if<Capsule>(&of.spec.geometry)) {
    kind = "Capsule";
    add("radius", {capsule->radius});
    add("length", {capsule->length});
  } else if (const auto* hull = std::get_if<Hull>(&of.spec.geometry)) {
    kind = "Hull";
    std::vector<double> coordinates;
    for (const Vector3d& p : hull->vertices) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
    add("points", coordinates);
  } else {
    kind = "Sphere";
    add("radius", {std::get<Sphere>(of.spec.geometry).radius});
  }
  add_pose({of.spec.location, of.spec.orientation}, "location", "orientation", place, object);
  if (!of.material.empty()) object.fields.push_back(word("material", of.material, place));
  return kind;
}

ForeignField numbers(const char* name, const std::vector<double>& of, const Position& place) {
  ForeignField field{name, {}, place};
  for (const double x : of) {
    Value& value = field.values.emplace_back();
    value.quantity.value = x;
    value.position = place;
  }
  return field;
}

std::string identifier(std::string text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::ranges::replace_if(
      text, [&](char c) { return !digit(c) && !letter(c); }, '_');
  if (text.empty() || digit(text[0])) text.insert(0, "_");
  return text;
}

std::vector<ForeignObject> RobotInclude::robot_objects(UrdfRobot& robot, const std::string& name,
                                                       bool box_shapes, bool placed) {
  take_rotors(robot);
  settle_followers(robot, report_);
  auto tree = assemble_urdf(robot, report_);
  if (!tree) return {};
  repair_base(*tree, robot);
  tell_repaired(robot);
  if (box_shapes) take_inertia_boxes(*tree);
  ForeignObject object{"Robot", name, robot.place, {}, {}};
  object.children.push_back(base_object(robot, *tree, placed));
  const bool mobile = object.children.front().type == "Base.mobile";
  for (const UrdfChain& chain : tree->chains) find_trails(robot, chain, name);
  for (const UrdfJoint& joint : robot.joints) starts_[joint.name] = start_argument(joint);
  const double sag = hold_argument();
  if (sag > 0.) holds_ = hold_joints(*tree, mobile, sag);
  for (const UrdfChain& chain : tree->chains) object.children.push_back(chain_object(robot, chain));
  settle_trails(object, report_);
  return {std::move(object)};
}

void RobotInclude::find_trails(const UrdfRobot& robot, const UrdfChain& chain,
                               const std::string& above) {
  const std::string trail = above + "." + chain_name(*chain.bodies.front().joint);
  for (const UrdfBody& body : chain.bodies)
    trails_[body.joint->name] = trail + "." + identifier(robot.links[body.link].name);
  for (const UrdfChain& carried : chain.carried)
    find_trails(robot, carried, trails_[chain.bodies.back().joint->name]);
}

/// Where a joint starts [rad, m].
double RobotInclude::start_argument(const UrdfJoint& joint) {
  const auto given = arguments_.find(angle_argument(joint));
  const bool is_number = given != arguments_.end() && given->second.values.size() == 1 &&
                         given->second.values[0].kind == ValueKind::number;
  return is_number ? given->second.values[0].quantity.value : start_of(joint);
}

void RobotInclude::lock_joints(std::span<UrdfRobot> robots) {
  const auto given = arguments_.find("lock");
  if (given == arguments_.end()) return;
  for (const Value& pattern : given->second.values) {
    if (pattern.kind != ValueKind::word && pattern.kind != ValueKind::text) {
      report_.error(given->second.position,
                    "the argument `lock` is names of joints, or patterns of them: lock = "
                    "\"*finger*\", \"*wrist*\"");
      return;
    }
    std::size_t fitting = 0;
    std::vector<std::string> names;
    for (UrdfRobot& robot : robots) {
      for (UrdfJoint& joint : robot.joints) {
        names.push_back(joint.name);
        if (!glob_fits(pattern.text, joint.name) &&
            !glob_fits(pattern.text, identifier(joint.name)))
          continue;
        ++fitting;
        if (!moves(joint)) continue;
        fix_joint(start_argument(joint), joint);
        ++robots.front().left_out["joint that `lock` fixes"];
      }
    }
    if (fitting > 0) continue;
    const std::string nearest = language::nearest_name(pattern.text, names);
    report_.error(given->second.position,
                  fmt::format("no joint fits `{}`{}", pattern.text,
                              nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
  }
}

/// What the arguments say of rotors goes before what the file says.
void RobotInclude::take_rotors(UrdfRobot& robot) {
  const auto give = [&](const std::string& argument, UrdfJoint& joint) {
    const auto given = arguments_.find(argument);
    if (given == arguments_.end() || given->second.values.empty()) return;
    const Value& value = given->second.values[0];
    joint.rotor_place = given->second.position;
    const std::string unit = joint.type == UrdfJointType::prismatic ? "a mass, in kg" : "in kg.m^2";
    const language::Dimension wanted = joint.type == UrdfJointType::prismatic
                                           ? language::Dimension{1, 0, 0, 0}
                                           : language::Dimension{1, 2, 0, 0};
    const bool plain =
        given->second.values.size() == 1 && value.kind == ValueKind::number &&
        (value.quantity.dimension.dimensionless() || value.quantity.dimension == wanted);
    if (plain && value.quantity.value >= 0.) {
      joint.rotor_inertia = value.quantity.value;
      return;
    }
    report_.error(given->second.position,
                  fmt::format("the argument `{}` is {} and not negative", argument, unit));
  };
  for (UrdfJoint& joint : robot.joints) {
    if (!moves(joint)) continue;
    if (joint.type != UrdfJointType::prismatic) give("rotor_inertia", joint);
    give(identifier(joint.name) + rotor_argument, joint);
  }
}

ForeignObject RobotInclude::base_object(const UrdfRobot& robot, const UrdfTree& tree, bool placed) {
  const UrdfBody& body = tree.base;
  const UrdfLink& link = robot.links[body.link];
  std::string kind = placed ? word_argument("base", {"mobile", "fixed"}) : "";
  // A root that is the world itself, as other readers take it, or that nothing could move.
  const bool is_world = link.name == "world" && !tree.floats;
  if (kind.empty() && !is_world && !tree.floats && !body.has_inertial)
    report_.remark(link.place,
                   fmt::format("link `{}`, the base, has no <inertial>: it is fixed", link.name));
  if (kind.empty()) kind = is_world || (!body.has_inertial && !tree.floats) ? "fixed" : "mobile";
  ForeignObject object{"Base." + kind, "", link.place, {}, {}};
  if (kind == "mobile") require_mass(link, body);
  for (const char* name : base_fields) {
    if (placed && is_given(name)) object.fields.push_back(arguments_.at(name));
  }
  if (robot.start) add_start(*robot.start, placed, object);
  add_body(body, object);
  return object;
}

/// What no argument says otherwise.
void RobotInclude::add_start(const UrdfStart& start, bool placed, ForeignObject& base) {
  const auto add = [&](const char* name, const std::vector<double>& values) {
    if (!placed || !is_given(name)) base.fields.push_back(numbers(name, values, base.position));
  };
  const auto& [p, q] = start.pose;
  const bool fixed = base.type == "Base.fixed";
  const bool rests = placed && is_given("rest_on");
  if (!rests) {
    add("location", {p.x, p.y, p.z});
    add("orientation", {q.w, q.x, q.y, q.z});
  }
  if (fixed) return;
  if (rests) {
    // The ground decides how high it stands and how it leans.
    if (p.x != 0. || p.y != 0.) add("at", {p.x, p.y});
    const double yaw = yaw_of(q);
    if (yaw != 0.) add("yaw", {yaw});
    tell_tilt(q, yaw);
  }
  const Vector3d &v = start.velocity, &w = start.angular_velocity;
  if (v != Vector3d{}) add("velocity", {v.x, v.y, v.z});
  if (w != Vector3d{}) add("angular_velocity", {w.x, w.y, w.z});
}

/// That the file has the base tilted, and `rest_on` does not.
void RobotInclude::tell_tilt(const Quaterniond& q, double yaw) {
  constexpr double least = 1e-6, degree = 0.017453292519943295;  // [rad]
  // Between the base's z and the world's: z . R z = 1 - 2 sin(tilt/2)^2.
  const double tilt = 2. * std::atan2(std::hypot(q.x, q.y), std::hypot(q.w, q.z));
  if (tilt < least) return;
  report_.remark(
      arguments_.at("rest_on").position,
      fmt::format("the file has its base tilted by {:.3g} deg, with the orientation "
                  "{:.6g},{:.6g},{:.6g},{:.6g} (w,x,y,z); rest_on starts it level, with "
                  "{:.6g},0,0,{:.6g} on level ground: leave out rest_on to start as the file "
                  "says, or give location and orientation in its place",
                  tilt / degree, q.w, q.x, q.y, q.z, std::cos(0.5 * yaw), std::sin(0.5 * yaw)));
}

ForeignObject RobotInclude::chain_object(const UrdfRobot& robot, const UrdfChain& of) {
  const std::vector<UrdfBody>& bodies = of.bodies;
  const UrdfJoint& hip = *bodies.front().joint;
  ForeignObject chain{"Chain", chain_name(hip), hip.place, {}, {}};
  add_pose(bodies.front().joint_pose, "hip_distance", "hip_orientation", hip.place, chain);
  for (const UrdfBody& body : bodies) {
    const UrdfJoint& joint = *body.joint;
    const UrdfLink& link = robot.links[body.link];
    ForeignObject object{"Link", identifier(link.name), joint.place, {}, {}};
    if (joint.type == UrdfJointType::prismatic)
      object.fields.push_back(word("joint", "prismatic", joint.place));
    if (&body != &bodies.front())
      add_pose(body.joint_pose, "joint_location", "joint_orientation", joint.place, object);
    const auto held = holds_.find(&joint);
    add_joint(joint, held == holds_.end() ? UrdfHold{} : held->second, object);
    add_body(body, object);
    chain.children.push_back(std::move(object));
  }
  for (const UrdfChain& carried : of.carried)
    chain.children.back().children.push_back(chain_object(robot, carried));
  return chain;
}

void RobotInclude::add_joint(const UrdfJoint& joint, const UrdfHold& held, ForeignObject& object) {
  const auto add = [&](const char* field, double value, const Position& place) {
    object.fields.push_back(numbers(field, {value}, place));
  };
  if (joint.lower_limit) add("lower_limit", *joint.lower_limit, joint.limit_place);
  if (joint.upper_limit) add("upper_limit", *joint.upper_limit, joint.limit_place);
  const double damping = joint.damping + held.damping;
  const bool has_own = joint.damping != 0.;
  if (damping != 0.) add("damping", damping, has_own ? joint.damping_place : joint.place);
  if (joint.friction != 0.) add("friction", joint.friction, joint.friction_place);
  if (joint.effort_limit) add("effort_limit", *joint.effort_limit, joint.effort_place);
  if (joint.velocity_limit) add("velocity_limit", *joint.velocity_limit, joint.velocity_place);
  if (joint.rotor_inertia != 0.) add("rotor_inertia", joint.rotor_inertia, joint.rotor_place);
  if (joint.stiffness != 0. && held.stiffness == 0.) {
    add("stiffness", joint.stiffness, joint.place);
    add("rest_angle", joint.rest_angle, joint.place);
  }
  if (held.stiffness != 0.) {
    add("stiffness", held.stiffness, joint.place);
    add("limit_stiffness", held.limit_stiffness, joint.place);
    add("limit_damping", held.limit_damping, joint.place);
    if (joint.friction != 0.) add("friction_speed", held.friction_speed, joint.friction_place);
  }
  if (joint.follows) {
    add_coupling(joint, held.stiffness != 0., object);
  } else {
    if (joint.rate != 0.) add("rate", joint.rate, joint.place);
    add_angle(joint, held.stiffness != 0., object);
  }
  if (held.stiffness != 0. || !joint.servo) return;
  const auto given = std::ranges::find(object.fields, "angle", &ForeignField::name);
  const ForeignField angle =
      given == object.fields.end() ? numbers("angle", {0.}, joint.place) : *given;
  object.children.push_back(servo_object(joint, trails_[joint.name], angle));
}

void RobotInclude::add_coupling(const UrdfJoint& joint, bool held, ForeignObject& object) {
  const auto& [leader, ratio, offset, place] = *joint.follows;
  object.fields.push_back(word("mimic", trails_[leader], place));
  object.fields.push_back(numbers("mimic_ratio", {ratio}, place));
  if (offset != 0.) object.fields.push_back(numbers("mimic_offset", {offset}, place));
  if (held)
    object.fields.push_back(numbers("rest_angle", {ratio * starts_[leader] + offset}, place));
  const auto given = arguments_.find(angle_argument(joint));
  if (given != arguments_.end())
    report_.error(
        given->second.position,
        fmt::format("joint `{}` follows `{}`, which decides where it starts", joint.name, leader));
}

/// Where a joint starts, and where its spring is slack.
void RobotInclude::add_angle(const UrdfJoint& joint, bool held, ForeignObject& object) {
  const auto add = [&](const std::vector<Value>& values, const Position& place) {
    object.fields.push_back({"angle", values, place});
    if (held) object.fields.push_back({"rest_angle", values, place});
  };
  const auto given = arguments_.find(angle_argument(joint));
  if (given != arguments_.end()) {
    if (!given->second.values.empty()) add(given->second.values, given->second.position);
    return;
  }
  // Where that is out of reach, as near to it as the joint goes.
  const double at = joint.angle.value_or(0.), nearest = start_of(joint);
  if (nearest != 0.) add(numbers("", {nearest}, joint.limit_place).values, joint.limit_place);
  if (nearest == at) return;
  report_.remark(joint.limit_place,
                 fmt::format("joint `{}` starts at its limit, {:g}: {:g} is beyond it (the "
                             "argument `{}` says where else)",
                             joint.name, nearest, at, angle_argument(joint)));
}

UrdfMimic RobotInclude::mimic_argument() {
  const std::string word = word_argument("mimic", {"couple", "ignore", "fixed"});
  if (word == "ignore") return UrdfMimic::ignore;
  return word == "fixed" ? UrdfMimic::fixed : UrdfMimic::couple;
}

std::vector<ForeignObject> RobotInclude::material_objects(
    const std::vector<SurfaceMaterial>& materials, const std::string& prefix,
    std::span<UrdfRobot> robots) {
  std::set<std::string> taken;  // names that would hide a Material from the shapes
  for (const UrdfRobot& robot : robots) {
    for (const UrdfLink& link : robot.links) taken.insert(identifier(link.name));
    for (const UrdfJoint& joint : robot.joints) taken.insert(identifier(joint.name));
  }
  std::vector<ForeignObject> objects;
  for (const SurfaceMaterial& material : materials) {
    std::string& name = material_names_[material.name] = prefix + material.name;
    while (!taken.insert(name).second) name += '_';
    objects.push_back(material_object(material, name));
  }
  const auto rename = [&](std::string& name) {
    if (!name.empty()) name = material_names_.at(name);
  };
  for (UrdfRobot& robot : robots) {
    for (UrdfLink& link : robot.links) {
      for (UrdfShape& shape : link.shapes) rename(shape.material);
      for (UrdfPoint& point : link.points) rename(point.material);
    }
  }
  return objects;
}

StatedContact RobotInclude::contact_argument() {
  const std::string word = word_argument("contact", {"friction", "file", "ground"});
  if (word == "file") return StatedContact::file;
  return word == "ground" ? StatedContact::ground : StatedContact::friction;
}

UrdfChoices RobotInclude::choices_argument(const std::string& shapes) {
  const UrdfShapes of = shapes == "visual" ? UrdfShapes::visual : UrdfShapes::collision;
  return {{of, meshes_argument()}, mimic_argument(), inertia_argument(), contact_argument()};
}

UrdfMeshes RobotInclude::meshes_argument() {
  const std::string word = word_argument("meshes", {"skip", "box", "hull"});
  if (word == "hull") return UrdfMeshes::hull;
  return word == "box" ? UrdfMeshes::box : UrdfMeshes::skip;
}

UrdfInertia RobotInclude::inertia_argument() {
  const bool repair = word_argument("inertia", {"file", "repair"}) == "repair";
  return repair ? UrdfInertia::repair : UrdfInertia::file;
}

/// A base without mass may have one of its own: little beside that of the robot.
void RobotInclude::repair_base(UrdfTree& tree, UrdfRobot& robot) {
  UrdfBody& body = tree.base;
  const bool moves = tree.floats || word_argument("base", {"mobile", "fixed"}) == "mobile";
  if (body.has_inertial || !moves || inertia_argument() != UrdfInertia::repair) return;
  constexpr double share = 1e-3;
  double whole = 0.;
  for (const UrdfLink& link : robot.links) whole += link.mass.mass;
  body.has_inertial = true;
  body.inertial_place = robot.links[body.link].place;
  const double moment = compact_inertia(share * whole);
  body.mass = {share * whole, {}, {moment, moment, moment, 0., 0., 0.}};
  robot.repaired.push_back(
      fmt::format("`{}`, the base (without mass: a thousandth of the robot's, "
                  "{:.3g} kg, as a ball of water)",
                  robot.links[body.link].name, body.mass.mass));
}

void RobotInclude::tell_repaired(const UrdfRobot& robot) {
  if (robot.repaired.empty()) return;
  report_.remark(robot.place,
                 fmt::format("inertias repaired: {}", fmt::join(robot.repaired, ", ")));
}

void RobotInclude::tell_left_out(const std::map<std::string, std::size_t>& left_out,
                                 const Position& place) {
  if (left_out.empty()) return;
  std::string list;
  for (const auto& [what, times] : left_out)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", what, times);
  report_.remark(place, "left out: " + list);
}

void RobotInclude::require_mass(const UrdfLink& link, const UrdfBody& body) {
  if (body.has_inertial) return;
  report_.error(link.place, fmt::format("link `{}` moves but has no <inertial>: give it, a link "
                                        "that is fixed to it or one further out a mass and an "
                                        "inertia; the argument inertia = repair gives it a "
                                        "thousandth of the robot's mass",
                                        link.name));
}

std::string RobotInclude::robot_name(const std::string& of_file) {
  const auto given = arguments_.find("name");
  if (given == arguments_.end() || given->second.values.empty())
    return of_file.empty() ? "robot" : identifier(of_file);
  const Value& value = given->second.values[0];
  if (given->second.values.size() == 1 && value.text == identifier(value.text)) return value.text;
  report_.error(given->second.position, "the argument `name` takes a name");
  return "robot";
}

std::string RobotInclude::word_argument(const std::string& name,
                                        const std::vector<std::string>& choices) {
  const auto given = arguments_.find(name);
  if (given == arguments_.end() || given->second.values.empty()) return "";
  const Value& value = given->second.values[0];
  const bool one = given->second.values.size() == 1 && value.kind == ValueKind::word;
  if (one && std::ranges::count(choices, value.text) > 0) return value.text;
  std::string list = choices[0];
  for (std::size_t i = 1; i < choices.size(); ++i)
    list += (i + 1 < choices.size() ? ", " : " or ") + choices[i];
  report_.error(given->second.position, fmt::format("the argument `{}` is {}", name, list));
  return "";
}

/// The angle [rad] of the argument `hold`; 0 if it is not given or after an error.
double RobotInclude::hold_argument() {
  const auto given = arguments_.find("hold");
  if (given == arguments_.end() || given->second.values.empty()) return 0.;
  const Value& value = given->second.values[0];
  constexpr double least = 1e-6, most = 1.;
  constexpr language::Dimension angle{0, 0, 0, 1};
  const bool plain =
      given->second.values.size() == 1 && value.kind == ValueKind::number &&
      (value.quantity.dimension.dimensionless() || value.quantity.dimension == angle);
  if (plain && value.quantity.value >= least && value.quantity.value <= most)
    return value.quantity.value;
  report_.error(given->second.position,
                "the argument `hold` is the angle by which a joint may deflect under the "
                "robot's weight, from 1e-6 to 1 rad");
  return 0.;
}

bool RobotInclude::is_own(const std::string& argument) const {
  return std::ranges::count(own_arguments_, argument) > 0 ||
         std::ranges::count(base_fields, argument) > 0;
}

std::string RobotInclude::angle_argument(const UrdfJoint& joint) const {
  std::string name = identifier(joint.name);
  if (!is_own(name)) return name;
  do {
    name += angle_suffix;
  } while (joint_names_.contains(name));
  return name;
}

bool RobotInclude::is_given(const std::string& name) const {
  const auto given = arguments_.find(name);
  return given != arguments_.end() && !given->second.values.empty();
}

void RobotInclude::check_arguments(std::span<const UrdfRobot> robots,
                                   const std::vector<std::string>& further) {
  std::vector<std::string> known(own_arguments_.begin(), own_arguments_.end());
  if (!robots.empty()) known.insert(known.end(), base_fields.begin(), base_fields.end());
  for (const UrdfRobot& robot : robots) {
    for (const UrdfJoint& joint : robot.joints)
      if (moves(joint)) joint_names_.insert(identifier(joint.name));
  }
  for (const UrdfRobot& robot : robots) check_joint_arguments(robot, further, known);
  known.insert(known.end(), further.begin(), further.end());
  for (const auto& [name, given] : arguments_) {
    if (std::ranges::count(known, name) > 0) continue;
    const std::string nearest = language::nearest_name(name, known);
    report_.error(
        given.position,
        fmt::format("the robot takes no argument `{}`; {}", name,
                    nearest.empty()
                        ? fmt::format("it takes {}, fields of its base, and the names of its "
                                      "moving joints",
                                      fmt::join(own_arguments_, ", "))
                        : "did you mean `" + nearest + "`?"));
  }
}

void RobotInclude::check_joint_arguments(const UrdfRobot& robot,
                                         const std::vector<std::string>& further,
                                         std::vector<std::string>& known) {
  std::map<std::string, std::string> meanings;
  for (const std::string& name : further) meanings.emplace(name, "an xacro:arg of the file");
  for (const char* name : base_fields) add_meaning(name, "a field of the base", meanings);
  for (const UrdfJoint& joint : robot.joints) {
    if (!moves(joint)) continue;
    const std::string name = identifier(joint.name), argument = angle_argument(joint);
    if (argument != name && arguments_.contains(name))
      report_.remark(arguments_.at(name).position,
                     fmt::format("`{}` is not joint `{}` here: the argument `{}` says where that "
                                 "starts",
                                 name, joint.name, argument));
    add_meaning(argument, fmt::format("where joint `{}` starts", joint.name), meanings);
    add_meaning(name + rotor_argument, fmt::format("the rotor of joint `{}`", joint.name),
                meanings);
    known.push_back(argument);
    known.push_back(name + rotor_argument);
  }
}

void RobotInclude::add_meaning(const std::string& argument, const std::string& meaning,
                               std::map<std::string, std::string>& meanings) {
  const auto [known, is_new] = meanings.emplace(argument, meaning);
  const auto given = arguments_.find(argument);
  if (is_new || given == arguments_.end()) return;
  report_.error(given->second.position,
                fmt::format("the argument `{}` means {}, and {}: leave it out, and set what you "
                            "mean by its trail (--set)",
                            argument, known->second, meaning));
}

}  // namespace hookpoint::simulation
