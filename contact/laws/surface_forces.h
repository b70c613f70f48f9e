// What a Material does at a contact beside its law, whatever the law: adhesion, resistance to rolling
// and spinning, and friction that differs along and across the foot (docs/contact.md).
#pragma once

#include <algorithm>
#include <array>

#include "contact/laws/rolling_resistance.h"
#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// The constants that act here, under every force law.
inline constexpr std::array<double MaterialConstants<double>::*, 4> surface_constants{
    &MaterialConstants<double>::rolling_resistance, &MaterialConstants<double>::spinning_resistance,
    &MaterialConstants<double>::adhesion, &MaterialConstants<double>::friction_across};

/// Whether any of them does something.
inline bool acts_beside_the_law(const MaterialConstants<double>& material) {
  return std::ranges::any_of(surface_constants,
                             [&](auto constant) { return material.*constant > 0.; });
}

/// The foot at a contact, world axes.
struct FootMotion {
  Vector3d x_axis;     ///< of its body, unit
  Vector3d spin;       ///< angular velocity over the ground [rad/s]
  double radius = 0.;  ///< of a ball or a round side; 0 of none [m]
};

struct SurfaceForces {
  Vector3d force;   ///< on the foot, where the law's acts [N]
  Vector3d moment;  ///< on the foot [N m]
};

/// What acts on the foot while the contact lasts. `law_force` is the law's: its load is what the
/// surfaces press with, net of nothing, so that friction counts with the net load and the adhesion.
inline SurfaceForces surface_forces(const Vector3d& law_force, const Vector3d& normal,
                                    const FootMotion& foot,
                                    const MaterialConstants<double>& material) {
  SurfaceForces forces{-material.adhesion * normal, {}};
  const double load = std::max(0., dot(law_force, normal));
  if (foot.radius > 0.)
    forces.moment = resisting_moment(foot.spin, normal, load, foot.radius, material);
  return forces;
}

/// Coordinates of the tangent plane in which the elliptic limit of friction is a circle. What moves is
/// scaled into them, the force out of them by the same factors, so that the power is the same: what
/// slips gives up the most energy that the ellipse allows.
class FrictionAxes {
 public:
  /// Without an x axis along the plane friction is that of the larger coefficient in all directions.
  FrictionAxes(const Vector3d& x_axis, const Vector3d& normal,
               const MaterialConstants<double>& material)
      : material_(material) {
    const double ratio = material.friction_across > 0. && material.kinetic_friction > 0.
                             ? material.friction_across / material.kinetic_friction
                             : 1.;
    const double larger = std::max(1., ratio);
    material_.static_friction *= larger;
    material_.kinetic_friction *= larger;
    const Vector3d along = x_axis - dot(x_axis, normal) * normal;
    const double length = norm(along);
    constexpr double upright = 1e-6;
    if (length < upright || ratio == 1.) return;
    axis_ = (1. / length) * along;
    if (ratio < 1.) axis_ = cross(normal, axis_);
    factor_ = std::min(ratio, 1. / ratio);
  }

  /// With which the law is to be evaluated in these coordinates.
  const MaterialConstants<double>& material() const { return material_; }
  Vector3d to_round(const Vector3d& v) const { return v + (factor_ - 1.) * dot(axis_, v) * axis_; }
  Vector3d from_round(const Vector3d& v) const {
    return v + (1. / factor_ - 1.) * dot(axis_, v) * axis_;
  }

 private:
  MaterialConstants<double> material_;
  Vector3d axis_;       ///< of the smaller coefficient
  double factor_ = 1.;  ///< smaller coefficient over larger
};

inline bool differs_with_direction(const MaterialConstants<double>& material) {
  return material.friction_across > 0. && material.friction_across != material.kinetic_friction;
}

/// The reaction under friction that differs with direction. `evaluate(kinematics, memory, material)`
/// is the law's.
template <class Evaluate>
Reaction<double> directed_reaction(PointKinematics<double> point, Memory<double> memory,
                                   const FrictionAxes& axes, Evaluate&& evaluate) {
  const Vector3d position = point.position;
  point.velocity = axes.to_round(point.velocity);
  point.bristle.deflection = axes.to_round(point.bristle.deflection);
  memory.hook = position + axes.to_round(memory.hook - position);
  memory.stretch = axes.to_round(memory.stretch);
  Reaction<double> reaction = evaluate(point, memory, axes.material());
  reaction.force = axes.to_round(reaction.force);
  reaction.next.hook = position + axes.from_round(reaction.next.hook - position);
  reaction.next.stretch = axes.from_round(reaction.next.stretch);
  reaction.bristle.deflection = axes.from_round(reaction.bristle.deflection);
  reaction.bristle_rate.deflection = axes.from_round(reaction.bristle_rate.deflection);
  return reaction;
}

/// Energy of a contact: what the law stores, and what adhesion gives up to `depth` [J].
template <class StoredEnergy>
double surface_energy(double depth, const Vector3d& stretch, const FootMotion& foot,
                      const Vector3d& normal, const MaterialConstants<double>& material,
                      StoredEnergy&& stored) {
  if (!differs_with_direction(material))
    return stored(depth, stretch, material) - material.adhesion * depth;
  const FrictionAxes axes(foot.x_axis, normal, material);
  return stored(depth, axes.to_round(stretch), axes.material()) - material.adhesion * depth;
}

}  // namespace hookpoint::contact
