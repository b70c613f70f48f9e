// Springs and dampers by which a robot holds its pose. The joint whose outer bodies reach l [m]
// carries at most the weight M g at their end, a moment M g l. With
//   k = M g l/sag     c = 2 sqrt(k I)
// it deflects by no more than `sag` at rest, and its outer bodies, of moment of inertia I about
// its axis with the rotor's, come to rest without overshoot while they swing free. A stop as firm
// as any joint's would ask for steps of microseconds of a finger: it is 10 k at most, and as well
// damped; so is dry friction while it sticks, by its friction_speed.
#include <algorithm>
#include <cmath>

#include "dts/mass_properties.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

constexpr double standard_gravity = 9.80665;  // [m/s^2]

class UrdfHolding {
 public:
  UrdfHolding(const UrdfTree& tree, bool mobile, double sag)
      : mass_(tree.base.mass.mass), mobile_(mobile), sag_(sag) {
    for (const UrdfChain& chain : tree.chains) add(chain, {}, nullptr);
  }

  std::map<const UrdfJoint*, UrdfHold> run() const {
    std::map<const UrdfJoint*, UrdfHold> holds;
    for (const auto& [joint, beyond] : joints_) holds.emplace(joint, hold(*joint, beyond));
    return holds;
  }

 private:
  /// What is beyond a joint, all joints at 0.
  struct Beyond {
    double reach = 0., mass = 0.;
    double inertia = 0.;  ///< about the joint's axis
    double lowest = 0.;   ///< z in the base's axes
  };
  /// A body on the way to the base.
  struct Way {
    const UrdfBody& body;
    const Way* before;
  };

  /// `X_BP`: of what carries the chain, in the base.
  void add(const UrdfChain& chain, Pose X_BP, const Way* before) {
    add_from(chain, 0, X_BP, before);
  }
  void add_from(const UrdfChain& chain, std::size_t link, const Pose& X_BP, const Way* before) {
    if (link == chain.bodies.size()) {
      for (const UrdfChain& carried : chain.carried) add(carried, X_BP, before);
      return;
    }
    const UrdfBody& body = chain.bodies[link];
    const Pose X_BL = X_BP * body.joint_pose;
    const Way way{body, before};
    double lowest = X_BL.position.z;
    for (const UrdfShape& shape : body.shapes)
      lowest =
          std::min(lowest, (X_BL * Pose{shape.spec.location, shape.spec.orientation}).position.z);
    for (const UrdfPoint& point : body.points)
      lowest = std::min(lowest, (X_BL * Pose{point.position, {}}).position.z);
    lowest_ = std::min(lowest_, lowest);
    mass_ += body.mass.mass;
    Pose X_JL;  // in the frame of each joint that carries it
    for (const Way* at = &way; at != nullptr; at = at->before) {
      Beyond& beyond = joints_[at->body.joint];
      add(body, X_JL, beyond);
      beyond.lowest = std::min(beyond.lowest, lowest);
      X_JL = at->body.joint_pose * X_JL;
    }
    add_from(chain, link + 1, X_BL, &way);
  }

  static void add(const UrdfBody& body, const Pose& X_JL, Beyond& beyond) {
    const MassSpec& mass = body.mass;
    const dts::MassProperties<double> in_joint = dts::placed(
        {mass.mass, mass.center_of_mass, mass.inertia}, X_JL.position, X_JL.orientation);
    const Vector3d& c = in_joint.center_of_mass;
    beyond.mass += mass.mass;
    beyond.inertia += in_joint.inertia.zz + mass.mass * (c.x * c.x + c.y * c.y);
    beyond.reach = std::max({beyond.reach, norm(c), norm(X_JL.position)});
    for (const UrdfShape& shape : body.shapes) {
      const Pose X_JS = X_JL * Pose{shape.spec.location, shape.spec.orientation};
      beyond.reach = std::max(beyond.reach, norm(X_JS.position));
    }
    for (const UrdfPoint& point : body.points)
      beyond.reach = std::max(beyond.reach, norm((X_JL * Pose{point.position, {}}).position));
  }

  UrdfHold hold(const UrdfJoint& joint, const Beyond& beyond) const {
    const bool slides = joint.type == UrdfJointType::prismatic;
    const bool is_leg = mobile_ && beyond.lowest < 0. && beyond.lowest <= 0.5 * lowest_;
    const double weight = standard_gravity * (is_leg ? mass_ : beyond.mass);
    // A joint that slides deflects by as much as the end of one that turns, and by some.
    const double stiffness =
        slides ? weight / (sag_ * std::max(beyond.reach, 0.01)) : weight * beyond.reach / sag_;
    const double moved = (slides ? beyond.mass : beyond.inertia) + joint.rotor_inertia;
    const auto damper = [&](double spring) { return 2. * std::sqrt(spring * moved); };
    const JointDefaults& usual =
        joint_type(slides ? JointKind::prismatic : JointKind::revolute).defaults;
    const double stop = std::min(usual.limit_stiffness, 10. * stiffness);
    UrdfHold held{stiffness, damper(stiffness), stop, std::min(usual.limit_damping, damper(stop)),
                  usual.friction_speed};
    if (joint.friction > 0.)
      held.friction_speed = std::max(
          held.friction_speed, joint.friction / damper(joint.friction / usual.friction_deflection));
    return held;
  }

  std::map<const UrdfJoint*, Beyond> joints_;
  double mass_;         ///< of the robot
  double lowest_ = 0.;  ///< z of any body or shape
  bool mobile_;
  double sag_;
};

}  // namespace

std::map<const UrdfJoint*, UrdfHold> hold_joints(const UrdfTree& tree, bool mobile, double sag) {
  return UrdfHolding(tree, mobile, sag).run();
}

}  // namespace hookpoint::simulation
