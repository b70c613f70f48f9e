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
  double mass = 0.;      ///< that the contact stops in an impact [kg]
  double contacts = 1.;  ///< that share the body evenly
  double deltat = 1e-3;  ///< step of the other engine [s]
  double radius = 0.02;  ///< of the foot, for engines whose contact is Hertz's [m]
  double area = 1e-3;    ///< of the foot's face, for engines whose contact is a pressure [m^2]

  /// Of a foot of a robot with joints: 1/(n J M^-1 J^T n) at the contact [kg], and tr(J M^-1 J^T)/3 of its
  /// body [1/kg] (simulation/analysis/inverse_weight.h); none of a free body.
  std::optional<double> effective_mass, inverse_weight;

  /// Inverse of the diagonal of the contact's normal row [kg].
  double row_mass() const { return effective_mass.value_or(mass); }
  /// Of the foot's body, as MuJoCo scales its contacts [1/kg].
  double foot_inverse_weight() const { return inverse_weight.value_or(1. / (mass * contacts)); }
};

/// The slope on which creep is predicted [rad].
constexpr double slope = 10. * std::numbers::pi / 180.;
/// Parts of the load along and across the ground on that slope [N].
inline double normal_on_slope(const Situation& at) { return at.load * std::cos(slope); }
inline double tangential_on_slope(const Situation& at) { return at.load * std::sin(slope); }

/// Speed of the impact whose rebound is predicted [m/s].
constexpr double impact_speed = 1.;

/// What a contact should do: a spring and damper each way, with friction. SI.
struct DesiredContact {
  double stiffness = 0.;             ///< k, load over static depth [N/m]
  double damping = 0.;               ///< c [N s/m]
  double tangential_stiffness = 0.;  ///< k_t [N/m]
  double tangential_damping = 0.;    ///< c_t [N s/m]
  double static_friction = 0.;       ///< mu_s [1]
  double kinetic_friction = 0.;      ///< mu_k [1]
  /// The fastest that a sticking contact may creep on 10 deg [m/s]: friction is made stiffer for it.
  std::optional<double> most_creep = std::nullopt;
};

/// Friction holds on the slope.
inline bool holds(double friction) { return std::tan(slope) < friction; }

/// What a contact does. A number that is missing has its reason in `unknown`.
struct Behaviour {
  std::optional<double> static_depth;  ///< under the load [m]
  std::optional<double> creep;         ///< of a contact that sticks, on 10 deg [m/s]
  std::optional<double>
      rebound;  ///< speed after over speed before an impact at 1 m/s, without weight
  /// Of this contact under its mass [s]; empty where any step is stable.
  std::optional<double> largest_stable_step;
  std::optional<double> damping;  ///< of a linear damper that acts both ways [N s/m]; not others'
  bool rigid = false;             ///< there is no stiffness
  std::string friction_shape;     ///< "elliptic cone", "pyramid inside the cone", ...
  std::string unknown;            ///< why numbers are missing; "" where none is

  void add_unknown(const std::string& why) { unknown += (unknown.empty() ? "" : "; ") + why; }
  void set_rigid(const std::string& why) {
    rigid = true;
    add_unknown("the contact is rigid" + why);
  }
  /// `speed` [m/s] of a contact that sticks.
  void set_creep(double friction, double speed) {
    if (holds(friction))
      creep = speed;
    else
      add_unknown("10 deg is steeper than friction holds");
  }
};

/// Speed of creep per newton of friction [m/(N s)] of the desired spring and damper along the ground,
/// taken implicitly over a step, or less for the desired creep.
inline double desired_mixing(const DesiredContact& desired, const Situation& at) {
  const double mixing =
      1. / (desired.tangential_damping + at.deltat * desired.tangential_stiffness);
  return desired.most_creep ? std::min(mixing, *desired.most_creep / tangential_on_slope(at))
                            : mixing;
}

}  // namespace hookpoint::translation
