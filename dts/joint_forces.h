// What a joint exerts by itself, as a function of its position, its rate and where its dry friction
// is hooked: damper, dry friction, spring, limits; and how much of its drive's torque it gets.
#pragma once

#include <limits>

#include "math/scalar.h"

namespace hookpoint::dts {

/// Constants of a joint; per rad for a revolute joint (torque in N m), per m for a prismatic one
/// (force in N).
template <class Real>
struct JointProperties {
  Real damping{0.};                ///< b
  Real friction{0.};               ///< tau_f, dry friction
  Real friction_deflection{1e-3};  ///< z_f: so far a joint that sticks gives way before it slips
  Real friction_speed{0.05};       ///< v_f: at this rate a joint that sticks is damped by tau_f
  Real stiffness{0.}, rest_position{0.};
  Real lower_limit{-std::numeric_limits<double>::infinity()};
  Real upper_limit{std::numeric_limits<double>::infinity()};
  Real limit_stiffness{1000.};                                 ///< k_l of the stop
  Real limit_damping{1.};                                      ///< c_l of the stop
  Real effort_limit{std::numeric_limits<double>::infinity()};  ///< tau_max of the drive
};

/// What a drive that is asked for `torque` gives: at most tau_max, either way.
template <class Real>
Real drive_torque(const JointProperties<Real>& joint, const Real& torque) {
  const Real& most = joint.effort_limit;
  return select(torque > most, most, select(torque < -most, -most, torque));
}

/// Where dry friction is hooked once the joint has come to `position`: the anchor h stays while
/// |q - h| <= z_f, beyond it is dragged along.
template <class Real>
Real dragged_anchor(const JointProperties<Real>& joint, const Real& position, const Real& anchor) {
  const Real z = position - anchor;
  const Real& most = joint.friction_deflection;
  return select(z > most, position - most, select(z < -most, position + most, anchor));
}

/// tau = -b rate - tau_f sat(z/z_f + rate/v_f) - k (q - q_rest) + stop(lower) - stop(upper), where
/// z = q - h is clipped to [-z_f, z_f], sat to [-1, 1], and a stop pushes max(0, k_l depth + c_l
/// ddepth/dt) while the joint is beyond it (depth > 0) and never pulls. Friction takes at least the
/// power that its spring stores, whatever the rate.
template <class Real>
Real passive_joint_torque(const JointProperties<Real>& joint, const Real& position,
                          const Real& rate, const Real& anchor) {
  const auto clipped = [](const Real& x) { return max(Real(-1.), min(Real(1.), x)); };
  const Real z = clipped((position - anchor) / joint.friction_deflection);
  const Real dry = joint.friction * clipped(z + rate / joint.friction_speed);
  const Real spring = joint.stiffness * (position - joint.rest_position);
  const auto stop = [&](const Real& depth, const Real& depth_rate) {
    const Real push =
        max(Real(0.), joint.limit_stiffness * depth + joint.limit_damping * depth_rate);
    return select(depth > Real(0.), push, Real(0.));
  };
  return stop(joint.lower_limit - position, -rate) - stop(position - joint.upper_limit, rate) -
         joint.damping * rate - dry - spring;
}

}  // namespace hookpoint::dts
