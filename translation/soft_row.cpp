#include "translation/soft_row.h"

#include <algorithm>
#include <cmath>

#include "reference/mujoco/contact_at_rest.h"
#include "translation/impact.h"

namespace hookpoint::translation {

Behaviour behaviour_of(const reference::MujocoSettings& settings, const reference::MujocoRow& row,
                       double friction, const Situation& at) {
  // A pyramid without friction has no rows.
  const double mu = std::max(friction, contact::mujoco_least_friction);
  const double inverse_weight = at.foot_inverse_weight();
  const auto at_rest = [&](double normal, double tangential) {
    reference::MujocoLoad load;
    load.inverse_weight = inverse_weight;
    load.normal = normal;
    load.tangential = tangential;
    load.along = 1.;
    load.friction = mu;
    return reference::mujoco_rest(load, settings, row, at.deltat);
  };
  Behaviour result;
  result.friction_shape = settings.friction.elliptic ? "elliptic cone" : "pyramid inside the cone";
  const auto level = at_rest(at.load, 0.);
  result.static_depth = level->depth;
  const auto rest = at_rest(normal_on_slope(at), tangential_on_slope(at));
  if (holds(mu) && !rest)
    result.add_unknown(rest.why());
  else
    result.set_creep(mu, rest ? rest->velocity.downhill : 0.);
  const auto reference = contact::mujoco_reference(row, at.deltat);
  // With B = 1/dt and one impedance at all depths it is a spring and damper: R = 1/(dt (c + dt k)).
  const double softness = contact::mujoco_normal_softness(
      inverse_weight, mu, settings.friction, contact::mujoco_impedance(row, *result.static_depth));
  const bool one_impedance = row.impedance[0] == row.impedance[1];
  if (one_impedance && std::abs(reference.damping * at.deltat - 1.) < 1e-6)
    result.damping = 1. / (softness * at.deltat) - at.deltat * at.load / *result.static_depth;
  predict_rebound(result, at, [&](double depth, double approach) {
    if (depth <= 0.) return 0.;
    const double d = contact::mujoco_impedance(row, depth);
    return (reference.damping * approach + reference.stiffness * d * depth) /
           (1. / at.mass +
            contact::mujoco_normal_softness(inverse_weight, mu, settings.friction, d));
  });
  return result;
}

SoftRow nearest_soft_row(const DesiredContact& desired, const Situation& at) {
  contact::MaterialConstants<double> material;
  material.normal_stiffness = desired.stiffness;
  material.normal_damping = desired.damping;
  SoftRow soft;
  soft.settings = reference::mujoco_settings(reference::Settings::matched, at.deltat, material);
  // R of the normal row is 1/(dt (c + dt k)), of a friction row that with the desired mixing.
  soft.settings.friction.impedance_ratio =
      1. / (desired_mixing(desired, at) * (desired.damping + at.deltat * desired.stiffness));
  soft.row = reference::mujoco_row(soft.settings, at.deltat, material, at.foot_inverse_weight());
  const double d = soft.row.impedance[0];
  soft.at_bound = d <= contact::mujoco_least_impedance || d >= 1. - contact::mujoco_least_impedance;
  return soft;
}

}  // namespace hookpoint::translation
