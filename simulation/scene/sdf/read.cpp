// The models of an SDFormat file as robots and solids. A joint of SDF stands anywhere in its child link,
// where a joint of URDF stands at the child's origin: the link L that joint J carries gets the frame L'
// at the joint, along the axes of L, X_LL' = Trans(p_LJ), and what the link holds is moved there. Joints
// are at 0 in the pose of the file, so that X_P'L' = X_MP'^-1 X_ML' of the poses in the model M.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "dts/mass_properties.h"
#include "math/rotation.h"
#include "simulation/scene/sdf/geometry.h"
#include "simulation/scene/sdf/sdf.h"
#include "simulation/scene/urdf/hull.h"
#include "simulation/scene/urdf/inertia_repair.h"
#include "simulation/scene/urdf/joint_rules.h"
#include "simulation/scene/urdf/mesh_shape.h"

namespace hookpoint::simulation {
namespace {

/// A link of a model or of those in it. `X_ML`: in the outermost model's frame.
struct SdfLink {
  XmlElement element;
  SdfModel* scope = nullptr;
  std::string name;       ///< in its scope
  std::string full_name;  ///< in the outermost model: "arm::hand"
  Pose X_ML;
  Pose X_LF;  ///< the frame that it has here, at the joint that carries it
};

/// What the joint about the second axis of a universal one is called beyond it.
constexpr const char* second_axis = "_2";

/// A joint, and what it joins: indices of links; the world's is `no_link`.
constexpr std::size_t no_link = static_cast<std::size_t>(-1);
struct SdfJoint {
  XmlElement element;
  SdfModel* scope = nullptr;
  std::string full_name;
  std::size_t parent = no_link, child = no_link;
  Pose X_MS;  ///< of its scope
  Pose X_MJ;

  /// The name, in the outermost model, of what its scope calls `name`.
  std::string full(const std::string& other) const {
    return full_name.substr(0, full_name.size() - element.text("name").size()) + other;
  }
};

/// "mesh", for instance.
std::string_view kind_of(const XmlElement& geometry) {
  const pugi::xml_node shape = geometry.node.find_child(
      [](const pugi::xml_node& node) { return node.type() == pugi::node_element; });
  return shape ? shape.name() : "geometry";
}

class SdfReader {
 public:
  SdfReader(const language::SourceFile& file, const UrdfChoices& choices,
            language::FileStore& files, language::Report& report)
      : document_(file, files, report), choices_(choices), files_(files), report_(report) {}

  std::optional<SdfScene> run();

 private:
  void leave_out(const std::string& what) { ++scene_.left_out[what]; }
  void list_left_out(const XmlElement& of, std::initializer_list<std::string_view> read);
  void read_model(SdfModel& model);
  void read_static_model(SdfModel& model, const Pose& X_WM);
  void read_static_collision(const SdfModel& model, const XmlElement& collision, const Pose& X_WC);
  /// Adds the mesh of a collision or a visual, which stands at `X_LS`; false where none is taken.
  bool add_mesh_of(const XmlElement& collision, const XmlElement& geometry, const Pose& X_LS,
                   UrdfLink& link);
  /// Links and joints of the model and those in it.
  void gather(SdfModel& model, const Pose& X_OM, const std::string& above);
  void gather_joint(SdfModel& model, const XmlElement& element, const Pose& X_OM,
                    const std::string& above);
  std::size_t link_index(SdfModel& scope, const char* role, const XmlElement& joint);
  /// The links that joints connect, one robot each.
  void make_robots(SdfModel& model, const Pose& X_WM);
  void make_robot(SdfModel& model, const Pose& X_WM, const std::vector<std::size_t>& links,
                  const std::vector<std::size_t>& joints, std::string name);
  UrdfLink read_link(const SdfLink& of);
  void read_link_shapes(const SdfLink& of, UrdfLink& link);
  /// `X_MW`: of the world in the outermost model; `places`: the robot's links by their indices here.
  void add_joint(const SdfJoint& of, const Pose& X_MW,
                 const std::unordered_map<std::size_t, std::size_t>& places, UrdfRobot& robot);
  /// `X_MF`: of the frame that the axis is a direction in.
  UrdfJoint read_axis(const SdfJoint& of, const char* which, const Pose& X_MF);
  void read_limits(const XmlElement& axis, bool bounded, UrdfJoint& joint);
  void read_dynamics(const XmlElement& axis, UrdfJoint& joint);
  void read_mimic(const SdfJoint& of, const XmlElement& axis, UrdfJoint& joint);
  std::string material_of(const XmlElement& collision);

