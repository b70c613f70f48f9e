#include "contact/laws/nominal.h"

namespace hookpoint::contact {

double Nominal::static_depth(double load, const MaterialConstants<double>& material) {
  const double k1 = material.nominal_stiffness, k2 = material.normal_stiffness;
  const double d0 = material.nominal_penetration, w = material.blend_width;
  if (load <= k1 * d0) return load / k1;
  const double excess = load - k1 * d0;
  if (excess >= 0.5 * (k1 + k2) * w) return (load + (k2 - k1) * (d0 + 0.5 * w)) / k2;
  // k1 b + (k2 - k1) b^2/(2 w) = excess, written without cancellation for k2 near k1.
  return d0 + 2. * excess / (k1 + std::sqrt(k1 * k1 + 2. * (k2 - k1) * excess / w));
}

double Nominal::restitution(double mass, double speed, const MaterialConstants<double>& material) {
  const double d0 = material.nominal_penetration;
  if (material.normal_damping == 0.) return 1.;
  const double within_nominal = 0.5 * material.nominal_stiffness * d0 * d0;
  MaterialConstants<double> line = material;
  line.normal_stiffness = material.nominal_stiffness;
  if (0.5 * mass * speed * speed <= within_nominal ||
      material.nominal_stiffness == material.normal_stiffness)
    return SpringDamperPredictions::restitution(mass, speed, line);
  const auto force = [&](double depth, double depth_rate) {
    if (depth < 0.) return 0.;
    return max(0., spring_force(depth, material) + material.normal_damping * depth_rate);
  };
  return integrated_restitution(
      force, [&](double depth) { return stored_energy(depth, {}, material); }, mass, speed);
}

LinearContact Nominal::linearise(double load, const MaterialConstants<double>& material) {
  const double beyond = static_depth(load, material) - material.nominal_penetration;
  const double k1 = material.nominal_stiffness, k2 = material.normal_stiffness;
  const double w = material.blend_width;
  const double past_blend = k2 - k1;
  double slope = k1;
  if (beyond > 0.) slope += beyond < w ? past_blend * beyond / w : past_blend;
  // At the kink itself either slope may act: the greater one bounds the step.
  if (w == 0. && std::abs(beyond) <= 1e-9 * material.nominal_penetration) slope = max(k1, k2);
  return {slope, material.normal_damping, material.tangential_stiffness,
          material.tangential_damping};
}

double Nominal::stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material) {
  const double inside = max(0., depth);
  const double beyond = max(0., inside - material.nominal_penetration);
  const double blended = min(beyond, material.blend_width);
  const double linear = beyond - blended;
  // Of (d - d0)^2/(2 w) over the blend, and of w/2 + (d - d0 - w) past it.
  const double excess = blended * blended * blended / (6. * blend_divisor(material)) +
                        0.5 * linear * (material.blend_width + linear);
  return 0.5 * material.nominal_stiffness * inside * inside +
         (material.normal_stiffness - material.nominal_stiffness) * excess +
         0.5 * material.tangential_stiffness * dot(stretch, stretch);
}

}  // namespace hookpoint::contact
