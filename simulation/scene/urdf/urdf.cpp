// A URDF's robot as objects of the language, with the arguments of its Include.
#include "simulation/scene/urdf/urdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "language/document.h"
#include "language/names.h"
#include "simulation/scene/urdf/xacro.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignField;
using language::ForeignObject;
using language::Position;
using language::Value;
using language::ValueKind;

/// Arguments that are fields of the base.
constexpr std::array base_fields{"location", "orientation", "velocity", "angular_velocity",
                                 "rest_on",  "at",          "yaw"};
/// Arguments with a meaning of their own.
constexpr std::array own_arguments{"name",  "base", "shapes",       "meshes",
                                   "mimic", "hold", "rotor_inertia"};
/// What follows the name of a joint in the argument that gives its rotor's inertia.
constexpr const char* rotor_argument = "_rotor_inertia";

/// `text` as a name of the language: letters, digits and _, no digit first.
std::string identifier(std::string text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::ranges::replace_if(
      text, [&](char c) { return !digit(c) && !letter(c); }, '_');
  if (text.empty() || digit(text[0])) text.insert(0, "_");
  return text;
}

/// A chain is called as its first joint; the base has its name already.
std::string chain_name(const UrdfJoint& hip) {
  const std::string name = identifier(hip.name);
  return name == "base" ? "base_" : name;
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

ForeignField word(const char* name, const char* text, const Position& place) {
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

ForeignObject shape_object(const ShapeSpec& shape, const Position& place) {
  ForeignObject object{"", "", place, {}, {}};
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    object.type = "Shape.Box";
    const Vector3d& size = box->dimensions;
    object.fields = {numbers("dimensions", {size.x, size.y, size.z}, place)};
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    object.type = "Shape.Cylinder";
    object.fields = {numbers("radius", {cylinder->radius}, place),
                     numbers("length", {cylinder->length}, place)};
  } else {
    object.type = "Shape.Sphere";
    object.fields = {numbers("radius", {std::get<Sphere>(shape.geometry).radius}, place)};
  }
  add_pose({shape.location, shape.orientation}, "location", "orientation", place, object);
  return object;
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
  for (std::size_t i = 0; i < body.shapes.size(); ++i)
    object.children.push_back(shape_object(body.shapes[i], body.shape_places[i]));
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const Vector3d& p = body.points[i];
    const Position& place = body.point_places[i];
    object.children.push_back(
        {"ContactPoint", "", place, {numbers("location", {p.x, p.y, p.z}, place)}, {}});
  }
}

class UrdfInclude {
 public:
  UrdfInclude(const ForeignArguments& arguments, language::FileStore& files,
              language::Report& report)
      : arguments_(arguments), files_(files), report_(report) {}

  std::vector<ForeignObject> run(const language::SourceFile& file) {
    const ExpandedUrdf expanded = expand_xacro(file, arguments_, own_arguments, files_, report_);
    if (expanded.source == nullptr) return {};
    for_macros_ = expanded.arguments;
    const std::string shapes = word_argument("shapes", {"collision", "visual", "inertia"});
    auto robot =
        read_urdf(*expanded.source, geometry_argument(shapes), mimic_argument(), files_, report_);
    if (!robot) return {};
    // A file that a run is repeated from is the one that was written.
    if (expanded.source != &file) robot->place = {&file, 0, 1};
    take_rotors(*robot);
    auto tree = assemble_urdf(*robot, report_);
    if (!tree) return {};
    if (shapes == "inertia") take_inertia_boxes(*tree);
    check_arguments(*robot);
    tell_left_out(*robot);
    ForeignObject object{"Robot", robot_name(*robot), robot->place, {}, {}};
    object.children.push_back(base_object(*robot, *tree));
    const bool mobile = object.children.front().type == "Base.mobile";
    const double sag = hold_argument();
    if (sag > 0.) holds_ = hold_joints(*tree, mobile, sag);
    for (const UrdfChain& chain : tree->chains)
      object.children.push_back(chain_object(*robot, chain));
    return {std::move(object)};
  }

 private:
  UrdfMimic mimic_argument() {
    const std::string word = word_argument("mimic", {"ignore", "fixed"});
    if (word == "ignore") return UrdfMimic::ignored;
    return word == "fixed" ? UrdfMimic::fixed : UrdfMimic::refused;
  }

  UrdfGeometry geometry_argument(const std::string& shapes) {
    UrdfGeometry geometry;
    if (shapes == "visual") geometry.shapes = UrdfShapes::visual;
    const std::string meshes = word_argument("meshes", {"skip", "box", "hull"});
    if (meshes == "box") geometry.meshes = UrdfMeshes::box;
    if (meshes == "hull") geometry.meshes = UrdfMeshes::hull;
    return geometry;
  }

  /// What the arguments say of rotors goes before what the file says.
  void take_rotors(UrdfRobot& robot) {
    const auto give = [&](const std::string& argument, UrdfJoint& joint) {
      const auto given = arguments_.find(argument);
      if (given == arguments_.end() || given->second.values.empty()) return;
      const Value& value = given->second.values[0];
      joint.rotor_place = given->second.position;
      const std::string unit =
          joint.type == UrdfJointType::prismatic ? "a mass, in kg" : "in kg.m^2";
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
      if (joint.type == UrdfJointType::fixed || joint.type == UrdfJointType::floating) continue;
      if (joint.type != UrdfJointType::prismatic) give("rotor_inertia", joint);
      give(identifier(joint.name) + rotor_argument, joint);
    }
  }