  SdfDocument document_;
  const UrdfChoices& choices_;
  language::FileStore& files_;
  language::Report& report_;
  SdfScene scene_;
  std::vector<std::string> repaired_;
  std::vector<SdfLink> links_;    ///< of one outermost model
  std::vector<SdfJoint> joints_;  ///< of one outermost model
  std::unordered_map<const SdfModel*, std::unordered_map<std::string, std::size_t>> indices_;
};

std::optional<SdfScene> SdfReader::run() {
  if (!document_.open()) return std::nullopt;
  SdfModel& world = document_.world();
  scene_.place = world.element.place();
  if (world.element.tag() == "world") list_left_out(world.element, {"model", "include", "frame"});
  if (document_.lights() > 0) scene_.left_out["included light or actor"] += document_.lights();
  for (const auto& model : world.models) {
    if (!report_.full()) read_model(*model);
  }
  if (document_.good() && world.models.empty())
    document_.root().file->fail(scene_.place, "the file holds no <model>");
  if (!document_.good() || report_.full()) return std::nullopt;
  if (!scene_.robots.empty()) scene_.robots.front().repaired = std::move(repaired_);
  return std::move(scene_);
}

void SdfReader::list_left_out(const XmlElement& of, std::initializer_list<std::string_view> read) {
  for (const pugi::xml_node& node : of.node.children()) {
    const std::string_view tag = node.name();
    if (node.type() == pugi::node_element && std::ranges::count(read, tag) == 0)
      leave_out(fmt::format("<{}> of <{}>", tag, of.tag()));
  }
}

void SdfReader::read_model(SdfModel& model) {
  const Pose X_WM = document_.pose_of(document_.world(), model.own_name, model.placed_by);
  if (model.is_static) return read_static_model(model, X_WM);
  links_.clear();
  joints_.clear();
  indices_.clear();
  gather(model, {}, "");
  if (links_.empty() && document_.good())
    model.element.file->fail(model.element.place(),
                             fmt::format("model `{}` has no <link>", model.name));
  for (const SdfLink& link : links_)
    list_left_out(link.element, {"pose", "inertial", "collision", "visual"});
  if (document_.good()) make_robots(model, X_WM);
}

// ------------------------------------------------------------------------------------ what is static

void SdfReader::read_static_model(SdfModel& model, const Pose& X_WM) {
  for (const std::string& name : model.links) {
    const XmlElement& link = model.frames.at(name).element;
    const Pose X_WL = X_WM * document_.pose_of(model, name, link);
    for (const pugi::xml_node& node : link.node.children("collision")) {
      const XmlElement collision{node, link.file};
      read_static_collision(model, collision,
                            X_WL * document_.pose_in_link(model, name, collision));
    }
  }
  for (const auto& inner : model.models) {
    const std::string& name = inner->own_name;
    read_static_model(*inner, X_WM * document_.pose_of(model, name, inner->placed_by));
  }
}

void SdfReader::read_static_collision(const SdfModel& model, const XmlElement& collision,
                                      const Pose& X_WC) {
  if (!sdf_touches(collision)) return leave_out("static collision that does not touch");
  const XmlElement geometry = SdfDocument::child(collision, "geometry");
  const auto is = [&](const char* what) { return static_cast<bool>(geometry.node.child(what)); };
  if (is("plane") || is("heightmap")) {
    if (scene_.ground) return leave_out("second plane or heightmap: a World has one ground");
    scene_.ground = read_sdf_ground(geometry, X_WC, document_, files_);
    if (!scene_.ground) return;
    scene_.ground->name = model.name;
    scene_.ground->material = material_of(collision);
    return;
  }
  UrdfLink link;  // of shapes and points in the world's frame
  if (auto form = read_sdf_shape(geometry)) {
    link.shapes.push_back({{std::move(*form), X_WC.position, X_WC.orientation, 0},
                           collision.place(),
                           true,
                           material_of(collision)});
  } else if (!add_mesh_of(collision, geometry, X_WC, link)) {
    return leave_out(fmt::format("static <{}>", kind_of(geometry)));
  }
  if (!link.points.empty()) {
    std::vector<Vector3d> corners;
    for (const UrdfPoint& point : link.points) corners.push_back(point.position);
    Hull hull = convex_hull(corners);
    if (hull.faces.empty()) return leave_out("static mesh that is flat");
    link.shapes.push_back({{std::move(hull), {}, {}, 0},
                           link.points.front().place,
                           true,
                           link.points.front().material});
  }
  for (UrdfShape& shape : link.shapes) scene_.solids.push_back({model.name, std::move(shape)});
}

bool SdfReader::add_mesh_of(const XmlElement& collision, const XmlElement& geometry,
                            const Pose& X_LS, UrdfLink& link) {
  const XmlElement mesh = SdfDocument::child(geometry, "mesh");
  if (!mesh.node || choices_.geometry.meshes == UrdfMeshes::skip) return false;
  if (mesh.node.child("submesh")) leave_out("<submesh>: the whole mesh is taken");
  const XmlElement uri = SdfDocument::child(mesh, "uri");
  const MeshPoints* const vertices =
      find_mesh(SdfDocument::text_of(mesh, "uri"), (uri.node ? uri : mesh).place(),
                document_.path_of(mesh), files_, *mesh.file);
  if (vertices == nullptr) return true;
  const bool visual = collision.tag() == "visual";
  add_mesh(vertices->vertices, sdf_vector(mesh, "scale", {1., 1., 1.}), choices_.geometry.meshes,
           X_LS, mesh.place(), visual ? "" : material_of(collision), link, scene_.left_out);
  return true;
}

// ------------------------------------------------------------------------------------ links

void SdfReader::gather(SdfModel& model, const Pose& X_OM, const std::string& above) {
  for (const std::string& name : model.links) {
    const XmlElement& element = model.frames.at(name).element;
    indices_[&model].emplace(name, links_.size());
    links_.push_back(
        {element, &model, name, above + name, X_OM * document_.pose_of(model, name, element), {}});
  }
  for (const auto& inner : model.models) {
    const std::string& name = inner->own_name;
    gather(*inner, X_OM * document_.pose_of(model, name, inner->placed_by), above + name + "::");
  }
  // Joints may name links of the models inside.
  for (const pugi::xml_node& node : model.element.node.children("joint"))
    gather_joint(model, {node, model.element.file}, X_OM, above);
  list_left_out(model.element, {"pose", "static", "link", "joint", "frame", "model", "include",
                                "allow_auto_disable", "enable_wind"});
  for (const auto& inner : model.models) {
    if (inner->is_static) leave_out("<static> of a model in one that moves");
  }
}

std::size_t SdfReader::link_index(SdfModel& scope, const char* role, const XmlElement& joint) {
  const XmlElement end = SdfDocument::child(joint, role);
  const std::string name = SdfDocument::text_of(joint, role);
  if (name.empty()) {
    joint.file->fail(joint.place(), fmt::format("joint `{}` lacks <{}>", joint.text("name"), role));
    return no_link;
  }
  const auto [owner, link] = document_.link_of(scope, name, end);
  if (owner == nullptr || owner == &document_.world()) return no_link;
  const auto in_scope = indices_.find(owner);
  if (in_scope == indices_.end()) return no_link;
  const auto found = in_scope->second.find(link);
  return found == in_scope->second.end() ? no_link : found->second;
}

void SdfReader::gather_joint(SdfModel& model, const XmlElement& element, const Pose& X_OM,
                             const std::string& above) {
  const std::string name = element.text("name");
  if (name.empty()) return;
  SdfJoint joint{element, &model, above + name, no_link, no_link, X_OM, {}};
  joint.parent = link_index(model, "parent", element);
  joint.child = link_index(model, "child", element);
  if (joint.child == no_link) {
    if (document_.good())
      element.file->fail(element.place(), fmt::format("joint `{}` carries the world", name));
    return;
  }
  joint.X_MJ =
      X_OM * document_.pose_of_element(model, element, SdfDocument::text_of(element, "child"));
  joints_.push_back(std::move(joint));
}

void SdfReader::make_robots(SdfModel& model, const Pose& X_WM) {
  // Where joint J carries link L: its frame here.
  std::vector<bool> carried(links_.size(), false);
  for (const SdfJoint& joint : joints_) {
    if (carried[joint.child]) continue;  // a loop, which the tree's assembly refuses
    carried[joint.child] = true;
    SdfLink& link = links_[joint.child];
    if (joint.element.text("type") != "fixed")
      link.X_LF = {(inverse(link.X_ML) * joint.X_MJ).position, {}};
  }
  // Links that joints connect have one representative.
  std::vector<std::size_t> group(links_.size());
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
  const auto root_of = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const SdfJoint& joint : joints_) {
    if (joint.parent != no_link) group[root_of(joint.child)] = root_of(joint.parent);
  }
  std::vector<std::size_t> order;  // groups by their first links
  std::unordered_map<std::size_t, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>>
      parts;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    auto& [links, joints] = parts[root_of(i)];
    if (links.empty()) order.push_back(root_of(i));
    links.push_back(i);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j)
    parts[root_of(joints_[j].child)].second.push_back(j);
  for (const std::size_t root : order) {
    const auto& [links, joints] = parts.at(root);
    make_robot(model, X_WM, links, joints,
               order.size() == 1 ? model.name : model.name + "_" + links_[links.front()].full_name);
  }
}

