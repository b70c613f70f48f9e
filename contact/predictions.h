// Closed forms that hold for a whole family of contact laws: what a study puts beside a
// measurement, and the advice of `hookpoint advise`. A law's own predictions stand in its own file.
// SI throughout; docs/contact.md derives them.
#pragma once

#include <cmath>
#include <optional>

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// A contact point linearised about a steady load, for stability bounds. Stiffness [N/m], damping
/// [N s/m].
struct LinearContact {
  double normal_stiffness = 0., normal_damping = 0.;
  double tangential_stiffness = 0., tangential_damping = 0.;
};

/// Coulomb's threshold: a body at rest on a slope holds iff tan(theta) <= mu_s.
bool holds_on_slope(double tangent_of_slope, double static_friction);

/// Acceleration down a slope of `angle` [rad] while sliding, g (sin - mu_k cos) [m/s^2]; `gravity`
/// g [m/s^2].
double slip_acceleration(double gravity, double angle, double kinetic_friction);

/// Distance in which Coulomb friction stops a body sliding at `speed` [m/s] on the level, v0^2/(2
/// mu_k g) [m].
double braking_distance(double speed, double gravity, double kinetic_friction);

/// How far a hook's elastic stretch is carried from the sliding to the sticking state, e0 = mu_k m
/// g/(n k_t) [m]: a braking body stops between e0/2 (no damper) and e0 (damper) short of
/// `braking_distance`. `load` = m g/n [N].
double braking_elastic_offset(double load, const MaterialConstants<double>& material);

/// Rebound e = v'/v of a mass on a spring-damper that cannot pull, released when its force is 0, no
/// gravity: e = exp(-(zeta/sqrt(1 - zeta^2)) acos(2 zeta^2 - 1)); the same function continued for
/// zeta >= 1. `damping_ratio` zeta = c/(2 sqrt(k m)) >= 0.
double kelvin_voigt_restitution(double damping_ratio);

/// Damping ratio zeta with which kelvin_voigt_restitution is `restitution`; 0 for e >= 1, infinite
/// for e <= 0.
double kelvin_voigt_damping_ratio(double restitution);

/// Rebound e of Hunt & Crossley's k d^n (1 + alpha d') hit at v, from a - ln(1 + a) = -e a - ln(1 -
/// e a), a = alpha v
/// >= 0; whatever n, k and the mass.
double hunt_crossley_restitution(double alpha_times_speed);

/// Highest speed [m/s] at which a body may bob vertically on linear springs of total stiffness k
/// [N/m] without its hooks dying: g sqrt(m/k) (docs/contact.md, hook survival).
double hook_survival_speed(double gravity, double mass, double total_normal_stiffness);

}  // namespace hookpoint::contact
