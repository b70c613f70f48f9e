// MJCF, of MuJoCo 2.2 and later: bodies, joints, geoms, motors, a keyframe of the initial state, the
// ground and its contact.
#include <algorithm>
#include <map>

#include "reference/ground.h"
#include "reference/mujoco/vertices.h"
#include "reference/solids.h"
#include "translation/models/writing.h"

namespace hookpoint::translation {
namespace {

using reference::TreeBody;
using simulation::Pose;

/// A joint of a link without mass, which the next body with one carries beside its own.
struct CarriedJoint {
  std::size_t body;  ///< whose joint it is
  Pose in_body;      ///< of that link's frame in the frame of the body that has the mass
};

class Mjcf {
 public:
  Mjcf(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
       const ModelContact& contact)
      : experiment_(experiment), tree_(experiment, robots), contact_(contact) {
    root_ = element(document_, "mujoco", {{"model", experiment.world}});
    write_options();
    assets_ = element(root_, "asset");
    const pugi::xml_node world = element(root_, "worldbody");
    if (experiment.terrain) write_ground(world);
    for (const std::size_t robot : robots) write_body(world, tree_.base(robot), {}, Pose{});
    equalities_ = element(root_, "equality");
    write_equalities(robots);
    const pugi::xml_node actuators = element(root_, "actuator");
    for (const std::size_t joint : joints_) write_motor(actuators, joint);
    write_keyframe();
    for (const pugi::xml_node& part : {assets_, equalities_, actuators})
      if (!part.first_child()) root_.remove_child(part);
    leave_out_parts(experiment, left_out_);
  }

  Model model() const { return {text_of(document_), left_out_.list()}; }

 private:
  void write_options() {
    // The compiler changes nothing: masses and inertias are those written.
    element(root_, "compiler",
            {{"angle", "radian"},
             {"inertiafromgeom", "false"},
             {"balanceinertia", "false"},
             {"boundmass", "0"},
             {"boundinertia", "0"},
             {"autolimits", "true"}});
    pugi::xml_node option = element(
        root_, "option",
        {{"timestep", numbers({experiment_.deltat})}, {"gravity", numbers(experiment_.gravity)}});
    if (contact_) {
      option.append_attribute("cone").set_value(contact_->word("cone").c_str());
      option.append_attribute("impratio")
          .set_value(numbers(contact_->value("impratio").numbers).c_str());
    }
    // A robot's geoms (affinity 1) meet the ground (type 1), never each other.
    element(element(root_, "default"), "geom", {{"contype", "0"}, {"conaffinity", "1"}});
  }

  /// Of the ground or what stands on it, with the ground's contact.
  pugi::xml_node ground_geom(pugi::xml_node world, const std::string& name) {
    pugi::xml_node geom =
        element(world, "geom", {{"name", name}, {"contype", "1"}, {"conaffinity", "0"}});
    if (!contact_) return geom;
    for (const char* each : {"friction", "solref", "solimp"})
      geom.append_attribute(each).set_value(numbers(contact_->value(each).numbers).c_str());
    geom.append_attribute("priority").set_value("1");
    geom.append_attribute("condim").set_value("3");
    return geom;
  }

  void write_ground(pugi::xml_node world) {
    const simulation::TerrainSpec& terrain = *experiment_.terrain;
    const reference::Ground ground = reference::ground_of(terrain);
    if (const auto* plane = std::get_if<reference::GroundPlane>(&ground)) {
      const Vector3d& n = plane->normal;
      pugi::xml_node geom = ground_geom(world, terrain.name);
      set(geom, {{"type", "plane"},
                 {"size", "0 0 1"},
                 {"pos", numbers(plane->offset * n)},
                 {"quat", numbers(normalized(Quaterniond{1. + n.z, -n.y, n.x, 0.}))}});
    } else if (std::holds_alternative<simulation::GroundMesh>(ground)) {
      left_out_.add("the ground's grid of heights: MuJoCo takes it from a file");
    }
    if (!terrain.patches.empty()) left_out_.add("a Patch of another Material");
    std::size_t number = 0;
    for (const reference::Solid& solid : reference::solids_of(experiment_)) {
      const std::string name = solid.obstacle ? experiment_.obstacles[*solid.obstacle].name
                                              : terrain.name + "_" + std::to_string(++number);
      pugi::xml_node geom = ground_geom(world, name);
      set(geom, {{"pos", numbers(solid.pose.position)}, {"quat", numbers(solid.pose.orientation)}});
      write_shape(geom, solid.geometry, name);
    }
  }

  static void set(pugi::xml_node node,
                  std::initializer_list<std::pair<const char*, std::string>> attributes) {
    for (const auto& [name, value] : attributes)
      node.append_attribute(name).set_value(value.c_str());
  }