void SdfReader::make_robot(SdfModel& model, const Pose& X_WM, const std::vector<std::size_t>& links,
                           const std::vector<std::size_t>& joints, std::string name) {
  UrdfRobot robot;
  robot.name = std::move(name);
  robot.place = model.element.place();
  UrdfLink& world = robot.links.emplace_back();
  world.name = "world";
  world.place = robot.place;
  std::unordered_map<std::size_t, std::size_t> places{{no_link, 0}};
  std::vector<bool> carried(links_.size(), false);
  bool hangs = false;  // on the world
  for (const std::size_t j : joints) {
    carried[joints_[j].child] = true;
    hangs = hangs || joints_[j].parent == no_link;
  }
  for (const std::size_t i : links) {
    places[i] = robot.links.size();
    robot.links.push_back(read_link(links_[i]));
    if (carried[i] || hangs) continue;
    // A free body, or the root of a tree of them; a second one is an error of the assembly.
    UrdfJoint joint;
    joint.name = links_[i].full_name + "_free";
    joint.place = joint.type_place = links_[i].element.place();
    joint.type = UrdfJointType::floating;
    joint.parent = 0;
    joint.child = places[i];
    robot.start = UrdfStart{X_WM * links_[i].X_ML, {}, {}};
    robot.joints.push_back(std::move(joint));
  }
  const Pose X_MW = inverse(X_WM);
  for (const std::size_t j : joints) {
    if (!report_.full()) add_joint(joints_[j], X_MW, places, robot);
  }
  scene_.robots.push_back(std::move(robot));
}