  ForeignObject base_object(const UrdfRobot& robot, const UrdfTree& tree) {
    const UrdfBody& body = tree.base;
    const UrdfLink& link = robot.links[body.link];
    std::string kind = word_argument("base", {"mobile", "fixed"});
    // A root that is the world itself, as other readers take it, or that nothing could move.
    const bool is_world = link.name == "world" && !tree.floats;
    if (kind.empty() && !is_world && !tree.floats && !body.has_inertial)
      report_.remark(link.place,
                     fmt::format("link `{}`, the base, has no <inertial>: it is fixed", link.name));
    if (kind.empty()) kind = is_world || (!body.has_inertial && !tree.floats) ? "fixed" : "mobile";
    ForeignObject object{"Base." + kind, "", link.place, {}, {}};
    if (kind == "mobile") require_mass(link, body);
    for (const char* name : base_fields) {
      const auto given = arguments_.find(name);
      if (given != arguments_.end() && !given->second.values.empty())
        object.fields.push_back(given->second);
    }
    add_body(body, object);
    return object;
  }

  ForeignObject chain_object(const UrdfRobot& robot, const UrdfChain& of) {
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

  void add_joint(const UrdfJoint& joint, const UrdfHold& held, ForeignObject& object) {
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
    if (joint.rotor_inertia != 0.) add("rotor_inertia", joint.rotor_inertia, joint.rotor_place);
    if (held.stiffness != 0.) {
      add("stiffness", held.stiffness, joint.place);
      add("limit_stiffness", held.limit_stiffness, joint.place);
      add("limit_damping", held.limit_damping, joint.place);
      if (joint.friction != 0.) add("friction_speed", held.friction_speed, joint.friction_place);
    }
    const auto angle = arguments_.find(identifier(joint.name));
    if (angle != arguments_.end()) {
      if (angle->second.values.empty()) return;
      object.fields.push_back({"angle", angle->second.values, angle->second.position});
      if (held.stiffness != 0.)
        object.fields.push_back({"rest_angle", angle->second.values, angle->second.position});
      return;
    }
    // Where 0 is out of reach, as near to it as the joint goes.
    if (!joint.lower_limit) return;
    const double nearest = std::clamp(0., *joint.lower_limit, *joint.upper_limit);
    if (nearest == 0.) return;
    add("angle", nearest, joint.limit_place);
    if (held.stiffness != 0.) add("rest_angle", nearest, joint.limit_place);
    report_.remark(joint.limit_place,
                   fmt::format("joint `{}` starts at its limit, {:g}: 0 is beyond it (the "
                               "argument `{}` says where else)",
                               joint.name, nearest, identifier(joint.name)));
  }

  /// One line about all that is in the file and not in the robot.
  void tell_left_out(const UrdfRobot& robot) {
    if (robot.left_out.empty()) return;
    std::string list;
    for (const auto& [what, times] : robot.left_out)
      list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", what, times);
    report_.remark(robot.place, "left out: " + list);
  }

  void require_mass(const UrdfLink& link, const UrdfBody& body) {
    if (body.has_inertial) return;
    report_.error(link.place, fmt::format("link `{}` moves but has no <inertial>: give it, a link "
                                          "that is fixed to it or one further out a mass and an "
                                          "inertia",
                                          link.name));
  }

  std::string robot_name(const UrdfRobot& robot) {
    const auto given = arguments_.find("name");
    if (given == arguments_.end() || given->second.values.empty())
      return robot.name.empty() ? "robot" : identifier(robot.name);
    const Value& value = given->second.values[0];
    if (given->second.values.size() == 1 && value.text == identifier(value.text)) return value.text;
    report_.error(given->second.position, "the argument `name` takes a name");
    return "robot";
  }

  /// The word that an argument gives; "" if it is not given or after an error.
  std::string word_argument(const std::string& name, const std::vector<std::string>& choices) {
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
  double hold_argument() {
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
                  "the argument `hold` is the angle by which a joint may give way under the "
                  "robot's weight, from 1e-6 to 1 rad");
    return 0.;
  }

  void check_arguments(const UrdfRobot& robot) {
    std::vector<std::string> known(own_arguments.begin(), own_arguments.end());
    known.insert(known.end(), base_fields.begin(), base_fields.end());
    for (const UrdfJoint& joint : robot.joints) {
      if (joint.type == UrdfJointType::fixed) continue;
      known.push_back(identifier(joint.name));
      known.push_back(known.back() + rotor_argument);
    }
    known.insert(known.end(), for_macros_.begin(), for_macros_.end());
    for (const auto& [name, given] : arguments_) {
      if (std::ranges::count(known, name) > 0) continue;
      const std::string nearest = language::nearest_name(name, known);
      report_.error(
          given.position,
          fmt::format("the robot takes no argument `{}`; {}", name,
                      nearest.empty() ? "it takes name, base, shapes, meshes, mimic, "
                                        "hold, rotor_inertia, fields of its base, and the "
                                        "names of its moving joints"
                                      : "did you mean `" + nearest + "`?"));
    }
  }

  const ForeignArguments& arguments_;
  language::FileStore& files_;
  language::Report& report_;
  std::map<const UrdfJoint*, UrdfHold> holds_;
  std::vector<std::string> for_macros_;  ///< arguments that xacro took
};

}  // namespace

std::vector<ForeignObject> include_urdf(const language::SourceFile& file,
                                        const ForeignArguments& arguments,
                                        language::FileStore& files, language::Report& report) {
  return UrdfInclude(arguments, files, report).run(file);
}

}  // namespace hookpoint::simulation
