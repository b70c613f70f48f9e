// The contact that is translated, and what an engine does with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace hookpoint::translation {

/// One contact under a body that rests. SI.
struct Situation {
  double load = 0.;      ///< along the normal [N]
  double mass = 0.;      ///< that the contact stops in a blow [kg]
  double contacts = 1.;  ///< that share the body evenly
  double deltat = 1e-3;  ///< step of the other engine [s]
  double radius = 0.02;  ///< of the foot, for engines whose contact is Hertz's [m]
  double area = 1e-3;    ///< of the foot's face, for engines whose contact is a pressure [m^2]

  /// Of the body that the contacts share [kg].
  double body_mass() const { return mass * contacts; }
};

/// The slope on which creep is predicted [rad].
constexpr double slope = 10. * std::numbers::pi / 180.;
/// Parts of the load along and across the ground on that slope [N].
inline double normal_on_slope(const Situation& at) { return at.load * std::cos(slope); }
inline double tangential_on_slope(const Situation& at) { return at.load * std::sin(slope); }

/// Speed of the blow whose rebound is predicted [m/s].
constexpr double impact_speed = 1.;

/// What is wanted of a contact: a spring and damper each way, with friction. SI.
struct Wanted {
  double stiffness = 0.;             ///< k, load over static depth [N/m]
  double damping = 0.;               ///< c [N s/m]
  double tangential_stiffness = 0.;  ///< k_t [N/m]
  double tangential_damping = 0.;    ///< c_t [N s/m]
  double static_friction = 0.;       ///< mu_s [1]
  double kinetic_friction = 0.;      ///< mu_k [1]
  /// The fastest that a sticking contact may creep on 10 deg [m/s]: friction is made stiffer for it.
  std::optional<double> most_creep = std::nullopt;
};

/// What a contact does. An empty number has its reason in `unknown`.
struct Behaviour {
  std::optional<double> static_depth;  ///< under the load [m]
  std::optional<double> creep;         ///< of a contact that sticks, on 10 deg [m/s]
  std::optional<double> rebound;       ///< speed after over speed before, at 1 m/s, without weight
  /// Of this contact under its mass [s]; empty where any step is stable.
  std::optional<double> largest_stable_step;
  std::optional<double> damping;  ///< of a linear damper that acts both ways [N s/m]; not others'
  bool rigid = false;             ///< nothing gives but the depth: there is no stiffness
  std::string friction_shape;     ///< "elliptic cone", "pyramid inside the cone", ...
  std::string unknown;            ///< why a number is missing; "" where none is
};

/// Speed of creep per newton of friction [m/(N s)] of the wanted spring and damper along the ground,
/// taken implicitly over a step, or less for the wanted creep.
inline double wanted_mixing(const Wanted& wanted, const Situation& at) {
  const double mixing = 1. / (wanted.tangential_damping + at.deltat * wanted.tangential_stiffness);
  return wanted.most_creep ? std::min(mixing, *wanted.most_creep / tangential_on_slope(at))
                           : mixing;
}

/// Friction holds on the slope.
inline bool holds(double friction) { return std::tan(slope) <= friction; }
/// Why there is no creep where it does not.
inline const char* slides_text = "10 deg is steeper than friction holds";

}  // namespace hookpoint::translation