UrdfLink SdfReader::read_link(const SdfLink& of) {
  UrdfLink link;
  link.name = of.full_name;
  link.place = of.element.place();
  const XmlElement inertial = SdfDocument::child(of.element, "inertial");
  link.inertial_place = inertial.node ? inertial.place() : link.place;
  dts::MassProperties<double> mass;
  if (SdfDocument::flag_attribute(inertial, "auto")) {
    mass = mass_of_collisions(of.element, *of.scope, of.name, document_);
  } else {
    if (!inertial.node) leave_out("<inertial> that is not given: 1 kg and 1 kg m^2");
    mass = read_sdf_inertial(inertial, *of.scope, of.name, document_);
  }
  const Pose X_FL = inverse(of.X_LF);
  const dts::MassProperties<double> placed = dts::placed(mass, X_FL.position, X_FL.orientation);
  link.mass = {placed.mass, placed.center_of_mass, placed.inertia};
  link.has_inertial = mass.mass != 0. || mass.inertia != Symmetric3d{};
  if (const std::string problem = settle_inertia(choices_.inertia, link, repaired_);
      !problem.empty())
    of.element.file->fail(link.inertial_place, problem);
  read_link_shapes(of, link);
  return link;
}

void SdfReader::read_link_shapes(const SdfLink& of, UrdfLink& link) {
  const bool visual = choices_.geometry.shapes == UrdfShapes::visual;
  const Pose X_FL = inverse(of.X_LF);
  for (const pugi::xml_node& node : of.element.node.children(visual ? "visual" : "collision")) {
    const XmlElement element{node, of.element.file};
    const XmlElement geometry = SdfDocument::child(element, "geometry");
    const Pose X_FS = X_FL * document_.pose_in_link(*of.scope, of.name, element);
    const bool touches = visual || sdf_touches(element);
    if (const auto form = read_sdf_shape(geometry)) {
      link.shapes.push_back({{*form, X_FS.position, X_FS.orientation, 0},
                             element.place(),
                             touches,
                             visual || !touches ? "" : material_of(element)});
      continue;
    }
    if (touches && add_mesh_of(element, geometry, X_FS, link)) continue;
    leave_out(fmt::format("<{}> of <{}>", kind_of(geometry), element.tag()));
  }
}

