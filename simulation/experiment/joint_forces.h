// What a joint exerts by itself, as a function of its position, its rate and where its dry friction
// is hooked: damper, dry friction, spring, limits; and how much of its drive's torque it gets.
#pragma once

#include <cmath>
#include <limits>

#include "math/scalar.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Constants of a joint; per rad for a revolute joint (torque in N m), per m for a prismatic one
/// (force in N).
struct JointProperties {
  double damping{0.};                ///< b
  double friction{0.};               ///< tau_f, dry friction of a joint that slips
  double static_excess{0.};          ///< tau_s - tau_f: by how much one that sticks holds more
  double stribeck_velocity{0.};      ///< v_s: over this rate friction falls from tau_s to tau_f
  double friction_deflection{1e-3};  ///< z_f: deflection of a joint that sticks before it slips
  double friction_speed{0.05};       ///< v_f: at this rate a joint that sticks is damped by tau_s
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

/// What the dry friction of a joint remembers of the last accepted state.
struct FrictionHook {
  double anchor = 0.;  ///< h: where it is hooked [rad, m]
  double rate = 0.;    ///< of the joint [rad/s, m/s]
  bool drags = false;  ///< the joint moved it
  bool slips = false;  ///< it has broken away: friction falls from tau_s
};

/// The most that dry friction gives, as a part of tau_s: all until the joint breaks away, then
/// tau_f + (tau_s - tau_f) exp(-(rate/v_s)^2), with v_s = 0 tau_f (Armstrong-Helouvry, Dupont &
/// Canudas de Wit, Automatica 30, 1994, section 2).
inline double friction_part(const JointProperties& joint, double rate, const FrictionHook& hook) {
  if (!hook.slips || joint.static_excess <= 0.) return 1.;
  double fall = 0.;
  if (joint.stribeck_velocity > 0.) {
    const double speed = rate / joint.stribeck_velocity;
    fall = std::exp(-speed * speed);
  }
  return (joint.friction + joint.static_excess * fall) / (joint.friction + joint.static_excess);
}

/// Dry friction once the joint has come to `position` with `rate`. The anchor h stays while
/// |q - h| <= z_f, beyond it is dragged along until the joint turns back; z_f shrinks with what
/// friction gives. A joint breaks away that drags the hook and speeds up, or is faster than
/// v_f. A load below tau_s that is put on at once does neither: it moves the joint with less than
/// v_f, and drags it while it slows down.
FrictionHook dragged(const JointProperties& joint, double position, double rate,
                     const FrictionHook& hook);

/// tau_s sat(z/z_f + rate/v_f), against the motion: z = q - h is clipped to [-z_f, z_f], sat to
/// [-1, 1], of a joint that slips both to `friction_part`. It takes at least the power that its
/// spring stores, whatever the rate.
inline double dry_friction(const JointProperties& joint, double position, double rate,
                           const FrictionHook& hook) {
  const double most = friction_part(joint, rate, hook);
  const auto clipped = [&](double x) { return max(-most, min(most, x)); };
  const double z = clipped((position - hook.anchor) / joint.friction_deflection);
  return (joint.friction + joint.static_excess) * clipped(z + rate / joint.friction_speed);
}

/// tau = -b rate - dry_friction - k (q - q_rest) + stop(lower) - stop(upper), where a stop pushes
/// max(0, k_l depth + c_l ddepth/dt) while the joint is beyond it (depth > 0) and never pulls.
inline double passive_joint_torque(const JointProperties& joint, double position, double rate,
                                   const FrictionHook& hook) {
  const double dry = dry_friction(joint, position, rate, hook);
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
                            const FrictionHook& hook);

}  // namespace hookpoint::simulation
