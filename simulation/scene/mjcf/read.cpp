// The bodies of an MJCF as links and joints. A body's joints turn and slide about its frame one
// after the other: with several of them, the last carries the body and the others links without
// mass. With p_k the place of joint k in the body's frame B,
//   X_PB Trans(p_1) q_1 Trans(p_2 - p_1) q_2 ... Trans(-p_n):
// the link that joint k carries has its frame at p_k, its axes those of B.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "dts/mass_properties.h"
#include "math/rotation.h"
#include "simulation/scene/mjcf/geom.h"
#include "simulation/scene/mjcf/mjcf.h"
#include "simulation/scene/mjcf/vocabulary.h"
#include "simulation/scene/urdf/inertia_repair.h"
#include "simulation/scene/urdf/joint_rules.h"
#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/mesh_shape.h"

namespace hookpoint::simulation {
namespace {

using language::Position;

/// An element of a body, in whatever frames it stands there.
struct Placed {
  XmlElement element;
  Pose X_BF;
  std::string childclass;
};

/// Where numbers of a keyframe belong.
struct JointAddress {
  std::size_t robot = 0, joint = 0;
  bool is_free = false;
};

class MjcfReader {
 public:
  MjcfReader(const language::SourceFile& file, const MjcfChoices& choices,
             language::FileStore& files, language::Report& report)
      : document_(file, files, report), choices_(choices), files_(files), report_(report) {}

  std::optional<MjcfScene> run();

 private:
  void leave_out(const std::string& what) { ++left_out_[what]; }
  void leave_out_unread(const XmlElement& element) {
    const bool contact_is_read = choices_.contact == StatedContact::file && element.tag() == "geom";
    for (const std::string& name : unread_mjcf_attributes(element))
      if (!contact_is_read || (name != "solref" && name != "solimp" && name != "condim"))
        leave_out(fmt::format("{} of <{}>", name, element.tag()));
  }

  void read_worldbody();
  void read_top_body(const Placed& at);
  std::vector<Placed> elements_of(const XmlElement& body, const Pose& X_BF,
                                  const std::string& childclass, std::size_t depth = 0);
  /// `X_LP`: of the carrying body's frame in its link's.
  void read_body(const Placed& at, std::size_t robot, std::size_t parent, const Pose& X_LP,
                 std::size_t depth);
  UrdfJoint read_joint(const Placed& at, const std::string& body, std::size_t number);
  void read_range(const MjcfAttributes& given, UrdfJoint& joint);
  UrdfJoint read_free_joint(const Placed& at, const std::string& body);
  void read_contents(const std::vector<Placed>& items, const Pose& X_LB, UrdfLink& link);
  void read_geom_at(const Placed& at, const Pose& X_LB, UrdfLink& link,
                    std::vector<dts::MassProperties<double>>& masses, Position& massless);
  void add_shape(const MjcfGeom& geom, const MjcfAttributes& given, const Pose& X_LG,
                 UrdfLink& link);
  void add_mesh_geom(const MjcfAttributes& given, const Pose& X_LG, UrdfLink& link);
  std::string material_of(const MjcfAttributes& given);
  void add_stated_contact(const MjcfAttributes& given, const std::vector<double>& friction,
                          SurfaceMaterial& material);
  void read_friction(const XmlElement& option);
  void require_mass();
  /// `joint` equalities: one joint follows another, or is fixed.
  void read_couplings();
  void read_coupling(const XmlElement& element);
  void read_actuators();
  void read_actuator(const XmlElement& element);
  void read_keyframe();
  void take_key(const XmlElement& key);
  void read_sections();
  void scale_mass();
  /// `name` if nothing else of its kind is called so, otherwise with a number.
  std::string unique(std::string name, std::set<std::string>& taken);

