// SDFormat 1.7, of Gazebo: a world with the ground and its contact, and a model a robot, each link in
// the frame of the one that carries it, at the joints' initial positions 0.
#include "reference/ground.h"
#include "reference/solids.h"
#include "translation/models/writing.h"

namespace hookpoint::translation {
namespace {

using reference::TreeBody;
using simulation::Pose;

class Sdf {
 public:
  Sdf(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
      const ModelContact& contact)
      : experiment_(experiment), tree_(experiment, robots), contact_(contact) {
    world_ = element(element(document_, "sdf", {{"version", "1.7"}}), "world",
                     {{"name", experiment.world}});
    leaf(world_, "gravity", numbers(experiment.gravity));
    const pugi::xml_node physics = element(world_, "physics", {{"name", "step"}, {"type", "ode"}});
    leaf(physics, "max_step_size", numbers({experiment.deltat}));
    if (experiment.terrain) write_ground();
    for (const std::size_t robot : robots) write_robot(robot);
    for (const simulation::LoopSpec& loop : experiment.loops)
      left_out_.add("the Loop " + loop.name);
    left_out_.add("a mimic of a joint", experiment.couplings.size());
    leave_out_parts(experiment, left_out_);
  }

  Model model() const { return {text_of(document_), left_out_.list()}; }

 private:
  static void write_pose(pugi::xml_node node, const Pose& at, const std::string& relative_to = "") {
    const Vector3d rpy = roll_pitch_yaw(at.orientation);
    pugi::xml_node pose = element(node, "pose");
    if (!relative_to.empty()) pose.append_attribute("relative_to").set_value(relative_to.c_str());
    pose.text().set(
        numbers({at.position.x, at.position.y, at.position.z, rpy.x, rpy.y, rpy.z}).c_str());
  }

  void write_surface(pugi::xml_node collision, bool of_ground) {
    if (!contact_) return;
    const auto value = [&](const char* name) { return numbers(contact_->value(name).numbers); };
    const pugi::xml_node surface = element(collision, "surface");
    const pugi::xml_node contact = element(element(surface, "contact"), "ode");
    // Of two surfaces the stiffnesses are in series and the dampings add up: the ground has both.
    if (of_ground) {
      leaf(contact, "kp", value("kp"));
      leaf(contact, "kd", value("kd"));
      leaf(contact, "min_depth", value("min_depth"));
    } else {
      leaf(contact, "kd", "0");
    }
    leaf(contact, "max_vel", value("max_vel"));
    const pugi::xml_node friction = element(element(surface, "friction"), "ode");
    leaf(friction, "mu", value("mu"));
    leaf(friction, "mu2", value("mu"));
    leaf(friction, "slip1", value("slip1"));
    leaf(friction, "slip2", value("slip1"));
  }

  void write_ground() {
    const simulation::TerrainSpec& terrain = *experiment_.terrain;
    const pugi::xml_node model = element(world_, "model", {{"name", terrain.name}});
    leaf(model, "static", "true");
    const pugi::xml_node link = element(model, "link", {{"name", terrain.name}});
    const reference::Ground ground = reference::ground_of(terrain);
    if (const auto* plane = std::get_if<reference::GroundPlane>(&ground)) {
      for (const char* use : {"collision", "visual"}) {
        const pugi::xml_node node = element(link, use, {{"name", std::string("plane_") + use}});
        write_pose(node, Pose{plane->offset * plane->normal, {}});
        const pugi::xml_node shape = element(element(node, "geometry"), "plane");
        leaf(shape, "normal", numbers(plane->normal));
        leaf(shape, "size", "100 100");
        if (std::string_view(use) == "collision") write_surface(node, true);
      }
    } else if (std::holds_alternative<simulation::GroundMesh>(ground)) {
      left_out_.add("the ground's grid of heights: SDF takes it from a file");
    }
    if (!terrain.patches.empty()) left_out_.add("a Patch of another Material");
    std::size_t number = 0;
    for (const reference::Solid& solid : reference::solids_of(experiment_)) {
      simulation::ShapeSpec shape;
      shape.geometry = solid.geometry;
      shape.location = solid.pose.position;
      shape.orientation = solid.pose.orientation;
      write_shape(link, shape, "solid_" + std::to_string(++number), true, true);
    }
  }

  void write_robot(std::size_t robot) {
    const simulation::RobotSpec& spec = experiment_.robots[robot];
    const pugi::xml_node model = element(world_, "model", {{"name", spec.name}});
    const std::size_t base = tree_.base(robot);
    const TreeBody& body = tree_.body(base);
    write_pose(model, Pose{body.initial.position, body.initial.orientation});
    if (!spec.mobile) leaf(model, "static", tree_.children(base).empty() ? "true" : "false");
    if (spec.plane_normal) left_out_.add("the plane in which a base is kept");
    write_link(model, base, "");
    if (!spec.mobile && !tree_.children(base).empty()) {
      const pugi::xml_node joint =
          element(model, "joint", {{"name", "to_the_world"}, {"type", "fixed"}});
      leaf(joint, "parent", "world");
      leaf(joint, "child", tree_.name(base));
    }
    if (norm(spec.velocity) > 0. || norm(spec.angular_velocity) > 0.)
      left_out_.add("the velocity at the start");
  }

