// What a joint exerts by itself, as a function of its position and rate: damper, dry friction,
// spring, limits.
#pragma once

#include <limits>

#include "math/scalar.h"

namespace hookpoint::dts {

/// Constants of a joint; per rad for a revolute joint (torque in N m), per m for a prismatic one
/// (force in N).
template <class Real>
struct JointProperties {
  Real damping{0.};   ///< b
  Real friction{0.};  ///< tau_f, dry friction
  Real friction_speed{
      0.05};  ///< v_f: below this rate dry friction is viscous, tau_f rate / v_f (regularised)
  Real stiffness{0.}, rest_position{0.};
  Real lower_limit{-std::numeric_limits<double>::infinity()};
  Real upper_limit{std::numeric_limits<double>::infinity()};
  Real limit_stiffness{1000.};  ///< k_l of the stop
  Real limit_damping{1.};       ///< c_l of the stop
};

/// tau = -b rate - tau_f sat(rate / v_f) - k (q - q_rest) + stop(lower) - stop(upper), where sat
/// clips to [-1, 1] and a stop pushes max(0, k_l depth + c_l ddepth/dt) while the joint is beyond
/// it (depth > 0) and never pulls.
template <class Real>
Real passive_joint_torque(const JointProperties<Real>& joint, const Real& position,
                          const Real& rate) {
  const Real dry = joint.friction * max(Real(-1.), min(Real(1.), rate / joint.friction_speed));
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
