// URDF: one robot, its links and joints at joint positions 0. Contact, springs and the initial state
// are not part of it.
#include "translation/models/writing.h"

namespace hookpoint::translation {
namespace {

using reference::TreeBody;
using simulation::Pose;

class Urdf {
 public:
  Urdf(const simulation::Experiment& experiment, std::size_t robot)
      : experiment_(experiment), tree_(experiment, std::span(&robot, 1)), robot_(robot) {
    const simulation::RobotSpec& spec = experiment.robots[robot];
    root_ = element(document_, "robot", {{"name", spec.name}});
    const std::size_t base = tree_.base(robot);
    if (!spec.mobile) {
      element(root_, "link", {{"name", "world"}});
      const pugi::xml_node joint =
          element(root_, "joint", {{"name", "world_joint"}, {"type", "fixed"}});
      write_origin(joint,
                   Pose{tree_.body(base).initial.position, tree_.body(base).initial.orientation});
      element(joint, "parent", {{"link", "world"}});
      element(joint, "child", {{"link", tree_.name(base)}});
    }
    if (spec.plane_normal) left_out_.add("the plane in which the base is kept");
    write_link(base);
    for (const simulation::LoopSpec& loop : experiment.loops)
      if (loop.robot == static_cast<int>(robot)) left_out_.add("the Loop " + loop.name);
    leave_out_parts(experiment, left_out_);
    left_out_.add("where the robot starts and how its joints stand: arguments of an Include");
    left_out_.add("ground and contact");
  }

  Model model() const { return {text_of(document_), left_out_.list()}; }

 private:
  static void write_origin(pugi::xml_node node, const Pose& at) {
    element(node, "origin",
            {{"xyz", numbers(at.position)}, {"rpy", numbers(roll_pitch_yaw(at.orientation))}});
  }

  void write_link(std::size_t index) {
    const TreeBody& body = tree_.body(index);
    const pugi::xml_node link = element(root_, "link", {{"name", tree_.name(index)}});
    const simulation::MassSpec& mass = body.body->mass;
    if (mass.mass > 0.) {
      const pugi::xml_node inertial = element(link, "inertial");
      write_origin(inertial, Pose{mass.center_of_mass, {}});
      element(inertial, "mass", {{"value", numbers({mass.mass})}});
      const Symmetric3d& I = mass.inertia;
      element(inertial, "inertia",
              {{"ixx", numbers({I.xx})},
               {"ixy", numbers({I.xy})},
               {"ixz", numbers({I.xz})},
               {"iyy", numbers({I.yy})},
               {"iyz", numbers({I.yz})},
               {"izz", numbers({I.zz})}});
    }
    for (const simulation::ShapeSpec& shape : body.body->shapes)
      write_shape(link, shape, {"collision", "visual"});
    for (const simulation::ShapeSpec& shape : body.body->shapes_without_contact)
      write_shape(link, shape, {"visual"});
    for (const ContactBall& ball : contact_balls(*body.body)) {
      if (ball.is_point) left_out_.add("a point that touches: it is a ball of 1 mm");
      simulation::ShapeSpec shape;
      shape.geometry = simulation::Sphere{ball.radius};
      shape.location = ball.center;
      write_shape(link, shape, {"collision", "visual"});
    }
    for (const std::size_t child : tree_.children(index)) {
      write_joint(index, child);
      write_link(child);
    }
  }

  void write_shape(pugi::xml_node link, const simulation::ShapeSpec& shape,
                   std::initializer_list<const char*> uses) {
    if (std::holds_alternative<simulation::Legcone>(shape.geometry) ||
        std::holds_alternative<simulation::Hull>(shape.geometry)) {
      left_out_.add("a cone or hull: URDF takes it from a file");
      return;
    }
    for (const char* use : uses) {
      const pugi::xml_node node = element(link, use);
      write_origin(node, Pose{shape.location, shape.orientation});
      const pugi::xml_node geometry = element(node, "geometry");
      if (const auto* box = std::get_if<simulation::Box>(&shape.geometry))
        element(geometry, "box", {{"size", numbers(box->dimensions)}});
      else if (const auto* sphere = std::get_if<simulation::Sphere>(&shape.geometry))
        element(geometry, "sphere", {{"radius", numbers({sphere->radius})}});
      else if (const auto* cylinder = std::get_if<simulation::Cylinder>(&shape.geometry))
        element(geometry, "cylinder",
                {{"radius", numbers({cylinder->radius})}, {"length", numbers({cylinder->length})}});
      else if (const auto* capsule = std::get_if<simulation::Capsule>(&shape.geometry))
        element(geometry, "capsule",
                {{"radius", numbers({capsule->radius})}, {"length", numbers({capsule->length})}});
    }
  }

