// The bodies of an MJCF as links and joints. A body's joints turn and slide about its frame one
// after the other: with several of them, the last carries the body and the others links without
// mass. With p_k the place of joint k in the body's frame B,
//   X_PB Trans(p_1) q_1 Trans(p_2 - p_1) q_2 ... Trans(-p_n):
// the link that joint k carries has its frame at p_k, its axes those of B.
#include <algorithm>
#include <cmath>
#include <span>

#include "math/rotation.h"
#include "simulation/scene/mjcf/reader.h"
#include "simulation/scene/urdf/inertia_repair.h"
#include "simulation/scene/urdf/mesh_shape.h"

namespace hookpoint::simulation {

std::optional<MjcfScene> MjcfReader::run() {
  if (!document_.open()) return std::nullopt;
  scene_.name = document_.root().text("model");
  scene_.place = document_.root().place();
  read_sections();
  read_worldbody();
  if (document_.good()) require_mass();
  scale_mass();
  if (document_.good()) settle_springs();
  if (document_.good()) check_references();
  read_couplings();
  read_actuators();
  read_keyframe();
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
      read_list(section);
    } else if (is_aside) {
      if (tag == "option" && choices_.contact == StatedContact::file) {
        read_friction(section);
      } else {
        leave_out(fmt::format("<{}>", tag));
      }
    } else if (!is_read) {
      section.file->fail(section.place(), fmt::format("<mujoco> has no <{}>", tag));
    }
  }
  read_assets();
}

void MjcfReader::read_list(const XmlElement& section) {
  const std::string_view tag = section.tag();
  for (const XmlElement& element : document_.children(section)) {
    if (!check_mjcf_child(element, tag)) continue;
    if (element.tag() == "pair") read_contact_pair(element);
    if (!is_mjcf_coupling(element, tag))
      leave_out(tag == "sensor" ? "<sensor>" : fmt::format("<{}> of <{}>", element.tag(), tag));
  }
}

void MjcfReader::read_contact_pair(const XmlElement& pair) {
  for (const char* geom : {"geom1", "geom2"}) paired_geoms_.insert(pair.text(geom));
}

void MjcfReader::read_assets() {
  for (const XmlElement& asset : document_.in_sections("asset")) {
    if (!check_mjcf_child(asset, "asset") || asset.tag() != "mesh") continue;
    leave_out_unread(document_.attributes(asset, ""));
    std::string name = asset.text("name");
    if (name.empty()) name = std::filesystem::path(asset.text("file")).stem().string();
    meshes_.emplace(name, asset);
  }
}

void MjcfReader::check_references() {
  const auto check = [](const XmlElement& element, const char* attribute, const char* kind,
                        const auto& names) {
    const std::string name = element.text(attribute);
    if (!name.empty() && name != "world" && !names.contains(name))
      element.file->fail(element.place(attribute), fmt::format("there is no {} `{}`", kind, name));
  };
  std::vector<XmlElement> waiting;
  for (const char* section : {"equality", "tendon", "contact", "sensor"}) {
    for (const XmlElement& element : document_.in_sections(section))
      if (!is_mjcf_coupling(element, section)) waiting.push_back(element);
  }
  while (!waiting.empty()) {
    const XmlElement element = waiting.back();
    waiting.pop_back();
    check(element, "joint", "joint", joints_);
    for (const char* attribute : {"body", "body1", "body2"})
      check(element, attribute, "body", link_names_);
    for (const XmlElement& child : document_.children(element)) waiting.push_back(child);
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
    for (const MjcfPlaced& at : elements_of(section, {}, "")) {
      if (at.element.tag() == "body") {
        read_top_body(at);
      } else {
        leave_out_of_world(at.element);
      }
    }
  }
}

void MjcfReader::leave_out_of_world(const XmlElement& element) {
  const std::string_view tag = element.tag();
  const bool stands = tag == "geom" || tag == "site" || tag == "camera" || tag == "light";
  if (stands) {
    check_mjcf_attributes(element);
    leave_out(fmt::format("<{}> of the world", tag));
  } else if (check_mjcf_child(element, "worldbody")) {
    element.file->fail(element.place(), fmt::format("<{}> of the world is not read", tag));
  }
}

bool MjcfReader::is_free_joint(const MjcfPlaced& item) {
  if (item.element.tag() == "freejoint") return true;
  return item.element.tag() == "joint" &&
         document_.attributes(item.element, item.childclass).word("type") == "free";
}

void MjcfReader::read_top_body(const MjcfPlaced& at) {
  const std::string own = at.element.text("childclass");
  const auto items = elements_of(at.element, {}, own.empty() ? at.childclass : own);
  const bool is_free =
      std::ranges::any_of(items, [&](const MjcfPlaced& item) { return is_free_joint(item); });
  if (!is_free) return read_body(at, 0, 0, {}, 0);
  UrdfRobot& robot = scene_.robots.emplace_back();
  robot.name = at.element.text("name");
  robot.place = at.element.place();
  UrdfLink& world = robot.links.emplace_back();
  world.name = "world";
  world.place = at.element.place();
  read_body(at, scene_.robots.size() - 1, 0, {}, 0);
}

