// The fields of a Material, each a constant of contact laws, once: what the schema says of it and
// where the load step puts it. A default is the member's own initialiser.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>

#include "contact/vocabulary.h"

namespace hookpoint::simulation {

struct MaterialField {
  const char* name;
  const char* unit;
  double contact::MaterialConstants<double>::*member;
  bool positive;  ///< must be > 0; else >= 0
  const char* doc;
  double maximum = std::numeric_limits<double>::infinity();
};

/// Each coefficient of friction stands in for the other when only one is given.
inline constexpr const char *static_friction_field = "static_friction",
                            *kinetic_friction_field = "kinetic_friction",
                            *friction_across_field = "friction_across";

inline constexpr std::array<MaterialField, 25> material_fields() {
  using Constants = contact::MaterialConstants<double>;
  return {{
      {"normal_stiffness", "N/m", &Constants::normal_stiffness, true,
       "k, of a contact point along the ground's normal (hunt_crossley: N/m^n; azad_featherstone: "
       "N/m^1.5; nominal: beyond the nominal depth)"},
      {"normal_damping", "N.s/m", &Constants::normal_damping, false,
       "c, along the normal (azad_featherstone: D, N.s/m^1.5)"},
      {"tangential_stiffness", "N/m", &Constants::tangential_stiffness, true,
       "k_t, between a contact point and its hook; sigma0 of a bristle"},
      {"tangential_damping", "N.s/m", &Constants::tangential_damping, false,
       "c_t, along the tile; sigma1 of a bristle"},
      {static_friction_field, "", &Constants::static_friction, false,
       "mu_s, holds while |f| <= mu_s N; if not given, kinetic_friction, or 0.8"},
      {kinetic_friction_field, "", &Constants::kinetic_friction, false,
       "mu_k <= mu_s, while sliding; if not given, static_friction, or 0.8"},
      {"nominal_penetration", "m", &Constants::nominal_penetration, true,
       "d0, the depth wanted under the load"},
      {"nominal_stiffness", "N/m", &Constants::nominal_stiffness, true,
       "k1, up to the nominal depth: the load on a point / nominal_penetration"},
      {"blend_width", "m", &Constants::blend_width, false,
       "w, beyond the nominal depth, over which k1 turns smoothly into k; 0: at once"},
      {"restitution", "", &Constants::restitution, false, "e, 0..1, rebound of the impulse laws",
       1.},
      {"exponent", "", &Constants::exponent, true, "n of k d^n, hunt_crossley"},
      {"hysteresis_damping", "s/m", &Constants::hysteresis_damping, false,
       "alpha of hunt_crossley, c of exponential"},
      {"regularisation_speed", "m/s", &Constants::regularisation_speed, true,
       "v_s, below which regularised Coulomb friction creeps"},
      {"stribeck_speed", "m/s", &Constants::stribeck_speed, true,
       "v_St, over which mu falls from static to kinetic"},
      {"viscous_friction", "N.s/m", &Constants::viscous_friction, false,
       "sigma2, of lugre and elastoplastic"},
      {"breakaway", "", &Constants::breakaway, true,
       "fraction, at most 1, of mu_k N up to which a bristle only bends, elastoplastic", 1.},
      {"exponential_force", "N", &Constants::exponential_force, true,
       "d1, the normal force at height d0, exponential"},
      {"exponential_rate", "1/m", &Constants::exponential_rate, true,
       "d2, the normal force is e times greater 1/d2 deeper, exponential"},
      {"exponential_height", "m", &Constants::exponential_height, false,
       "d0, height above the tile where the normal force is d1, exponential"},
      {"sliding_time", "s", &Constants::sliding_time, true,
       "tau, in which friction changes between static and kinetic, exponential"},
      {"rebound_speed", "m/s", &Constants::rebound_speed, false,
       "u0, least rebound of a microcollision, what keeps a resting block bouncing (impulse laws)"},
      {"rolling_resistance", "m", &Constants::rolling_resistance, false,
       "b, a moment of at most b times the load against rolling of balls and round shapes; force "
       "laws"},
      {"spinning_resistance", "m", &Constants::spinning_resistance, false,
       "the same against spin about the ground's normal; force laws"},
      {"adhesion", "N", &Constants::adhesion, false,
       "pull along the normal on each contact point while it lasts; friction then counts with the "
       "load and it; force laws"},
      {friction_across_field, "", &Constants::friction_across, false,
       "kinetic coefficient across the x axis of the foot's body, static in the same ratio; "
       "kinetic_friction and static_friction are then those along it; 0: the same; force laws"},
  }};
}

/// The field of a constant; there is one for each.
inline MaterialField field_of(double contact::MaterialConstants<double>::*constant) {
  const auto fields = material_fields();
  return *std::ranges::find(fields, constant, &MaterialField::member);
}

/// "`restitution`, `exponent`".
inline std::string quoted_fields(
    std::span<double contact::MaterialConstants<double>::*const> constants) {
  std::string names;
  for (const auto constant : constants)
    names += (names.empty() ? "`" : ", `") + std::string(field_of(constant).name) + '`';
  return names;
}

}  // namespace hookpoint::simulation