  void write_joint(std::size_t parent, std::size_t index) {
    const TreeBody& body = tree_.body(index);
    const simulation::LinkSpec& link = *body.link;
    const bool has_stops = link.lower_limit || link.upper_limit;
    const char* type = !body.turns() ? "prismatic" : has_stops ? "revolute" : "continuous";
    const std::string name = tree_.name(index) + "_joint";
    const pugi::xml_node joint = element(root_, "joint", {{"name", name}, {"type", type}});
    write_origin(joint, body.X_PL0);
    element(joint, "parent", {{"link", tree_.name(parent)}});
    element(joint, "child", {{"link", tree_.name(index)}});
    element(joint, "axis", {{"xyz", "0 0 1"}});
    element(joint, "dynamics",
            {{"damping", numbers({link.damping})}, {"friction", numbers({link.friction})}});
    write_limit(joint, link, std::string_view(type) != "continuous");
    if (link.stiffness != 0.) left_out_.add("the spring of a joint");
    leave_out_joint(link, left_out_);
    for (const simulation::CouplingSpec& coupling : experiment_.couplings)
      if (coupling.robot == static_cast<int>(robot_) &&
          tree_.carried(coupling.robot, coupling.follower) == index)
        element(joint, "mimic",
                {{"joint", tree_.name(tree_.carried(coupling.robot, coupling.leader)) + "_joint"},
                 {"multiplier", numbers({coupling.ratio})},
                 {"offset", numbers({coupling.offset})}});
    if (link.rotor_inertia != 0.) write_transmission(name, link.rotor_inertia);
  }

  /// A file without <limit> of a joint with stops, or without one of its numbers, is refused by ROS, and
  /// a stop that is not written is 0 there: what has no limit gets one that bounds nothing.
  static void write_limit(pugi::xml_node joint, const simulation::LinkSpec& link, bool has_stops) {
    if (!has_stops && !link.effort_limit && !link.velocity_limit) return;
    constexpr double endless = 1e16;  // as SDFormat has it
    pugi::xml_node limit = element(joint, "limit");
    const auto add = [&](const char* attribute, double value) {
      limit.append_attribute(attribute).set_value(numbers({value}).c_str());
    };
    if (has_stops) {
      add("lower", link.lower_limit.value_or(-endless));
      add("upper", link.upper_limit.value_or(endless));
    }
    add("effort", link.effort_limit.value_or(endless));
    add("velocity", link.velocity_limit.value_or(endless));
  }

  void write_transmission(const std::string& joint, double rotor_inertia) {
    const pugi::xml_node transmission =
        element(root_, "transmission", {{"name", joint + "_transmission"}});
    leaf(transmission, "type", "transmission_interface/SimpleTransmission");
    leaf(element(transmission, "joint", {{"name", joint}}), "hardwareInterface",
         "EffortJointInterface");
    const pugi::xml_node actuator = element(transmission, "actuator", {{"name", joint + "_motor"}});
    leaf(actuator, "motorInertia", numbers({rotor_inertia}));
    leaf(actuator, "mechanicalReduction", "1");
  }

  const simulation::Experiment& experiment_;
  ModelTree tree_;
  std::size_t robot_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  LeftOut left_out_;
};

Model write(const simulation::Experiment& experiment, std::span<const std::size_t> robots,
            const ModelContact& /*contact*/) {
  return Urdf(experiment, robots.front()).model();
}

}  // namespace

const ModelFormat urdf_format{"urdf", "URDF", "", true, write};

}  // namespace hookpoint::translation