std::vector<MjcfPlaced> MjcfReader::elements_of(const XmlElement& body, const Pose& X_BF,
                                                const std::string& childclass, std::size_t depth) {
  constexpr std::size_t deepest = 100;
  std::vector<MjcfPlaced> found;
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

void MjcfReader::read_body(const MjcfPlaced& at, std::size_t robot, std::size_t parent,
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
  leave_out_unread(MjcfAttributes(element, {}));
  if (element.text("mocap") == "true") leave_out("mocap of <body>, which stands still");
  const std::string own_class = element.text("childclass");
  const std::string childclass = own_class.empty() ? at.childclass : own_class;
  const std::string written = element.text("name");
  if (!written.empty() && link_names_.contains(written))
    element.file->fail(element.place("name"), fmt::format("a second body `{}`", written));
  const std::string name = unique(
      written.empty() ? fmt::format("body_{}", link_names_.size() + 1) : written, link_names_);
  const std::vector<MjcfPlaced> items = elements_of(element, {}, childclass);

  std::vector<UrdfJoint> joints;
  std::vector<Vector3d> anchors;
  for (const MjcfPlaced& item : items) {
    if (is_free_joint(item)) {
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
    parent = of.links.size();
    of.links.push_back(std::move(link));
    if (joint.type != UrdfJointType::fixed) joints_[joint.name] = addresses_.back();
    of.joints.push_back(std::move(joint));
    if (last) read_contents(items, X_LB, is_moved(of, parent), of.links.back());
  }
  for (const MjcfPlaced& item : items) {
    if (item.element.tag() == "body") read_body(item, robot, parent, X_LB, depth + 1);
  }
}

bool MjcfReader::is_moved(const UrdfRobot& robot, std::size_t index) {
  // Each link but the first has the joint that was read with it.
  for (; index > 0; index = robot.joints[index - 1].parent)
    if (robot.joints[index - 1].type != UrdfJointType::fixed) return true;
  return false;
}

UrdfJoint MjcfReader::read_free_joint(const MjcfPlaced& at, const std::string& body) {
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

UrdfJoint MjcfReader::read_joint(const MjcfPlaced& at, const std::string& body,
                                 std::size_t number) {
  const MjcfAttributes given = document_.attributes(at.element, at.childclass);
  leave_out_unread(given);
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
  const auto spring = given.numbers("springdamper", {0., 0.});
  if (spring[0] > 0. && spring[1] > 0.) spring_dampers_[joint.name] = {spring[0], spring[1]};
  return joint;
}

void MjcfReader::read_range(const MjcfAttributes& given, UrdfJoint& joint) {
  if (const auto ends = document_.range(given, "range", "limited")) {
    const bool slides = joint.type == UrdfJointType::prismatic;
    const auto limit = [&](double end) {
      const double value = slides ? end : document_.angle(end);
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    joint.lower_limit = limit((*ends)[0]);
    joint.upper_limit = limit((*ends)[1]);
    if (!slides && (joint.lower_limit || joint.upper_limit)) joint.type = UrdfJointType::revolute;
  }
  if (const auto ends = document_.range(given, "actuatorfrcrange", "actuatorfrclimited")) {
    const double most = greater_end(*ends, "actuatorfrcrange of <joint>");
    if (!std::isfinite(most)) return;
    joint.effort_limit = most;
    joint.effort_place = given.place("actuatorfrcrange");
  }
}

double MjcfReader::greater_end(const std::array<double, 2>& ends, const std::string& what) {
  const double low = std::abs(ends[0]), high = std::abs(ends[1]);
  if (low != high) leave_out(fmt::format("smaller end of {}", what));
  return std::max(low, high);
}

void MjcfReader::read_contents(const std::vector<MjcfPlaced>& items, const Pose& X_LB,
                               bool is_moved, UrdfLink& link) {
  std::vector<dts::MassProperties<double>> masses;
  std::optional<dts::MassProperties<double>> given_mass;
  language::Position unknown;  // of a geom whose mass is not known
  link.inertial_place = link.place;
  for (const MjcfPlaced& item : items) {
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
      given_mass = dts::placed(read_inertial(MjcfAttributes(item.element, {}), document_),
                               item.X_BF.position, item.X_BF.orientation);
    } else if (tag == "site" || tag == "camera" || tag == "light") {
      leave_out(fmt::format("<{}>", tag));
    } else if (tag != "joint" && tag != "freejoint" && tag != "body" &&
               check_mjcf_child(item.element, "body")) {
      item.element.file->fail(item.element.place(), fmt::format("<{}> of a body is not read", tag));
    }
  }
  using From = MjcfCompiler::FromGeoms;
  const MjcfCompiler& compiler = document_.compiler();
  // Geoms without mass leave the <inertial> as it is.
  const bool geoms_weigh =
      unknown.file != nullptr ||
      std::ranges::any_of(masses, [](const auto& mass) { return mass.mass > 0.; });
  const bool from_geoms = compiler.inertia_from_geoms == From::always
                              ? geoms_weigh || !given_mass
                              : compiler.inertia_from_geoms == From::where_missing && !given_mass;
  const bool matters = is_moved || compiler.total_mass > 0.;
  if (from_geoms && matters && unknown.file != nullptr)
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

void MjcfReader::read_geom_at(const MjcfPlaced& at, const Pose& X_LB, UrdfLink& link,
                              std::vector<dts::MassProperties<double>>& masses,
                              language::Position& unknown) {
  const MjcfAttributes given = document_.attributes(at.element, at.childclass);
  leave_out_unread(given);
  const std::optional<MjcfGeom> geom = read_geom(given, document_);
  if (!geom) return;
  const std::string name = given.own().text("name");
  if (!name.empty() && !geom->touches && paired_geoms_.contains(name))
    leave_out(
        fmt::format("contact of geom `{}` by a <pair> (contype = \"1\" lets it touch)", name));
  if (geom->touches_others)
    leave_out("contact of a geom whose contype and conaffinity lack bit 1, that of the ground");
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
  const MeshPoints* const mesh = mesh_of(found->second, name);
  if (mesh == nullptr) return;
  const Vector3d scale = document_.attributes(found->second, "").vector("scale", {1., 1., 1.});
  add_mesh(mesh->vertices, scale, choices_.meshes, X_LG, given.own().place(), material_of(given),
           link, left_out_);
}

const MeshPoints* MjcfReader::mesh_of(const XmlElement& asset, const std::string& name) {
  const MjcfAttributes given = document_.attributes(asset, "");
  const auto fail = [&](const char* attribute, const std::string& message) {
    given.fail(attribute, message);
    return nullptr;
  };
  if (given.word("file").empty()) {
    const MeshPoints& points = files_.keep<MeshPoints>(
        fmt::format("vertices {} {}", asset.place().file->path, asset.place().offset),
        [&] { return vertices_of(asset); });
    if (points.vertices.empty() && asset.file->good())
      return fail("file", fmt::format("mesh `{}` has neither file nor vertex", name));
    return &points;
  }
  std::filesystem::path file = given.word("file");
  if (document_.compiler().strip_path) file = file.filename();
  file = std::filesystem::path(document_.compiler().mesh_folder) / file;
  const std::filesystem::path path = files_.find(file, document_.main_file().path);
  if (path.empty())
    return fail("file",
                fmt::format("there is no mesh `{}` (meshes = skip does without)", file.string()));
  const MeshPoints& mesh = files_.keep<MeshPoints>("mesh " + path.lexically_normal().string(),
                                                   [&] { return read_mesh(path); });
  if (!mesh.problem.empty())
    return fail("file", fmt::format("the mesh {} cannot be read: {}", path.string(), mesh.problem));
  return &mesh;
}

MeshPoints MjcfReader::vertices_of(const XmlElement& asset) {
  constexpr std::size_t most = 3'000'000;
  const std::vector<double> numbers = asset.file->numbers(asset.node, "vertex", most);
  if (numbers.size() % 3 != 0)
    asset.file->fail(asset.place("vertex"), "vertex takes three numbers each: \"x y z x y z ...\"");
  MeshPoints points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.vertices.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return points;
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
/// <option>. The number of rows of a contact (condim) is the larger of two geoms' unless one has
/// priority: the ground has 3 without, so that a geom's 1 counts as 3.
void MjcfReader::add_stated_contact(const MjcfAttributes& given,
                                    const std::vector<double>& friction,
                                    SurfaceMaterial& material) {
  const double rows = given.number("condim", 3.);
  if (rows != 1. && rows != 3. && rows != 4. && rows != 6.) {
    given.fail("condim", "condim is 1, 3, 4 or 6");
    return;
  }
  if (rows == 1. && given.number("priority", 0.) > 0.) material.friction = 0.;
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
  for (const pugi::xml_attribute& attribute : option.node.attributes())
    if (const std::string name = attribute.name(); name != "cone" && name != "impratio")
      leave_out(fmt::format("{} of <option>", name));
  if (option.node.first_child()) leave_out("what is in <option>");
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

std::optional<MjcfScene> read_mjcf(const language::SourceFile& file, const MjcfChoices& choices,
                                   language::FileStore& files, language::Report& report) {
  return MjcfReader(file, choices, files, report).run();
}

}  // namespace hookpoint::simulation