std::string SdfReader::material_of(const XmlElement& collision) {
  const auto material = read_sdf_surface(collision, choices_.contact, scene_.left_out);
  return material ? add_material(*material, scene_.materials) : "";
}

// ------------------------------------------------------------------------------------ joints

void SdfReader::add_joint(const SdfJoint& of, const Pose& X_MW,
                          const std::unordered_map<std::size_t, std::size_t>& places,
                          UrdfRobot& robot) {
  const XmlElement& element = of.element;
  list_left_out(element, {"pose", "parent", "child", "axis", "axis2"});
  const auto frame_of = [&](std::size_t link) {
    return link == no_link ? X_MW : links_[link].X_ML * links_[link].X_LF;
  };
  const Pose X_MC = frame_of(of.child);
  const std::string type = element.text("type");
  const auto add = [&](UrdfJoint joint, std::size_t parent, std::size_t child, const Pose& X_PC) {
    joint.place = element.place();
    joint.type_place = element.place("type");
    joint.parent = parent;
    joint.child = child;
    joint.origin = X_PC;
    robot.joints.push_back(std::move(joint));
  };
  const Pose X_PC = inverse(frame_of(of.parent)) * X_MC;
  const std::size_t parent = places.at(of.parent), child = places.at(of.child);
  if (type == "fixed") {
    UrdfJoint joint;
    joint.name = of.full_name;
    return add(joint, parent, child, X_PC);
  }
  if (type == "revolute" || type == "continuous" || type == "prismatic")
    return add(read_axis(of, "axis", X_MC), parent, child, X_PC);
  if (type == "universal" || type == "revolute2") {
    // Two joints with a link without mass between them.
    UrdfLink between;
    between.name = of.full_name + "_cross";
    between.place = between.inertial_place = element.place();
    const std::size_t middle = robot.links.size();
    robot.links.push_back(std::move(between));
    UrdfJoint first = read_axis(of, "axis", X_MC), second = read_axis(of, "axis2", X_MC);
    second.name += second_axis;
    add(std::move(first), parent, middle, X_PC);
    return add(std::move(second), middle, child, {});
  }
  std::string problem = fmt::format(
      "`{}` is no type of joint: expected revolute, continuous, prismatic, universal, revolute2 or "
      "fixed",
      type);
  if (type == "ball") problem = "a ball joint is not read: write three revolute joints";
  if (type == "screw" || type == "gearbox") problem = fmt::format("a {} joint is not read", type);
  element.file->fail(element.place("type"), problem);
}

UrdfJoint SdfReader::read_axis(const SdfJoint& of, const char* which, const Pose& X_MF) {
  UrdfJoint joint;
  joint.name = of.full_name;
  const XmlElement axis = SdfDocument::child(of.element, which);
  const std::string type = of.element.text("type");
  joint.type = type == "prismatic" ? UrdfJointType::prismatic : UrdfJointType::continuous;
  Vector3d direction = sdf_vector(axis, "xyz", {0., 0., 1.});
  if (!(norm(direction) > 0.)) {
    axis.file->fail(axis.place(), "an axis of length 0 has no direction");
    return joint;
  }
  // In the frame that it names, otherwise the joint's; before 1.5 and with use_parent_model_frame it
  // was the model's.
  const XmlElement xyz = SdfDocument::child(axis, "xyz");
  const std::string expressed_in = xyz.text("expressed_in");
  constexpr int joint_axes = 1005, named_frames = 1007;
  const int version = of.scope->version;
  const bool in_model =
      version < joint_axes ||
      (version < named_frames && SdfDocument::flag(axis, "use_parent_model_frame", false));
  Pose X_MA = of.X_MJ;
  if (!expressed_in.empty() || in_model)
    X_MA = of.X_MS * document_.pose_of(*of.scope, expressed_in, xyz.node ? xyz : of.element);
  direction = rotate(conjugate(X_MF.orientation) * X_MA.orientation, direction);
  joint.axis = (1. / norm(direction)) * direction;
  joint.limit_place = joint.damping_place = joint.friction_place = of.element.place();
  joint.effort_place = joint.velocity_place = joint.rotor_place = of.element.place();
  if (!axis.node) return joint;
  read_limits(axis, type != "continuous", joint);
  read_dynamics(axis, joint);
  if (joint.type != UrdfJointType::fixed) read_mimic(of, axis, joint);
  if (axis.node.child("initial_position")) joint.angle = sdf_number(axis, "initial_position", 0.);
  return joint;
}

