// A URDF file as it stands.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "language/document/document.h"
#include "language/names.h"
#include "simulation/scene/urdf/inertia_repair.h"
#include "simulation/scene/urdf/joint_rules.h"
#include "simulation/scene/urdf/mesh_shape.h"
#include "simulation/scene/urdf/urdf.h"
#include "simulation/scene/urdf/xml.h"

namespace hookpoint::simulation {
namespace {

using language::Position;

class UrdfReader : private UrdfXml {
 public:
  UrdfReader(const language::SourceFile& file, const UrdfChoices& choices,
             language::FileStore& files, language::Report& report)
      : UrdfXml(file, report),
        path_(file.path),
        geometry_(choices.geometry),
        choices_(choices),
        files_(files) {}

  std::optional<UrdfRobot> run();

 private:
  void read_link(const pugi::xml_node& node);
  void read_inertial(const pugi::xml_node& node, UrdfLink& link);
  void read_shape(const pugi::xml_node& node, UrdfLink& link);
  /// What <contact> of a link says of its surface, as Bullet has it, and <gazebo> of the robot.
  void read_link_contact(const pugi::xml_node& node, std::size_t link);
  void read_gazebo(const pugi::xml_node& node);
  /// A constant of a surface in an element of that name: its text, or its attribute `value`.
  std::optional<double> surface_value(const pugi::xml_node& node, const char* name);
  /// Adds to what is stated of a link's surface; a constant counts as it was stated last.
  void state_surface(SurfaceMaterial material, std::size_t link);
  /// The Materials of links whose surfaces are stated.
  void give_materials();
  void leave_out(const std::string& what, std::size_t times = 1) { robot_.left_out[what] += times; }
  /// What of an element's children is not among `read`.
  void leave_out_others(const pugi::xml_node& node, std::initializer_list<std::string_view> read);
  std::optional<ShapeGeometry> read_geometry(const pugi::xml_node& node);
  void read_mesh_at(const pugi::xml_node& node, const Pose& X_LS, UrdfLink& link);
  void read_joint(const pugi::xml_node& node);
  bool read_type(const pugi::xml_node& node, UrdfJoint& joint);
  bool read_ends(const pugi::xml_node& node, UrdfJoint& joint);
  bool read_end(const pugi::xml_node& node, const char* role, std::size_t& link);
  void read_axis(const pugi::xml_node& node, UrdfJoint& joint);
  void read_limit(const pugi::xml_node& node, UrdfJoint& joint);
  /// A stop of a joint, 0 where it is not given; nothing where it lies beyond all numbers on `side`.
  std::optional<double> read_stop(const pugi::xml_node& limit, const char* attribute, Beyond side);
  void read_mimic(const pugi::xml_node& node, UrdfJoint& joint);
  void read_dynamics(const pugi::xml_node& node, UrdfJoint& joint);
  void read_transmission(const pugi::xml_node& node);
  /// A joint that carries nothing of mass moves nothing: it is fixed where it is.
  void fix_idle_joints();

  Pose read_origin(const pugi::xml_node& parent);

