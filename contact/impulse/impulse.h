// The law `impulse`: every contact, also a resting one, is a train of collisions (Mirtich 1996). A
// collision that is too weak to lift the point at the rebound speed u0 is given the energy to do
// so: that keeps a resting body bouncing, and creeping.
#pragma once

#include "contact/impulse/collision.h"
#include "contact/law_interface.h"

namespace hookpoint::contact {

/// The impulse laws: collisions one by one, or microcollisions of all near points together
/// (impulse_reversal.h).
enum class ImpulseLaw { impulse, impulse_reversal };

/// What the law `impulse` says of itself.
struct Impulse {
  static constexpr ImpulseLaw law = ImpulseLaw::impulse;
  static constexpr const char* name = "impulse";
  static constexpr const char* source = "Mirtich 1996";
  static constexpr const char* summary =
      "event-driven microcollisions with restitution, no penetration: creeps";
  static constexpr ConstantList constants{&Constants::kinetic_friction, &Constants::restitution,
                                          &Constants::rebound_speed};
  static constexpr ConstantList own_constants{&Constants::restitution, &Constants::rebound_speed};

  /// Steady speed of a single point on a slope within the friction cone: impacts come every
  /// 2 u0/(g cos theta), between them friction is absent, so that the mean is half of what g sin
  /// theta gains in that time, u0 tan(theta) [m/s]. None for a body with several points.
  static std::optional<double> creep_speed(double tangent_of_slope, bool single_point,
                                           const Constants& material) {
    return single_point ? std::optional(material.rebound_speed * tangent_of_slope) : std::nullopt;
  }
  /// Impacts a second of a single point that rests, g_n/(2 u0) [1/s]; `gravity` g_n along the
  /// normal [m/s^2].
  static std::optional<double> impact_rate(double gravity, const Constants& material) {
    return gravity / (2. * material.rebound_speed);
  }
};

/// Answers one collision: collision matrix K [1/kg], velocity u of the point [m/s] and unit normal
/// n, all in world axes, and the tile's material -> impulse on the robot [N s]. Reads
/// kinetic_friction, restitution and rebound_speed of the material. Cost and errors as
/// resolve_collision.
inline Collision impulse(const Symmetric3d& K, const Vector3d& u, const Vector3d& n,
                         const MaterialConstants<double>& material) {
  return resolve_collision(
      {K, u, n, material.kinetic_friction, material.restitution, material.rebound_speed});
}

}  // namespace hookpoint::contact