void SdfReader::read_limits(const XmlElement& axis, bool bounded, UrdfJoint& joint) {
  const XmlElement limit = SdfDocument::child(axis, "limit");
  if (!limit.node) return;
  joint.limit_place = joint.effort_place = joint.velocity_place = limit.place();
  const auto bound = [&](const char* name) -> std::optional<double> {
    const std::string text = SdfDocument::text_of(limit, name);
    if (text.empty()) return std::nullopt;
    return limit.file->bound(text, SdfDocument::child(limit, name).place());
  };
  const auto stop = [&](const char* name, Beyond side) -> std::optional<double> {
    const std::string text = SdfDocument::text_of(limit, name);
    if (text.empty()) return std::nullopt;
    return limit.file->stop(text, side, SdfDocument::child(limit, name).place());
  };
  joint.effort_limit = bound("effort");
  joint.velocity_limit = bound("velocity");
  for (const char* aside : {"stiffness", "dissipation"}) {
    if (limit.node.child(aside)) leave_out(fmt::format("<{}> of <limit>", aside));
  }
  if (!bounded) return;
  const auto lower = stop("lower", Beyond::below), upper = stop("upper", Beyond::above);
  if (lower && upper && *lower == *upper) {
    leave_out("joint whose limits are equal: fixed");
    return fix_joint(*lower, joint);
  }
  if (lower && upper && *lower > *upper) {
    limit.file->fail(limit.place(),
                     fmt::format("lower = {:g} is not below upper = {:g}", *lower, *upper));
    return;
  }
  if (lower || upper) {
    if (joint.type == UrdfJointType::continuous) joint.type = UrdfJointType::revolute;
    joint.lower_limit = lower;
    joint.upper_limit = upper;
  }
}

void SdfReader::read_dynamics(const XmlElement& axis, UrdfJoint& joint) {
  const XmlElement dynamics = SdfDocument::child(axis, "dynamics");
  if (!dynamics.node || joint.type == UrdfJointType::fixed) return;
  joint.damping_place = joint.friction_place = dynamics.place();
  const auto not_negative = [&](const char* name) {
    const double value = sdf_number(dynamics, name, 0.);
    if (value < 0.)
      dynamics.file->fail(SdfDocument::child(dynamics, name).place(),
                          fmt::format("<{}> is not negative", name));
    return std::max(value, 0.);
  };
  joint.damping = not_negative("damping");
  joint.friction = not_negative("friction");
  joint.stiffness = not_negative("spring_stiffness");
  joint.rest_angle = sdf_number(dynamics, "spring_reference", 0.);
}

// q = multiplier (q_leader - reference) + offset.
void SdfReader::read_mimic(const SdfJoint& of, const XmlElement& axis, UrdfJoint& joint) {
  const XmlElement mimic = SdfDocument::child(axis, "mimic");
  if (!mimic.node) return;
  if (choices_.mimic == UrdfMimic::ignore) return leave_out("<mimic>: the joint moves by itself");
  const double offset = sdf_number(mimic, "offset", 0.);
  if (choices_.mimic == UrdfMimic::fixed) {
    leave_out("<mimic>: the joint is fixed at its offset");
    return fix_joint(offset, joint);
  }
  const double ratio = sdf_number(mimic, "multiplier", 1.);
  const std::string second = mimic.text("axis") == "axis2" ? second_axis : "";
  joint.follows = {of.full(mimic.text("joint")) + second, ratio,
                   offset - ratio * sdf_number(mimic, "reference", 0.), mimic.place()};
}

}  // namespace

std::optional<SdfScene> read_sdf(const language::SourceFile& file, const UrdfChoices& choices,
                                 language::FileStore& files, language::Report& report) {
  return SdfReader(file, choices, files, report).run();
}

}  // namespace hookpoint::simulation
