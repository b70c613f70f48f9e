// What all laws with a bristle share. A bristle is the tangential give of a contact as a continuous
// state z: the integrator moves it along with the motion, and the law gives its rate beside the
// force.
#pragma once

#include "contact/law_interface.h"

namespace hookpoint::contact {

/// A divisor: `value`, or 1 where that is not positive, for a quotient that is then not used or 0.
template <class Real>
Real positive_or_one(const Real& value) {
  return select(value > Real(0.), value, Real(1.));
}

/// Least relaxation time of a slipping bristle, which without damping or load would have none [s].
inline constexpr double shortest_relaxation = 1e-6;

/// Friction on the ground [N], the rate of the bristle [m/s], and whether it slips.
template <class Real>
struct BristleFriction {
  Vector3<Real> force, rate;
  Mask<Real> slips{};
};

/// The reaction of a point that the law reaches (`inside`), with deflection z and friction
/// `friction` (on the ground); nothing, and no memory, elsewhere. The hook is where the unbent
/// bristle would stand.
template <class Real>
Reaction<Real> bristle_reaction(const PointKinematics<Real>& point, const Mask<Real>& inside,
                                const Real& normal_force, const Vector3<Real>& z,
                                const BristleFriction<Real>& friction) {
  const Vector3<Real> zero{};
  Reaction<Real> reaction;
  reaction.force = select(inside, normal_force * point.normal - friction.force, zero);
  reaction.bristle.deflection = select(inside, z, zero);
  reaction.bristle_rate.deflection = select(inside, friction.rate, zero);
  reaction.next.hook = select(inside, point.position + point.depth * point.normal - z, zero);
  reaction.next.stretch = reaction.bristle.deflection;
  reaction.next.attached = inside;
  reaction.next.sliding = inside && friction.slips;
  return reaction;
}

/// The switching value of a bristle whose friction does not fall at break-away: v.z, which changes
/// sign where the slip of a point reverses, and 1 where it sticks. z is the bristle of the moment:
/// the stretch that was committed last may be 0 and would keep the value at 0, where no root finder
/// gets away from it.
inline double slip_reversal(const PointKinematics<double>& point, const Memory<double>& memory) {
  return memory.sliding ? dot(point.velocity, tangential(point.bristle.deflection, point.normal))
                        : 1.;
}

}  // namespace hookpoint::contact