  const std::filesystem::path path_;
  const UrdfGeometry geometry_;
  const UrdfChoices choices_;
  language::FileStore& files_;
  UrdfRobot robot_;
  std::unordered_map<std::string, std::size_t> links_, joints_;
  std::vector<std::pair<std::size_t, SurfaceMaterial>> surfaces_;  ///< of links, as first stated
  std::unordered_map<std::size_t, std::size_t> surface_of_;        ///< a link's place in surfaces_
  int hints_ = 0;                                                  ///< given so far
};

std::optional<UrdfRobot> UrdfReader::run() {
  const pugi::xml_node root = open({"robot"}, "URDF");
  if (!root) return std::nullopt;
  robot_.name = root.attribute("name").value();
  robot_.place = place(root);
  for (const pugi::xml_node& node : root.children("link")) {
    if (!full()) read_link(node);
  }
  for (const pugi::xml_node& node : root.children()) {
    const std::string_view name = node.name();
    if (node.type() == pugi::node_element && name != "link" && name != "joint" &&
        name != "transmission" && name != "gazebo")
      leave_out(fmt::format("<{}>", name));
    if (name == "gazebo") read_gazebo(node);
  }
  give_materials();
  if (robot_.links.empty()) fail(robot_.place, "the robot has no <link>");
  for (const pugi::xml_node& node : root.children("joint")) {
    if (!full()) read_joint(node);
  }
  for (const pugi::xml_node& node : root.children("transmission")) {
    if (!full()) read_transmission(node);
  }
  fix_idle_joints();
  return good() ? std::optional(std::move(robot_)) : std::nullopt;
}

void UrdfReader::read_link(const pugi::xml_node& node) {
  UrdfLink link;
  link.name = name_of(node);
  link.place = place(node);
  const auto [same, is_new] = links_.emplace(link.name, robot_.links.size());
  if (!is_new) {
    fail(link.place, fmt::format("a second link `{}`", link.name));
    return note(robot_.links[same->second].place, "the first is here");
  }
  if (const pugi::xml_node inertial = only(node, "inertial")) read_inertial(inertial, link);
  const bool visual = geometry_.shapes == UrdfShapes::visual;
  const char* kind = visual ? "visual" : "collision";
  const char* other = visual ? "collision" : "visual";
  for (const pugi::xml_node& shape : node.children(kind)) read_shape(shape, link);
  for (pugi::xml_node shape = node.child(other); shape; shape = shape.next_sibling(other))
    leave_out(fmt::format("<{}>", other));
  if (const pugi::xml_node contact = only(node, "contact"))
    read_link_contact(contact, same->second);
  robot_.links.push_back(std::move(link));
}

std::optional<double> UrdfReader::surface_value(const pugi::xml_node& node, const char* name) {
  const pugi::xml_node element = node.child(name);
  if (!element) return std::nullopt;
  const pugi::xml_attribute value = element.attribute("value");
  if (value) return surface_constant(value.value(), name, place(element, "value"));
  return surface_constant(text_in(element), name, place(element));
}

void UrdfReader::leave_out_others(const pugi::xml_node& node,
                                  std::initializer_list<std::string_view> read) {
  for (const pugi::xml_node& child : node.children()) {
    const std::string_view name = child.name();
    if (child.type() == pugi::node_element && std::ranges::count(read, name) == 0)
      leave_out(fmt::format("<{}> of <{}>", name, node.name()));
  }
}

void UrdfReader::read_link_contact(const pugi::xml_node& node, std::size_t link) {
  SurfaceMaterial material;
  material.place = place(node);
  material.friction = surface_value(node, "lateral_friction");
  if (choices_.contact == StatedContact::file) {
    material.stiffness = surface_value(node, "stiffness");
    material.damping = surface_value(node, "damping");
    material.restitution = surface_value(node, "restitution");
    material.rolling = surface_value(node, "rolling_friction");
    material.spinning = surface_value(node, "spinning_friction");
  }
  leave_out_others(node, {"lateral_friction", "stiffness", "damping", "restitution",
                          "rolling_friction", "spinning_friction"});
  state_surface(std::move(material), link);
}

void UrdfReader::read_gazebo(const pugi::xml_node& node) {
  const auto link = links_.find(node.attribute("reference").value());
  SurfaceMaterial material;
  material.place = place(node);
  material.friction = surface_value(node, "mu1");
  if (choices_.contact == StatedContact::file) {
    material.stiffness = surface_value(node, "kp");
    material.damping = surface_value(node, "kd");
  }
  if (link == links_.end() || material.says_nothing()) return leave_out("<gazebo>");
  if (const auto across = surface_value(node, "mu2"); across && across != material.friction)
    leave_out("mu2 that is not mu1");
  leave_out_others(node, {"mu1", "mu2", "kp", "kd"});
  state_surface(std::move(material), link->second);
}

void UrdfReader::state_surface(SurfaceMaterial material, std::size_t link) {
  // Of these 0 means that nothing is stated.
  for (std::optional<double>* constant : {&material.stiffness, &material.damping}) {
    if (*constant == 0.) constant->reset();
  }
  if (choices_.contact == StatedContact::ground || material.says_nothing()) return;
  const auto [known, is_new] = surface_of_.emplace(link, surfaces_.size());
  if (is_new) {
    surfaces_.emplace_back(link, std::move(material));
    return;
  }
  if (const std::size_t times = restate(material, surfaces_[known->second].second); times > 0)
    leave_out("constant of a surface that is stated again with another value", times);
}

void UrdfReader::give_materials() {
  for (auto& [index, surface] : surfaces_) {
    const std::string name = add_material(std::move(surface), robot_.materials);
    UrdfLink& link = robot_.links[index];
    for (UrdfShape& shape : link.shapes) shape.material = name;
    for (UrdfPoint& point : link.points) point.material = name;
  }
}

void UrdfReader::read_inertial(const pugi::xml_node& node, UrdfLink& link) {
  link.inertial_place = place(node);
  const std::size_t errors_before = errors();
  const Pose X_LC = read_origin(node);
  const pugi::xml_node mass = only(node, "mass"), inertia = only(node, "inertia");
  if (!mass || !inertia) {
    fail(link.inertial_place, fmt::format("<inertial> of `{}` lacks {}", link.name,
                                          mass ? "<inertia>" : "<mass value=\"...\"/>"));
    return;
  }
  link.mass.mass = number(mass, "value", {});
  if (link.mass.mass < 0.) fail(place(mass, "value"), "a mass is not negative");
  const Symmetric3d I_C{number(inertia, "ixx", {}), number(inertia, "iyy", {}),
                        number(inertia, "izz", {}), number(inertia, "ixy", 0.),
                        number(inertia, "ixz", 0.), number(inertia, "iyz", 0.)};
  for (const char* product : {"ixy", "ixz", "iyz"}) {
    if (!inertia.attribute(product)) leave_out("product of inertia that is not given: 0");
  }
  link.mass.center_of_mass = X_LC.position;
  link.mass.inertia = rotate(rotation_matrix(X_LC.orientation), I_C);
  link.has_inertial = link.mass.mass != 0. || I_C != Symmetric3d{};
  if (errors() > errors_before) return;
  if (const std::string problem = settle_inertia(choices_.inertia, link, robot_.repaired);
      !problem.empty())
    fail(link.inertial_place, problem);
}

void UrdfReader::read_shape(const pugi::xml_node& node, UrdfLink& link) {
  const Pose X_LS = read_origin(node);
  const pugi::xml_node geometry = only(node, "geometry");
  if (!geometry) {
    fail(place(node), fmt::format("<{}> lacks <geometry>", node.name()));
    return;
  }
  if (const pugi::xml_node mesh = geometry.child("mesh")) {
    if (geometry_.meshes == UrdfMeshes::skip)
      return leave_out(fmt::format("mesh of <{}>", node.name()));
    return read_mesh_at(mesh, X_LS, link);
  }
  const std::optional<ShapeGeometry> read = read_geometry(geometry);
  if (!read) return;
  link.shapes.push_back(
      {{*read, X_LS.position, X_LS.orientation, 0}, place(geometry.first_child()), true, ""});
}

void UrdfReader::read_mesh_at(const pugi::xml_node& node, const Pose& X_LS, UrdfLink& link) {
  const Vector3d scale = vector(node, "scale", {1., 1., 1.});
  const MeshPoints* mesh =
      find_mesh(node.attribute("filename").value(), place(node, "filename"), path_, files_, *this);
  if (mesh == nullptr) return;
  if (scale.x * scale.y * scale.z == 0.) {
    fail(place(node, "scale"), "a scale of 0 leaves nothing of a mesh");
    return;
  }
  add_mesh(mesh->vertices, scale, geometry_.meshes, X_LS, place(node), "", link, robot_.left_out);
}

std::optional<ShapeGeometry> UrdfReader::read_geometry(const pugi::xml_node& node) {
  const pugi::xml_node shape = node.find_child(
      [](const pugi::xml_node& child) { return child.type() == pugi::node_element; });
  const std::string_view kind = shape.name();
  if (kind == "box") {
    const Vector3d size = vector(shape, "size", {});
    const double least = std::min({size.x, size.y, size.z});
    if (least < 0.) fail(place(shape, "size"), "the edges of a box are greater than 0");
    if (least != 0.) return Box{size};
    leave_out("shape of size 0");
    return std::nullopt;
  }
  if (kind == "sphere" || kind == "cylinder" || kind == "capsule") {
    const double radius = not_negative(shape, "radius");
    const double length = kind == "sphere" ? 1. : not_negative(shape, "length");
    if (radius == 0. || length == 0.) {
      leave_out("shape of size 0");
      return std::nullopt;
    }
    if (kind == "capsule") return Capsule{radius, length};
    return kind == "sphere" ? ShapeGeometry(Sphere{radius}) : Cylinder{radius, length};
  }
  if (kind == "plane") {
    leave_out("plane: the ground is a Terrain of the World");
    return std::nullopt;
  }
  fail(shape ? place(shape) : place(node),
       "<geometry> takes a box, a cylinder, a sphere, a capsule or a mesh");
  return std::nullopt;
}

void UrdfReader::read_joint(const pugi::xml_node& node) {
  UrdfJoint joint;
  joint.name = name_of(node);
  joint.place = place(node);
  const auto [same, is_new] = joints_.emplace(joint.name, robot_.joints.size());
  if (!is_new) {
    fail(joint.place, fmt::format("a second joint `{}`", joint.name));
    return note(robot_.joints[same->second].place, "the first is here");
  }
  if (!read_type(node, joint) || !read_ends(node, joint)) return;
  joint.origin = read_origin(node);
  for (const char* aside : {"calibration", "safety_controller"}) {
    if (node.child(aside)) leave_out(fmt::format("<{}>", aside));
  }
  if (joint.type != UrdfJointType::fixed && joint.type != UrdfJointType::floating) {
    read_axis(node, joint);
    read_limit(node, joint);
    read_mimic(node, joint);
    if (joint.type != UrdfJointType::fixed) read_dynamics(node, joint);
  }
  robot_.joints.push_back(std::move(joint));
}

bool UrdfReader::read_type(const pugi::xml_node& node, UrdfJoint& joint) {
  const std::string_view type = node.attribute("type").value();
  joint.type_place = place(node, "type");
  if (type == "fixed") joint.type = UrdfJointType::fixed;
  if (type == "revolute") joint.type = UrdfJointType::revolute;
  if (type == "continuous") joint.type = UrdfJointType::continuous;
  if (type == "prismatic") joint.type = UrdfJointType::prismatic;
  if (type == "floating") joint.type = UrdfJointType::floating;
  if (joint.type != UrdfJointType::fixed || type == "fixed") return true;
  const Position at = place(node, "type");
  if (type == "planar") {
    return fail(at,
                "a planar joint is not supported: only the base moves freely (argument base = "
                "mobile), links turn or slide about one axis");
  }
  const std::string known = "revolute, continuous, prismatic or fixed";
  if (type.empty()) return fail(at, fmt::format("joint `{}` has no type: {}", joint.name, known));
  return fail(at, fmt::format("`{}` is no type of joint: expected {}", type, known));
}

bool UrdfReader::read_ends(const pugi::xml_node& node, UrdfJoint& joint) {
  const bool parent = read_end(node, "parent", joint.parent);
  return read_end(node, "child", joint.child) && parent;
}

bool UrdfReader::read_end(const pugi::xml_node& node, const char* role, std::size_t& link) {
  const pugi::xml_node end = only(node, role);
  const std::string name = end.attribute("link").value();
  if (name.empty()) {
    return fail(end ? place(end) : place(node), fmt::format("joint `{}` lacks <{} link=\"...\"/>",
                                                            node.attribute("name").value(), role));
  }
  const auto found = links_.find(name);
  if (found != links_.end()) {
    link = found->second;
    return true;
  }
  constexpr int most_hints = 20;
  std::vector<std::string> names;
  if (hints_++ < most_hints) {
    for (const UrdfLink& known : robot_.links) names.push_back(known.name);
  }
  const std::string nearest = language::nearest_name(name, names);
  return fail(place(end, "link"),
              fmt::format("there is no link `{}`{}", name,
                          nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
}

void UrdfReader::read_axis(const pugi::xml_node& node, UrdfJoint& joint) {
  const pugi::xml_node axis = only(node, "axis");
  if (!axis) return;
  const Vector3d along = vector(axis, "xyz", joint.axis);
  const double length = std::hypot(along.x, along.y, along.z);
  if (!(length > 0.)) {
    fail(place(axis, "xyz"), "an axis of length 0 has no direction");
    return;
  }
  joint.axis = {along.x / length, along.y / length, along.z / length};
}

void UrdfReader::read_limit(const pugi::xml_node& node, UrdfJoint& joint) {
  const pugi::xml_node limit = only(node, "limit");
  const auto read_bound = [&](const char* attribute, std::optional<double>& bounds,
                              language::Position& at) {
    if (!limit.attribute(attribute)) return;
    at = place(limit, attribute);
    bounds = bound(limit.attribute(attribute).value(), at);
    if (!bounds) leave_out(fmt::format("limit of {} that is no bound", attribute));
  };
  read_bound("effort", joint.effort_limit, joint.effort_place);
  read_bound("velocity", joint.velocity_limit, joint.velocity_place);
  if (joint.type == UrdfJointType::continuous) return;
  if (!limit.attribute("lower") && !limit.attribute("upper"))
    return leave_out(fmt::format("limits that joint `{}` is not given", joint.name));
  joint.limit_place = place(limit);
  joint.lower_limit = read_stop(limit, "lower", Beyond::below);
  joint.upper_limit = read_stop(limit, "upper", Beyond::above);
  if (!joint.lower_limit || !joint.upper_limit || *joint.lower_limit < *joint.upper_limit) return;
  if (*joint.lower_limit == *joint.upper_limit && limit.attribute("lower") &&
      limit.attribute("upper")) {
    fix_joint(*joint.lower_limit, joint);
    leave_out("joint whose limits are equal: fixed");
    return;
  }
  fail(place(limit, "lower"),
       fmt::format("lower = {:g} is not below upper = {:g} (each is 0 where it is not given)",
                   *joint.lower_limit, *joint.upper_limit));
}

std::optional<double> UrdfReader::read_stop(const pugi::xml_node& limit, const char* attribute,
                                            Beyond side) {
  const pugi::xml_attribute given = limit.attribute(attribute);
  if (!given) return 0.;
  const std::optional<double> read = stop(given.value(), side, place(limit, attribute));
  if (!read) leave_out(fmt::format("limit of {} that is no bound", attribute));
  return read;
}

void UrdfReader::read_mimic(const pugi::xml_node& node, UrdfJoint& joint) {
  const pugi::xml_node mimic = only(node, "mimic");
  if (!mimic || joint.type == UrdfJointType::fixed) return;
  const double offset = number(mimic, "offset", 0.);
  if (choices_.mimic == UrdfMimic::ignore) leave_out("<mimic>: the joint moves by itself");
  if (choices_.mimic == UrdfMimic::couple)
    joint.follows = {mimic.attribute("joint").value(), number(mimic, "multiplier", 1.), offset,
                     place(mimic)};
  if (choices_.mimic != UrdfMimic::fixed) return;
  fix_joint(offset, joint);
  leave_out("<mimic>: the joint is fixed at its offset");
}

void UrdfReader::read_dynamics(const pugi::xml_node& node, UrdfJoint& joint) {
  const pugi::xml_node dynamics = only(node, "dynamics");
  if (!dynamics) return;
  joint.damping_place = place(dynamics, "damping");
  joint.friction_place = place(dynamics, "friction");
  joint.damping = number(dynamics, "damping", 0.);
  joint.friction = number(dynamics, "friction", 0.);
}

// Where rotor inertias stand in URDF: in the actuator of a transmission. Between motor and joint are
// the gears of the actuator and those of the joint, whose reductions multiply to N: the joint has N^2
// times the inertia of the motor.
void UrdfReader::read_transmission(const pugi::xml_node& node) {
  const pugi::xml_node actuator = node.child("actuator"), carried = node.child("joint");
  const auto number_in = [&](std::initializer_list<pugi::xml_node> places,
                             std::initializer_list<const char*> names) {
    for (const char* name : names) {
      for (const pugi::xml_node& part : places) {
        if (const pugi::xml_node element = part.child(name))
          return std::optional(element.attribute("value") ? number(element, "value", {})
                                                          : content(element));
      }
    }
    return std::optional<double>();
  };
  const auto reduction_in = [&](std::initializer_list<pugi::xml_node> places) {
    return number_in(places, {"mechanicalReduction", "mechanical_reduction", "drake:gear_ratio"})
        .value_or(1.);
  };
  const std::optional<double> motor = number_in(
      {actuator, node}, {"motorInertia", "rotorInertia", "rotor_inertia", "drake:rotor_inertia"});
  if (!motor) return leave_out("<transmission>");
  const double reduction = reduction_in({actuator, node}) * reduction_in({carried});
  const auto of = joints_.find(carried.attribute("name").value());
  if (of == joints_.end() || of->second >= robot_.joints.size()) return leave_out("<transmission>");
  for (const pugi::xml_node& read : {actuator, carried}) {
    if (read.next_sibling(read.name()))
      leave_out(fmt::format("further <{}> of a <transmission>", read.name()));
  }
  if (*motor < 0.) {
    fail(place(actuator), "an inertia is not negative");
    return;
  }
  UrdfJoint& joint = robot_.joints[of->second];
  joint.rotor_inertia += reduction * reduction * *motor;
  joint.rotor_place = place(actuator);
}

void UrdfReader::fix_idle_joints() {
  std::vector<std::optional<std::size_t>> carrier(robot_.links.size());
  for (const UrdfJoint& joint : robot_.joints) carrier[joint.child] = joint.parent;
  std::vector<bool> heavy(robot_.links.size(), false);
  for (std::size_t i = 0; i < robot_.links.size(); ++i) {
    if (!robot_.links[i].has_inertial) continue;
    for (std::optional<std::size_t> at = i; at && !heavy[*at]; at = carrier[*at]) heavy[*at] = true;
  }
  for (UrdfJoint& joint : robot_.joints) {
    if (heavy[joint.child] || joint.type == UrdfJointType::fixed ||
        joint.type == UrdfJointType::floating)
      continue;
    fix_joint(0., joint);
    leave_out("joint that carries no mass: fixed");
  }
}

Pose UrdfReader::read_origin(const pugi::xml_node& parent) {
  const pugi::xml_node origin = only(parent, "origin");
  if (!origin) return {};
  const Vector3d angles = vector(origin, "rpy", {});
  return {vector(origin, "xyz", {}), from_roll_pitch_yaw(angles.x, angles.y, angles.z)};
}

}  // namespace

std::optional<UrdfRobot> read_urdf(const language::SourceFile& file, const UrdfChoices& choices,
                                   language::FileStore& files, language::Report& report) {
  return UrdfReader(file, choices, files, report).run();
}

}  // namespace hookpoint::simulation