  MjcfDocument document_;
  const MjcfChoices& choices_;
  language::FileStore& files_;
  language::Report& report_;
  MjcfScene scene_;
  contact::MujocoFriction friction_;
  std::map<std::string, std::size_t> left_out_;
  std::vector<std::string> repaired_;
  std::set<std::string> link_names_, joint_names_;
  std::map<std::string, JointAddress> joints_;  ///< by their names in the file
  std::vector<JointAddress> addresses_;         ///< in the order of qpos
  std::map<std::string, XmlElement> meshes_;
};

std::optional<MjcfScene> MjcfReader::run() {
  if (!document_.open()) return std::nullopt;
  scene_.name = document_.root().text("model");
  scene_.place = document_.root().place();
  read_sections();
  read_worldbody();
  if (document_.good()) require_mass();
  read_couplings();
  read_actuators();
  read_keyframe();
  scale_mass();
  std::erase_if(scene_.robots, [](const UrdfRobot& robot) { return robot.joints.empty(); });
  // What moves freely is what an Include is about. (The ranges' own gives a subrange, which clang 14
  // cannot do with this library.)
  std::stable_partition(scene_.robots.begin(), scene_.robots.end(),
                        [](const UrdfRobot& robot) { return robot.start.has_value(); });
  if (document_.good() && scene_.robots.empty())
    document_.root().file->fail(scene_.place, "the file has no <body> that moves");
  if (!document_.good()) return std::nullopt;
  scene_.robots.front().left_out = std::move(left_out_);
  scene_.robots.front().repaired = std::move(repaired_);
  return std::move(scene_);
}

void MjcfReader::read_sections() {
  for (const XmlElement& section : document_.children(document_.root())) {
    const std::string_view tag = section.tag();
    const bool is_read = tag == "compiler" || tag == "default" || tag == "worldbody" ||
                         tag == "actuator" || tag == "keyframe" || tag == "asset";
    // Without effect on what moves.
    const bool is_aside = tag == "visual" || tag == "statistic" || tag == "size" ||
                          tag == "custom" || tag == "option";
    const bool is_list = tag == "equality" || tag == "tendon" || tag == "contact" ||
                         tag == "sensor" || tag == "deformable" || tag == "extension";
    if (is_list) {
      for (const XmlElement& element : document_.children(section))
        if (tag != "equality" || element.tag() != "joint")
          leave_out(tag == "sensor" ? "<sensor>" : fmt::format("<{}> of <{}>", element.tag(), tag));
    } else if (is_aside) {
      if (tag == "option" && choices_.contact == StatedContact::file) read_friction(section);
      leave_out(fmt::format("<{}>", tag));
    } else if (!is_read) {
      section.file->fail(section.place(), fmt::format("<mujoco> has no <{}>", tag));
    }
  }
  for (const XmlElement& asset : document_.in_sections("asset")) {
    if (asset.tag() != "mesh") continue;
    check_mjcf_attributes(asset);
    leave_out_unread(asset);
    std::string name = asset.text("name");
    if (name.empty()) name = std::filesystem::path(asset.text("file")).stem().string();
    meshes_.emplace(name, asset);
  }
}

void MjcfReader::read_worldbody() {
  UrdfRobot& world = scene_.robots.emplace_back();
  world.name = "fixed";
  world.place = scene_.place;
  UrdfLink& link = world.links.emplace_back();
  link.name = "world";
  link.place = scene_.place;
  for (const XmlElement& section : document_.children(document_.root())) {
    if (section.tag() != "worldbody") continue;
    for (const Placed& at : elements_of(section, {}, "")) {
      if (at.element.tag() == "body") {
        read_top_body(at);
      } else {
        leave_out(fmt::format("<{}> of the world", at.element.tag()));
      }
    }
  }
}

void MjcfReader::read_top_body(const Placed& at) {
  const auto items = elements_of(at.element, {}, at.childclass);
  const bool is_free = std::ranges::any_of(items, [](const Placed& item) {
    return item.element.tag() == "freejoint" ||
           (item.element.tag() == "joint" && item.element.text("type") == "free");
  });
  if (!is_free) return read_body(at, 0, 0, {}, 0);
  UrdfRobot& robot = scene_.robots.emplace_back();
  robot.name = at.element.text("name");
  robot.place = at.element.place();
  UrdfLink& world = robot.links.emplace_back();
  world.name = "world";
  world.place = at.element.place();
  read_body(at, scene_.robots.size() - 1, 0, {}, 0);
}

std::vector<Placed> MjcfReader::elements_of(const XmlElement& body, const Pose& X_BF,
                                            const std::string& childclass, std::size_t depth) {
  constexpr std::size_t deepest = 100;
  std::vector<Placed> found;
  if (depth > deepest) {
    body.file->fail(body.place(), fmt::format("frames stand in each other {} deep", depth));
    return found;
  }
  for (const XmlElement& element : document_.children(body)) {
    if (element.tag() != "frame") {
      found.push_back({element, X_BF, childclass});
      continue;
    }
    check_mjcf_attributes(element);
    const std::string own = element.text("childclass");
    const Pose X_FG = document_.pose(MjcfAttributes(element, {}));
    const auto inside =
        elements_of(element, X_BF * X_FG, own.empty() ? childclass : own, depth + 1);
    found.insert(found.end(), inside.begin(), inside.end());
  }
  return found;
}

std::string MjcfReader::unique(std::string name, std::set<std::string>& taken) {
  if (taken.insert(name).second) return name;
  for (std::size_t number = 2;; ++number) {
    std::string other = fmt::format("{}_{}", name, number);
    if (taken.insert(other).second) return other;
  }
}

void MjcfReader::read_body(const Placed& at, std::size_t robot, std::size_t parent,
                           const Pose& X_LP, std::size_t depth) {
  constexpr std::size_t deepest = 500;
  const XmlElement& element = at.element;
  if (report_.full()) return;
  if (depth > deepest) {
    element.file->fail(element.place(), fmt::format("bodies hang on each other {} deep: {} are "
                                                    "the most",
                                                    depth, deepest));
    return;
  }
  check_mjcf_attributes(element);
  leave_out_unread(element);
  if (element.text("mocap") == "true") return leave_out("mocap body");
  const std::string own_class = element.text("childclass");
  const std::string childclass = own_class.empty() ? at.childclass : own_class;
  const std::string written = element.text("name");
  if (!written.empty() && link_names_.contains(written))
    element.file->fail(element.place("name"), fmt::format("a second body `{}`", written));
  const std::string name = unique(
      written.empty() ? fmt::format("body_{}", link_names_.size() + 1) : written, link_names_);
  const std::vector<Placed> items = elements_of(element, {}, childclass);

  std::vector<UrdfJoint> joints;
  std::vector<Vector3d> anchors;
  for (const Placed& item : items) {
    if (item.element.tag() == "freejoint" ||
        (item.element.tag() == "joint" && item.element.text("type") == "free")) {
      if (depth > 0 || !joints.empty()) {
        item.element.file->fail(item.element.place(),
                                "a free joint is the only one of a body of the world");
        return;
      }
      joints.push_back(read_free_joint(item, name));
      anchors.emplace_back();
    } else if (item.element.tag() == "joint") {
      if (!joints.empty() && joints.back().type == UrdfJointType::floating) {
        item.element.file->fail(item.element.place(),
                                "a free joint is the only one of a body of the world");
        return;
      }
      joints.push_back(read_joint(item, name, joints.size()));
      const Vector3d pos = document_.attributes(item.element, item.childclass).vector("pos", {});
      anchors.push_back((item.X_BF * Pose{pos, {}}).position);
    }
  }
  UrdfRobot& of = scene_.robots[robot];
  const Pose X_PB = at.X_BF * document_.pose(MjcfAttributes(element, {}));
  Pose X_LB = X_LP * X_PB;  // in the link that the next joint hangs on
  if (joints.empty()) {
    joints.emplace_back();
    joints.back().name = unique(name + "_weld", joint_names_);
    joints.back().place = element.place();
    anchors.emplace_back();
  }
  for (std::size_t k = 0; k < joints.size(); ++k) {
    UrdfJoint& joint = joints[k];
    const bool last = k + 1 == joints.size();
    UrdfLink link;
    link.name = last ? name : unique(name + "_" + joint.name, link_names_);
    link.place = last ? element.place() : joint.place;
    joint.parent = parent;
    joint.child = of.links.size();
    const Pose X_BJ = joint.origin;  // at the joint's own zero
    joint.origin = X_LB * X_BJ;
    X_LB = {-anchors[k], {}};
    if (joint.type == UrdfJointType::floating) of.start = UrdfStart{X_PB, {}, {}};
    if (joint.type != UrdfJointType::fixed)
      addresses_.push_back({robot, of.joints.size(), joint.type == UrdfJointType::floating});
    if (last) read_contents(items, X_LB, link);
    parent = of.links.size();
    of.links.push_back(std::move(link));
    if (joint.type != UrdfJointType::fixed) joints_[joint.name] = addresses_.back();
    of.joints.push_back(std::move(joint));
  }
  for (const Placed& item : items) {
    if (item.element.tag() == "body") read_body(item, robot, parent, X_LB, depth + 1);
  }
}

UrdfJoint MjcfReader::read_free_joint(const Placed& at, const std::string& body) {
  const MjcfAttributes given = document_.attributes(at.element, at.childclass);
  for (const char* aside : {"armature", "damping", "frictionloss", "stiffness"}) {
    if (given.number(aside, 0.) != 0.) leave_out(fmt::format("{} of a free joint", aside));
  }
  UrdfJoint joint;
  const std::string written = at.element.text("name");
  joint.name = unique(written.empty() ? body + "_free" : written, joint_names_);
  joint.place = joint.type_place = at.element.place();
  joint.type = UrdfJointType::floating;
  return joint;
}

UrdfJoint MjcfReader::read_joint(const Placed& at, const std::string& body, std::size_t number) {
  const MjcfAttributes given = document_.attributes(at.element, at.childclass);
  leave_out_unread(at.element);
  UrdfJoint joint;
  joint.place = joint.type_place = at.element.place();
  const std::string written = at.element.text("name");
  if (!written.empty() && joint_names_.contains(written))
    at.element.file->fail(at.element.place("name"), fmt::format("a second joint `{}`", written));
  joint.name = unique(
      written.empty() ? fmt::format("{}_joint{}", body, number == 0 ? "" : std::to_string(number))
                      : written,
      joint_names_);
  const std::string type = given.word("type");
  if (type == "ball" || (!type.empty() && type != "hinge" && type != "slide")) {
    given.fail("type", type == "ball" ? "a ball joint is not read: write three hinges"
                                      : fmt::format("`{}` is no type of joint", type));
    return joint;
  }
  const bool slides = type == "slide";
  joint.type = slides ? UrdfJointType::prismatic : UrdfJointType::continuous;
  const Vector3d axis = rotate(at.X_BF.orientation, given.vector("axis", {0., 0., 1.}));
  if (!(norm(axis) > 0.)) {
    given.fail("axis", "an axis of length 0 has no direction");
    return joint;
  }
  joint.axis = (1. / norm(axis)) * axis;
  const auto measure = [&](const char* attribute) {
    const double value = given.number(attribute, 0.);
    return slides ? value : document_.angle(value);
  };
  // The pose of the file is at q = ref.
  const double ref = measure("ref");
  const Vector3d anchor = (at.X_BF * Pose{given.vector("pos", {}), {}}).position;
  joint.origin = {anchor, {}};
  if (ref != 0.)
    joint.origin = joint.origin * (slides ? Pose{-ref * joint.axis, {}}
                                          : Pose{{}, exponential(-ref * joint.axis)});
  joint.angle = ref;
  joint.rest_angle = measure("springref");
  // A polynomial of which the first number is the linear term.
  const auto first_of = [&](const char* attribute) {
    const auto terms = given.numbers(attribute, {0., 0., 0.});
    if (terms[1] != 0. || terms[2] != 0.)
      given.fail(attribute, fmt::format("{} that is not linear is not read", attribute));
    if (terms[0] < 0.) given.fail(attribute, fmt::format("{} is not negative", attribute));
    return terms[0];
  };
  joint.stiffness = first_of("stiffness");
  joint.damping = first_of("damping");
  joint.friction = first_of("frictionloss");
  joint.rotor_inertia = first_of("armature");
  joint.damping_place = given.place("damping");
  joint.friction_place = given.place("frictionloss");
  joint.rotor_place = given.place("armature");
  joint.limit_place = given.place("range");
  read_range(given, joint);
  return joint;
}

void MjcfReader::read_range(const MjcfAttributes& given, UrdfJoint& joint) {
  const auto limits = [&](const char* range, const char* limited) {
    const auto ends = given.numbers(range, {0., 0.});
    const std::string said = given.word(limited);
    const bool holds = said == "true" || (said != "false" && document_.compiler().autolimits &&
                                          (ends[0] != 0. || ends[1] != 0.));
    if (!holds) return std::optional<std::vector<double>>{};
    if (ends[0] < ends[1]) return std::optional(ends);
    given.fail(range, fmt::format("{:g} is not below {:g}", ends[0], ends[1]));
    return std::optional<std::vector<double>>{};
  };
  if (const auto ends = limits("range", "limited")) {
    const bool slides = joint.type == UrdfJointType::prismatic;
    if (!slides) joint.type = UrdfJointType::revolute;
    joint.lower_limit = slides ? (*ends)[0] : document_.angle((*ends)[0]);
    joint.upper_limit = slides ? (*ends)[1] : document_.angle((*ends)[1]);
  }
  if (const auto ends = limits("actuatorfrcrange", "actuatorfrclimited")) {
    joint.effort_limit = std::max(std::abs((*ends)[0]), std::abs((*ends)[1]));
    joint.effort_place = given.place("actuatorfrcrange");
  }
}

void MjcfReader::read_contents(const std::vector<Placed>& items, const Pose& X_LB, UrdfLink& link) {
  std::vector<dts::MassProperties<double>> masses;
  std::optional<dts::MassProperties<double>> given_mass;
  Position unknown;  // of a geom whose mass is not known
  link.inertial_place = link.place;
  for (const Placed& item : items) {
    const std::string_view tag = item.element.tag();
    if (tag == "geom") {
      read_geom_at(item, X_LB, link, masses, unknown);
    } else if (tag == "inertial") {
      if (given_mass) {
        item.element.file->fail(item.element.place(), "a second <inertial> of a body");
        continue;
      }
      check_mjcf_attributes(item.element);
      link.inertial_place = item.element.place();
      given_mass = read_inertial(MjcfAttributes(item.element, {}), document_);
    } else if (tag == "site" || tag == "camera" || tag == "light") {
      leave_out(fmt::format("<{}>", tag));
    } else if (tag != "joint" && tag != "freejoint" && tag != "body") {
      item.element.file->fail(item.element.place(), fmt::format("<{}> of a body is not read", tag));
    }
  }
  using From = MjcfCompiler::FromGeoms;
  const MjcfCompiler& compiler = document_.compiler();
  const bool from_geoms = compiler.inertia_from_geoms == From::always ||
                          (compiler.inertia_from_geoms == From::where_missing && !given_mass);
  if (from_geoms && unknown.file != nullptr)
    report_.error(unknown, fmt::format("body `{}` has the mass of its geoms, and that of a mesh is "
                                       "not computed: give the body an <inertial>",
                                       link.name));
  dts::MassProperties<double> mass =
      from_geoms ? dts::combined(masses) : given_mass.value_or(dts::MassProperties<double>{});
  bound_mass(compiler, mass);
  link.has_inertial = mass.mass != 0. || mass.inertia != Symmetric3d{};
  const dts::MassProperties<double> placed = dts::placed(mass, X_LB.position, X_LB.orientation);
  link.mass = {placed.mass, placed.center_of_mass, placed.inertia};
  if (const std::string problem = settle_inertia(choices_.inertia, link, repaired_);
      !problem.empty())
    report_.error(link.inertial_place, problem);
}

void MjcfReader::read_geom_at(const Placed& at, const Pose& X_LB, UrdfLink& link,
                              std::vector<dts::MassProperties<double>>& masses, Position& unknown) {
  const MjcfAttributes given = document_.attributes(at.element, at.childclass);
  leave_out_unread(at.element);
  const std::optional<MjcfGeom> geom = read_geom(given, document_);
  if (!geom) return;
  const double group = given.number("group", 0.);
  const MjcfCompiler& compiler = document_.compiler();
  if (group >= compiler.first_group && group <= compiler.last_group) {
    if (const auto mass = mass_of_geom(*geom, given)) {
      masses.push_back(dts::placed(*mass, at.X_BF.position, at.X_BF.orientation));
    } else {
      unknown = at.element.place();
    }
  }
  add_shape(*geom, given, X_LB * at.X_BF * geom->pose, link);
}

void MjcfReader::add_shape(const MjcfGeom& geom, const MjcfAttributes& given, const Pose& X_LG,
                           UrdfLink& link) {
  const auto add = [&](const ShapeGeometry& form) {
    link.shapes.push_back({{form, X_LG.position, X_LG.orientation, 0},
                           given.own().place(),
                           geom.touches,
                           geom.touches ? material_of(given) : ""});
  };
  const Vector3d& size = geom.size;
  switch (geom.form) {
    case MjcfForm::sphere:
      return add(Sphere{size.x});
    case MjcfForm::capsule:
      return add(Capsule{size.x, 2. * size.y});
    case MjcfForm::cylinder:
      return add(Cylinder{size.x, 2. * size.y});
    case MjcfForm::box:
      return add(Box{2. * size});
    case MjcfForm::ellipsoid:
      return leave_out(geom.touches ? "ellipsoid that touches" : "ellipsoid");
    case MjcfForm::mesh:
      if (!geom.touches) return leave_out("mesh that does not touch");
      if (choices_.meshes == UrdfMeshes::skip) return leave_out("mesh that touches");
      return add_mesh_geom(given, X_LG, link);
    case MjcfForm::plane:
    case MjcfForm::heights:
      return leave_out("plane or height field of a body");
  }
}

void MjcfReader::add_mesh_geom(const MjcfAttributes& given, const Pose& X_LG, UrdfLink& link) {
  const std::string name = given.word("mesh");
  const auto found = meshes_.find(name);
  if (found == meshes_.end()) {
    given.fail("mesh", fmt::format("there is no mesh `{}`", name));
    return;
  }
  const XmlElement& asset = found->second;
  const std::filesystem::path file =
      std::filesystem::path(document_.compiler().mesh_folder) / asset.text("file");
  const std::filesystem::path path = files_.find(file, document_.main_file().path);
  const Position at = asset.place("file");
  if (path.empty()) {
    asset.file->fail(
        at, fmt::format("there is no mesh `{}` (meshes = skip does without)", file.string()));
    return;
  }
  const MeshPoints& mesh = files_.keep<MeshPoints>("mesh " + path.lexically_normal().string(),
                                                   [&] { return read_mesh(path); });
  if (!mesh.problem.empty()) {
    asset.file->fail(at,
                     fmt::format("the mesh {} cannot be read: {}", path.string(), mesh.problem));
    return;
  }
  const Vector3d scale = document_.attributes(asset, "").vector("scale", {1., 1., 1.});
  add_mesh(mesh.vertices, scale, choices_.meshes, X_LG, given.own().place(), material_of(given),
           link, left_out_);
}

std::string MjcfReader::material_of(const MjcfAttributes& given) {
  const bool all = choices_.contact == StatedContact::file;
  if (choices_.contact == StatedContact::ground || (!all && !given.has("friction"))) return "";
  const std::vector<double> friction = given.numbers("friction", {1., 0.005, 0.0001});
  const auto read = std::span(friction).first(all ? friction.size() : 1);
  if (std::ranges::any_of(read, [](double coefficient) { return coefficient < 0.; })) {
    given.fail("friction", "a coefficient of friction is not negative");
    return "";
  }
  SurfaceMaterial material;
  material.place = given.place("friction");
  material.friction = friction[0];
  if (all) add_stated_contact(given, friction, material);
  return add_material(std::move(material), scene_.materials);
}

/// solref and solimp, at MuJoCo's defaults where the file has none, with the cone and impratio of its
/// <option>; how many friction rows a contact has (condim) says which coefficients count.
void MjcfReader::add_stated_contact(const MjcfAttributes& given,
                                    const std::vector<double>& friction,
                                    SurfaceMaterial& material) {
  const double rows = given.number("condim", 3.);
  if (rows != 1. && rows != 3. && rows != 4. && rows != 6.) {
    given.fail("condim", "condim is 1, 3, 4 or 6");
    return;
  }
  if (rows == 1.) material.friction = 0.;
  if (rows >= 4.) material.spinning = friction[1];
  if (rows >= 6.) material.rolling = friction[2];
  contact::MujocoContact stated{{}, friction_};
  const auto read = [&](const char* attribute, auto& numbers) {
    std::ranges::copy(given.numbers(attribute, {numbers.begin(), numbers.end()}), numbers.begin());
  };
  read("solref", stated.row.reference);
  read("solimp", stated.row.impedance);
  material.mujoco = stated;
}

/// One for all contacts.
void MjcfReader::read_friction(const XmlElement& option) {
  const std::string cone = option.text("cone");
  if (!cone.empty() && cone != "elliptic" && cone != "pyramidal")
    option.file->fail(option.place("cone"), "cone is elliptic or pyramidal");
  if (!cone.empty()) friction_.elliptic = cone == "elliptic";
  const MjcfAttributes given = document_.attributes(option, "");
  friction_.impedance_ratio = given.number("impratio", friction_.impedance_ratio);
  if (!(friction_.impedance_ratio > 0.)) given.fail("impratio", "impratio is above 0");
}

/// A joint beyond which nothing has a mass cannot be set in motion.
void MjcfReader::require_mass() {
  for (const UrdfRobot& robot : scene_.robots) {
    std::vector<bool> heavy(robot.links.size(), false);
    for (std::size_t i = 0; i < robot.links.size(); ++i) heavy[i] = robot.links[i].mass.mass > 0.;
    // Joints stand in the order of their links: a link's own comes before those beyond it.
    for (auto joint = robot.joints.rbegin(); joint != robot.joints.rend(); ++joint) {
      if (heavy[joint->child]) heavy[joint->parent] = true;
      if (!heavy[joint->child] && joint->type != UrdfJointType::fixed)
        document_.root().file->fail(
            joint->place, fmt::format("joint `{}` moves a body without mass", joint->name));
    }
  }
}

void MjcfReader::read_couplings() {
  for (const XmlElement& element : document_.in_sections("equality"))
    if (element.tag() == "joint") read_coupling(element);
}

// q1 - ref1 = c0 + c1 (q2 - ref2) + ...; joints stand at their references so far.
void MjcfReader::read_coupling(const XmlElement& element) {
  const MjcfAttributes given(element, {});
  if (choices_.mimic == UrdfMimic::ignore) return leave_out("<joint> of <equality>");
  if (given.word("active") == "false") return leave_out("equality that is not active");
  const std::vector<double> c = given.numbers("polycoef", {0., 1., 0., 0., 0.});
  if (c[2] != 0. || c[3] != 0. || c[4] != 0.)
    return leave_out("<joint> of <equality> that is not linear");
  const auto find = [&](const char* attribute) -> UrdfJoint* {
    const auto found = joints_.find(given.word(attribute));
    if (found != joints_.end() && !found->second.is_free)
      return &scene_.robots[found->second.robot].joints[found->second.joint];
    given.fail(attribute, fmt::format("there is no joint `{}` to couple", given.word(attribute)));
    return nullptr;
  };
  UrdfJoint* const follower = find("joint1");
  if (follower == nullptr) return;
  const double at = follower->angle.value_or(0.) + c[0];
  if (choices_.mimic == UrdfMimic::fixed || !given.has("joint2")) return fix_joint(at, *follower);
  const UrdfJoint* const leader = find("joint2");
  if (leader == nullptr) return;
  follower->follows = {leader->name, c[1], at - c[1] * leader->angle.value_or(0.), element.place()};
}

void MjcfReader::read_actuators() {
  for (const XmlElement& element : document_.in_sections("actuator")) {
    const std::string_view tag = element.tag();
    if (tag == "motor" || tag == "position" || tag == "velocity" || tag == "general") {
      read_actuator(element);
    } else {
      leave_out(fmt::format("<{}> of <actuator>", tag));
    }
  }
}

void MjcfReader::read_actuator(const XmlElement& element) {
  const MjcfAttributes given = document_.attributes(element, "");
  leave_out_unread(element);
  const std::string name = given.word("joint");
  if (name.empty()) return leave_out(fmt::format("<{}> of no joint", element.tag()));
  const auto found = joints_.find(name);
  if (found == joints_.end()) {
    given.fail("joint", fmt::format("there is no joint `{}`", name));
    return;
  }
  if (found->second.is_free) return leave_out(fmt::format("<{}> of a free joint", element.tag()));
  UrdfJoint& joint = scene_.robots[found->second.robot].joints[found->second.joint];
  const double gear = given.numbers("gear", {1., 0., 0., 0., 0., 0.})[0];
  // torque = gear (gain ctrl + bias_0 + bias_1 gear q + bias_2 gear dq/dt)
  double gain = given.numbers("gainprm", std::vector<double>(10, 0.))[0];
  if (!given.has("gainprm")) gain = 1.;
  std::vector<double> bias = given.numbers("biasprm", std::vector<double>(10, 0.));
  const bool affine = given.word("biastype") == "affine";
  if (element.tag() == "general" &&
      ((!given.word("biastype").empty() && !affine && given.word("biastype") != "none") ||
       (!given.word("gaintype").empty() && given.word("gaintype") != "fixed")))
    return leave_out("<general> whose gain or bias is of another type");
  if (!affine) std::ranges::fill(bias, 0.);
  if (element.tag() == "position") {
    gain = given.number("kp", gain);
    bias = {0., -gain, -given.number("kv", -bias[2])};
  } else if (element.tag() == "velocity") {
    gain = given.number("kv", gain);
    bias = {0., 0., -gain};
  } else if (element.tag() == "motor") {
    gain = 1.;
    bias = {0., 0., 0.};
  }
  const auto limit = [&](const char* range, const char* limited, double factor) {
    const auto ends = given.numbers(range, {0., 0.});
    const std::string said = given.word(limited);
    const double most = factor * std::max(std::abs(ends[0]), std::abs(ends[1]));
    if (said == "false" || !(most > 0.)) return;
    if (said != "true" && !document_.compiler().autolimits) return;
    if (joint.effort_limit && *joint.effort_limit <= most) return;
    joint.effort_limit = most;
    joint.effort_place = given.place(range);
  };
  limit("forcerange", "forcelimited", std::abs(gear));
  const bool is_motor = bias[0] == 0. && bias[1] == 0. && bias[2] == 0.;
  if (is_motor) return limit("ctrlrange", "ctrllimited", std::abs(gear * gain));
  UrdfServo servo;
  servo.place = element.place();
  servo.damping = -gear * gear * bias[2];
  servo.gain = gear * gear * gain;
  servo.of_rate = bias[1] == 0.;
  if (gear == 0. || bias[0] != 0. || (servo.of_rate ? bias[2] != -gain : bias[1] != -gain))
    return leave_out(fmt::format("<{}> that is no servo", element.tag()));
  if (servo.of_rate || bias[2] == 0.) servo.damping = 0.;
  if (joint.servo) return leave_out("second servo of a joint");
  joint.servo = servo;
}

void MjcfReader::read_keyframe() {
  std::string known;
  for (const XmlElement& key : document_.in_sections("keyframe")) {
    check_mjcf_attributes(key);
    const std::string name = key.text("name");
    if (!choices_.keyframe.empty() && name == choices_.keyframe) return take_key(key);
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
  }
  if (choices_.keyframe.empty()) {
    if (!known.empty()) left_out_[fmt::format("keyframe ({}: the argument `keyframe`)", known)] = 1;
    return;
  }
  report_.error(choices_.keyframe_place,
                fmt::format("the file has no <key> `{}`; it has {}", choices_.keyframe,
                            known.empty() ? "none" : known));
}

void MjcfReader::take_key(const XmlElement& key) {
  std::size_t positions = 0, rates = 0;
  for (const JointAddress& at : addresses_) {
    positions += at.is_free ? 7 : 1;
    rates += at.is_free ? 6 : 1;
  }
  const auto numbers = [&](const char* attribute, std::size_t wanted) {
    const std::vector<double> given = key.file->numbers(key.node, attribute, wanted);
    if (!given.empty() && given.size() != wanted)
      key.file->fail(key.place(attribute), fmt::format("{} has {} numbers, and the file's joints "
                                                       "{}",
                                                       attribute, given.size(), wanted));
    return given.size() == wanted ? given : std::vector<double>{};
  };
  const std::vector<double> q = numbers("qpos", positions), v = numbers("qvel", rates);
  std::size_t next = 0, next_rate = 0;
  for (const JointAddress& at : addresses_) {
    UrdfRobot& robot = scene_.robots[at.robot];
    if (at.is_free) {
      UrdfStart& start = *robot.start;
      if (!q.empty()) {
        const Quaterniond turn{q[next + 3], q[next + 4], q[next + 5], q[next + 6]};
        if (turn == Quaterniond{0., 0., 0., 0.}) {
          key.file->fail(key.place("qpos"), "a quaternion of length 0 is no orientation");
          return;
        }
        start.pose = {{q[next], q[next + 1], q[next + 2]}, normalized(turn)};
      }
      if (!v.empty()) {
        start.velocity = {v[next_rate], v[next_rate + 1], v[next_rate + 2]};
        // MJCF has it in the body's axes.
        start.angular_velocity = rotate(
            start.pose.orientation, Vector3d{v[next_rate + 3], v[next_rate + 4], v[next_rate + 5]});
      }
    } else {
      UrdfJoint& joint = robot.joints[at.joint];
      if (!q.empty()) joint.angle = q[next];
      if (!v.empty()) joint.rate = v[next_rate];
    }
    next += at.is_free ? 7 : 1;
    next_rate += at.is_free ? 6 : 1;
  }
  const auto actuators = document_.in_sections("actuator");
  const std::vector<double> ctrl = numbers("ctrl", actuators.size());
  for (std::size_t i = 0; i < ctrl.size(); ++i) {
    const MjcfAttributes given = document_.attributes(actuators[i], "");
    const auto found = joints_.find(given.word("joint"));
    if (found == joints_.end() || found->second.is_free) continue;
    UrdfJoint& joint = scene_.robots[found->second.robot].joints[found->second.joint];
    const double gear = given.numbers("gear", {1., 0., 0., 0., 0., 0.})[0];
    const bool is_its_own = joint.servo && joint.servo->place.file == actuators[i].place().file &&
                            joint.servo->place.offset == actuators[i].place().offset;
    if (is_its_own) joint.servo->goal = ctrl[i] / gear;
  }
}

/// `settotalmass`: of all bodies together.
void MjcfReader::scale_mass() {
  const double wanted = document_.compiler().total_mass;
  if (wanted <= 0.) return;
  double total = 0.;
  for (const UrdfRobot& robot : scene_.robots)
    for (const UrdfLink& link : robot.links) total += link.mass.mass;
  if (!(total > 0.)) return;
  for (UrdfRobot& robot : scene_.robots) {
    for (UrdfLink& link : robot.links) {
      link.mass.mass *= wanted / total;
      link.mass.inertia = (wanted / total) * link.mass.inertia;
    }
  }
}

}  // namespace

std::optional<MjcfScene> read_mjcf(const language::SourceFile& file, const MjcfChoices& choices,
                                   language::FileStore& files, language::Report& report) {
  return MjcfReader(file, choices, files, report).run();
}

}  // namespace hookpoint::simulation