  /// `carried`: joints of the massless links before it, whose frames are in the parent's;
  /// `X_PL`: of the frame in which X_PL0 of this body counts, in the parent's.
  void write_body(pugi::xml_node parent, std::size_t index, std::vector<CarriedJoint> carried,
                  const Pose& X_PF) {
    const TreeBody& body = tree_.body(index);
    const bool is_base = body.link == nullptr;
    const Pose at =
        is_base ? Pose{body.initial.position, body.initial.orientation} : X_PF * body.X_PL0;
    const bool massless = !is_base && body.body->mass.mass == 0.;
    const auto children = tree_.children(index);
    if (massless && children.size() == 1) {
      carried.push_back({index, at});
      write_body(parent, children.front(), std::move(carried), at);
      return;
    }
    if (massless)
      throw ParameterError(
          "a link without mass that carries none or several cannot be written as MJCF");
    pugi::xml_node node = element(parent, "body",
                                  {{"name", tree_.name(index)},
                                   {"pos", numbers(at.position)},
                                   {"quat", numbers(at.orientation)}});
    const auto inverse_of = [](const Pose& X) {
      const Quaterniond turn = conjugate(X.orientation);
      return Pose{rotate(turn, -1. * X.position), turn};
    };
    for (CarriedJoint& joint : carried) joint.in_body = inverse_of(at) * joint.in_body;
    if (is_base) {
      write_base_joint(node, index);
    } else {
      for (const CarriedJoint& joint : carried) write_joint(node, joint.body, joint.in_body);
      write_joint(node, index, Pose{});
    }
    if (body.mobile) {
      const simulation::MassSpec& mass = body.body->mass;
      const Symmetric3d& I = mass.inertia;
      element(node, "inertial",
              {{"pos", numbers(mass.center_of_mass)},
               {"mass", numbers({mass.mass})},
               {"fullinertia", numbers({I.xx, I.yy, I.zz, I.xy, I.xz, I.yz})}});
    }
    write_geoms(node, index);
    for (const std::size_t child : children) write_body(node, child, {}, Pose{});
  }

  void write_base_joint(pugi::xml_node node, std::size_t index) {
    const TreeBody& body = tree_.body(index);
    if (body.plane_normal) {
      const reference::PlaneAxes axes = reference::plane_axes(*body.plane_normal);
      const Quaterniond to_body = conjugate(body.initial.orientation);
      const std::string name = tree_.name(index);
      for (const auto& [type, axis, suffix] :
           {std::tuple{"slide", axes.first, "_first"}, std::tuple{"slide", axes.second, "_second"},
            std::tuple{"hinge", axes.normal, "_turn"}})
        element(node, "joint",
                {{"name", name + suffix},
                 {"type", type},
                 {"axis", numbers(rotate(to_body, axis))},
                 {"damping", "0"}});
      const Vector3d v = body.initial.velocity, w = body.initial.angular_velocity;
      for (const double rate : {dot(axes.first, v), dot(axes.second, v), dot(axes.normal, w)}) {
        positions_.push_back(0.);
        rates_.push_back(rate);
      }
      return;
    }
    if (!body.mobile) return;
    element(node, "freejoint", {{"name", tree_.name(index) + "_free"}});
    const Pose at{body.initial.position, body.initial.orientation};
    const Quaterniond& q = at.orientation;
    for (const double value : {at.position.x, at.position.y, at.position.z, q.w, q.x, q.y, q.z})
      positions_.push_back(value);
    const Vector3d v = body.initial.velocity;
    const Vector3d w = rotate(conjugate(q), body.initial.angular_velocity);  // in the body's axes
    for (const double value : {v.x, v.y, v.z, w.x, w.y, w.z}) rates_.push_back(value);
  }

  void write_joint(pugi::xml_node node, std::size_t index, const Pose& X_BL) {
    const TreeBody& body = tree_.body(index);
    const simulation::LinkSpec& link = *body.link;
    pugi::xml_node joint = element(node, "joint",
                                   {{"name", tree_.name(index)},
                                    {"type", body.turns() ? "hinge" : "slide"},
                                    {"pos", numbers(X_BL.position)},
                                    {"axis", numbers(rotate(X_BL.orientation, {0., 0., 1.}))}});
    const auto add = [&](const char* name, double value) {
      if (value != 0.) joint.append_attribute(name).set_value(numbers({value}).c_str());
    };
    add("damping", link.damping);
    add("frictionloss", link.friction);
    add("stiffness", link.stiffness);
    if (link.stiffness != 0.) add("springref", link.rest_angle);
    add("armature", link.rotor_inertia);
    if (link.lower_limit || link.upper_limit) {
      constexpr double far = 1e6;  // of a joint with one stop
      set(joint,
          {{"range", numbers({link.lower_limit.value_or(-far), link.upper_limit.value_or(far)})}});
    }
    leave_out_joint(link, left_out_);
    if (link.velocity_limit) left_out_.add("velocity_limit of a joint");
    joints_.push_back(index);
    positions_.push_back(link.angle);
    rates_.push_back(link.rate);
  }

