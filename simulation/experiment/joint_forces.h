// What a joint exerts by itself, as a function of its position, its rate and where its dry friction
// is hooked: damper, dry friction, spring, limits; and how much of its drive's torque it gets.
#pragma once

#include <limits>

#include "math/scalar.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Constants of a joint; per rad for a revolute joint (torque in N m), per m for a prismatic one
/// (force in N).
struct JointProperties {
  double damping{0.};                ///< b
  double friction{0.};               ///< tau_f, dry friction
  double friction_deflection{1e-3};  ///< z_f: deflection of a joint that sticks before it slips
  double friction_speed{0.05};       ///< v_f: at this rate a joint that sticks is damped by tau_f
  double stiffness{0.}, rest_position{0.};
  double lower_limit{-std::numeric_limits<double>::infinity()};
  double upper_limit{std::numeric_limits<double>::infinity()};
  double limit_stiffness{1000.};                                 ///< k_l of the stop
  double limit_damping{1.};                                      ///< c_l of the stop
  double effort_limit{std::numeric_limits<double>::infinity()};  ///< tau_max of the drive
};

/// Springs, dampers, dry friction and stops of the link's joint.
JointProperties joint_properties(const LinkSpec& link);

/// What a drive that is commanded `torque` gives: at most tau_max, either way.
inline double drive_torque(const JointProperties& joint, double torque) {
  const double most = joint.effort_limit;
  return select(torque > most, most, select(torque < -most, -most, torque));
}

/// Where dry friction is hooked once the joint has come to `position`: the anchor h stays while
/// |q - h| <= z_f, beyond it is dragged along.
inline double dragged_anchor(const JointProperties& joint, double position, double anchor) {
  const double z = position - anchor;
  const double most = joint.friction_deflection;
  return select(z > most, position - most, select(z < -most, position + most, anchor));
}

/// tau_f sat(z/z_f + rate/v_f), against the motion: z = q - h is clipped to [-z_f, z_f], sat to
/// [-1, 1]. It takes at least the power that its spring stores, whatever the rate.
inline double dry_friction(const JointProperties& joint, double position, double rate,
                           double anchor) {
  const auto clipped = [](double x) { return max(-1., min(1., x)); };
  const double z = clipped((position - anchor) / joint.friction_deflection);
  return joint.friction * clipped(z + rate / joint.friction_speed);
}

/// tau = -b rate - dry_friction - k (q - q_rest) + stop(lower) - stop(upper), where a stop pushes
/// max(0, k_l depth + c_l ddepth/dt) while the joint is beyond it (depth > 0) and never pulls.
inline double passive_joint_torque(const JointProperties& joint, double position, double rate,
                                   double anchor) {
  const double dry = dry_friction(joint, position, rate, anchor);
  const double spring = joint.stiffness * (position - joint.rest_position);
  const auto stop = [&](double depth, double depth_rate) {
    const double push = max(0., joint.limit_stiffness * depth + joint.limit_damping * depth_rate);
    return select(depth > 0., push, 0.);
  };
  return stop(joint.lower_limit - position, -rate) - stop(position - joint.upper_limit, rate) -
         joint.damping * rate - dry - spring;
}

/// A spring and a damper in a joint [N m/rad, N m s/rad; N/m, N s/m].
struct JointSpring {
  double stiffness = 0., damping = 0.;
};

/// -d(passive_joint_torque)/d(position), /d(rate) of a joint that rests, its friction sticking.
JointSpring resting_spring(const JointProperties& joint, double position);

/// The same of a joint that moves, without its friction.
JointSpring moving_spring(const JointProperties& joint, double position);

/// What dry_friction is about a state to a method that is implicit in it: the derivatives, but of
/// friction that slips the damper friction/rate, which stops a joint and does not turn it back.
JointSpring friction_spring(const JointProperties& joint, double position, double rate,
                            double anchor);

}  // namespace hookpoint::simulation
