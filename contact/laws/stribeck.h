// Stribeck's curve: how friction falls from static to kinetic with speed, for the laws whose
// friction is a function of velocity.
#pragma once

#include <cmath>

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// mu(v) = mu_k + (mu_s - mu_k) exp(-(v/v_St)^2) at `speed` v >= 0 [m/s].
template <class Real>
Real stribeck_friction(const Real& speed, const MaterialConstants<Real>& material) {
  using std::exp;
  const Real ratio = speed / material.stribeck_speed;
  return material.kinetic_friction +
         (material.static_friction - material.kinetic_friction) * exp(-(ratio * ratio));
}

}  // namespace hookpoint::contact