  void write_geoms(pugi::xml_node node, std::size_t index) {
    const TreeBody& body = tree_.body(index);
    std::size_t number = 0;
    const auto write = [&](const simulation::ShapeSpec& shape, bool touches) {
      const std::string name = tree_.name(index) + "_" + std::to_string(++number);
      pugi::xml_node geom = element(node, "geom", {{"name", name}});
      if (!touches) set(geom, {{"conaffinity", "0"}});
      set(geom, {{"pos", numbers(shape.location)}, {"quat", numbers(shape.orientation)}});
      write_shape(geom, shape.geometry, name);
      if (shape.material != simulation::no_material)
        left_out_.add("the Material of a shape: contact is the ground's");
    };
    for (const simulation::ShapeSpec& shape : body.body->shapes) write(shape, true);
    for (const simulation::ShapeSpec& shape : body.body->shapes_without_contact)
      write(shape, false);
    for (const ContactBall& ball : contact_balls(*body.body)) {
      if (ball.is_point) left_out_.add("a point that touches: it is a ball of 1 mm");
      element(node, "geom",
              {{"name", tree_.name(index) + "_" + std::to_string(++number)},
               {"type", "sphere"},
               {"size", numbers({ball.radius})},
               {"pos", numbers(ball.center)}});
    }
  }

  void write_shape(pugi::xml_node geom, const simulation::ShapeGeometry& geometry,
                   const std::string& name) {
    const auto is = [&](const char* type, std::initializer_list<double> size) {
      set(geom, {{"type", type}, {"size", numbers(size)}});
    };
    if (const auto* box = std::get_if<simulation::Box>(&geometry)) {
      const Vector3d half = 0.5 * box->dimensions;
      is("box", {half.x, half.y, half.z});
    } else if (const auto* sphere = std::get_if<simulation::Sphere>(&geometry)) {
      is("sphere", {sphere->radius});
    } else if (const auto* cylinder = std::get_if<simulation::Cylinder>(&geometry)) {
      constexpr double thin = 1e-4;  // half the thickness of a disc [m]
      if (cylinder->length == 0.) left_out_.add("a disc without thickness: it is 0.2 mm thick");
      is("cylinder", {cylinder->radius, cylinder->length == 0. ? thin : 0.5 * cylinder->length});
    } else if (const auto* capsule = std::get_if<simulation::Capsule>(&geometry)) {
      is("capsule", {capsule->radius, 0.5 * capsule->length});
    } else {
      write_mesh(geom, reference::mujoco_vertices(geometry), name);
    }
  }

  /// The compiler takes the hull of the vertices.
  void write_mesh(pugi::xml_node geom, const std::vector<Vector3d>& vertices,
                  const std::string& name) {
    std::vector<double> flat;
    for (const Vector3d& v : vertices) flat.insert(flat.end(), {v.x, v.y, v.z});
    const auto [known, is_new] = meshes_.emplace(numbers(flat), name);
    if (is_new) element(assets_, "mesh", {{"name", name}, {"vertex", known->first}});
    set(geom, {{"type", "mesh"}, {"mesh", known->second}});
  }

  void write_equalities(std::span<const std::size_t> robots) {
    for (const simulation::CouplingSpec& coupling : experiment_.couplings)
      if (std::ranges::find(robots, static_cast<std::size_t>(coupling.robot)) != robots.end())
        element(equalities_, "joint",
                {{"joint1", tree_.name(tree_.carried(coupling.robot, coupling.follower))},
                 {"joint2", tree_.name(tree_.carried(coupling.robot, coupling.leader))},
                 {"polycoef", numbers({coupling.offset, coupling.ratio, 0., 0., 0.})}});
    for (const simulation::LoopSpec& loop : experiment_.loops)
      left_out_.add("the Loop " + loop.name);
  }

  void write_motor(pugi::xml_node actuators, std::size_t joint) {
    const simulation::LinkSpec& link = *tree_.body(joint).link;
    pugi::xml_node motor =
        element(actuators, "motor",
                {{"name", tree_.name(joint)}, {"joint", tree_.name(joint)}, {"gear", "1"}});
    if (link.effort_limit)
      set(motor, {{"ctrlrange", numbers({-*link.effort_limit, *link.effort_limit})}});
    torques_.push_back(link.torque);
  }

  void write_keyframe() {
    if (positions_.empty()) return;
    pugi::xml_node key =
        element(element(root_, "keyframe"), "key",
                {{"name", "home"}, {"qpos", numbers(positions_)}, {"qvel", numbers(rates_)}});
    if (!torques_.empty()) set(key, {{"ctrl", numbers(torques_)}});
  }

  const simulation::Experiment& experiment_;
  ModelTree tree_;
  ModelContact contact_;
  pugi::xml_document document_;
  pugi::xml_node root_, assets_, equalities_;
  std::vector<std::size_t> joints_;                  ///< bodies whose joints are written, in order
  std::vector<double> positions_, rates_, torques_;  ///< of the keyframe
  std::map<std::string, std::string> meshes_;        ///< by their vertices
  LeftOut left_out_;
};

Model write(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
            const ModelContact& contact) {
  return Mjcf(experiment, robots, contact).model();
}

}  // namespace

const ModelFormat mjcf_format{"mjcf", "MJCF, of MuJoCo", "mujoco", false, write};

}  // namespace hookpoint::translation