  void write_link(pugi::xml_node model, std::size_t index, const std::string& parent) {
    const TreeBody& body = tree_.body(index);
    const pugi::xml_node link = element(model, "link", {{"name", tree_.name(index)}});
    if (!parent.empty()) write_pose(link, body.X_PL0, parent);
    simulation::MassSpec mass = body.body->mass;
    // Where nothing is written, SDF has 1 kg.
    constexpr double least_mass = 1e-6, least_inertia = 1e-9;
    if (mass.mass == 0. && !parent.empty()) {
      left_out_.add("that a link has no mass: it has 1 mg");
      mass = {least_mass, {}, {least_inertia, least_inertia, least_inertia, 0., 0., 0.}};
    }
    if (mass.mass > 0.) {
      const pugi::xml_node inertial = element(link, "inertial");
      write_pose(inertial, Pose{mass.center_of_mass, {}});
      leaf(inertial, "mass", numbers({mass.mass}));
      const pugi::xml_node inertia = element(inertial, "inertia");
      const Symmetric3d& I = mass.inertia;
      for (const auto& [name, value] :
           {std::pair{"ixx", I.xx}, std::pair{"ixy", I.xy}, std::pair{"ixz", I.xz},
            std::pair{"iyy", I.yy}, std::pair{"iyz", I.yz}, std::pair{"izz", I.zz}})
        leaf(inertia, name, numbers({value}));
    }
    std::size_t number = 0;
    const auto next = [&] { return tree_.name(index) + "_" + std::to_string(++number); };
    for (const simulation::ShapeSpec& shape : body.body->shapes)
      write_shape(link, shape, next(), true, false);
    for (const simulation::ShapeSpec& shape : body.body->shapes_without_contact)
      write_shape(link, shape, next(), false, false);
    for (const ContactBall& ball : contact_balls(*body.body)) {
      if (ball.is_point) left_out_.add("a point that touches: it is a ball of 1 mm");
      simulation::ShapeSpec shape;
      shape.geometry = simulation::Sphere{ball.radius};
      shape.location = ball.center;
      write_shape(link, shape, next(), true, false);
    }
    for (const std::size_t child : tree_.children(index)) {
      write_link(model, child, tree_.name(index));
      write_joint(model, index, child);
    }
  }

  void write_joint(pugi::xml_node model, std::size_t parent, std::size_t index) {
    const TreeBody& body = tree_.body(index);
    const simulation::LinkSpec& link = *body.link;
    const pugi::xml_node joint = element(model, "joint",
                                         {{"name", tree_.name(index) + "_joint"},
                                          {"type", body.turns() ? "revolute" : "prismatic"}});
    leaf(joint, "parent", tree_.name(parent));
    leaf(joint, "child", tree_.name(index));
    const pugi::xml_node axis = element(joint, "axis");
    leaf(axis, "xyz", "0 0 1");
    const pugi::xml_node dynamics = element(axis, "dynamics");
    leaf(dynamics, "damping", numbers({link.damping}));
    leaf(dynamics, "friction", numbers({link.friction}));
    if (link.stiffness != 0.) {
      leaf(dynamics, "spring_stiffness", numbers({link.stiffness}));
      leaf(dynamics, "spring_reference", numbers({link.rest_angle}));
    }
    if (link.lower_limit || link.upper_limit || link.effort_limit || link.velocity_limit) {
      const pugi::xml_node limit = element(axis, "limit");
      const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value) leaf(limit, name, numbers({*value}));
      };
      add("lower", link.lower_limit);
      add("upper", link.upper_limit);
      add("effort", link.effort_limit);
      add("velocity", link.velocity_limit);
    }
    if (link.rotor_inertia != 0.) left_out_.add("the rotor_inertia of a joint");
    if (link.angle != 0. || link.rate != 0.) left_out_.add("the initial angle or rate of a joint");
    leave_out_joint(link, left_out_);
  }

  void write_shape(pugi::xml_node link, const simulation::ShapeSpec& shape, const std::string& name,
                   bool touches, bool of_ground) {
    if (std::holds_alternative<simulation::Legcone>(shape.geometry) ||
        std::holds_alternative<simulation::Hull>(shape.geometry)) {
      left_out_.add("a cone or hull: SDF takes it from a file");
      return;
    }
    if (shape.material != simulation::no_material)
      left_out_.add("the Material of a shape: contact is the ground's");
    for (const char* use : {"collision", "visual"}) {
      const bool collides = std::string_view(use) == "collision";
      if (collides && !touches) continue;
      const pugi::xml_node node = element(link, use, {{"name", name + "_" + use}});
      write_pose(node, Pose{shape.location, shape.orientation});
      const pugi::xml_node geometry = element(node, "geometry");
      if (const auto* box = std::get_if<simulation::Box>(&shape.geometry)) {
        leaf(element(geometry, "box"), "size", numbers(box->dimensions));
      } else if (const auto* sphere = std::get_if<simulation::Sphere>(&shape.geometry)) {
        leaf(element(geometry, "sphere"), "radius", numbers({sphere->radius}));
      } else if (const auto* cylinder = std::get_if<simulation::Cylinder>(&shape.geometry)) {
        write_round(element(geometry, "cylinder"), cylinder->radius, cylinder->length);
      } else if (const auto* capsule = std::get_if<simulation::Capsule>(&shape.geometry)) {
        write_round(element(geometry, "capsule"), capsule->radius, capsule->length);
      }
      if (collides) write_surface(node, of_ground);
    }
  }

  static void write_round(pugi::xml_node node, double radius, double length) {
    leaf(node, "radius", numbers({radius}));
    leaf(node, "length", numbers({length}));
  }

  const simulation::Experiment& experiment_;
  ModelTree tree_;
  ModelContact contact_;
  pugi::xml_document document_;
  pugi::xml_node world_;
  LeftOut left_out_;
};

Model write(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
            const ModelContact& contact) {
  return Sdf(experiment, robots, contact).model();
}

}  // namespace

const ModelFormat sdf_format{"sdf", "SDFormat, of Gazebo", "gazebo", false, write};

}  // namespace hookpoint::translation
