// Resistance to rolling and spinning: not a law of its own, but a moment beside the force of any law,
// on balls and round sides. A rolling ball of radius r on the level decelerates by (5/7) g b/r.
#pragma once

#include <cmath>

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// Moment on the foot [N m]: of at most b N against rolling and s N against spin about the normal,
/// with b `rolling_resistance`, s `spinning_resistance` and N `load` [N]. `spin`: angular velocity of
/// the foot over the ground [rad/s]; `radius` > 0, of the foot [m]. Regularised as Coulomb friction
/// is: below regularisation_speed/radius it falls to 0 with the rate, so that what rolls comes to
/// rest, and what is pushed all the time creeps at less than that.
template <class Real>
Vector3<Real> resisting_moment(const Vector3<Real>& spin, const Vector3<Real>& normal,
                               const Real& load, const Real& radius,
                               const MaterialConstants<Real>& material) {
  using std::sqrt;
  const Real slow = material.regularisation_speed / radius;
  const Real about_normal = dot(spin, normal);
  const Vector3<Real> rolling = spin - about_normal * normal;
  const Real against_rolling =
      material.rolling_resistance * load / sqrt(slow * slow + dot(rolling, rolling));
  const Real against_spin =
      material.spinning_resistance * load / sqrt(slow * slow + about_normal * about_normal);
  return -(against_rolling * rolling) - (against_spin * about_normal) * normal;
}

}  // namespace hookpoint::contact
