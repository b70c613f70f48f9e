// Drake: f = k d (1 + D v), implicit in a step (discrete approximations lagged, similar and tamsi), and
// friction t = v/sqrt(v^2 + e^2) with the stiction tolerance e. Points have k; hydroelastic contact has
// a pressure E d/H over the patch.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "math/bisect.h"
#include "translation/damping.h"
#include "translation/impact.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

constexpr std::string_view dissipation_text =
    "D in f (1 + D v): rebound 1 - 2/3 D v of a slow impact. Of both surfaces the mean, weighted by the other's "
    "stiffness";
constexpr std::string_view tolerance_text =
    "speed e of the friction v/sqrt(v^2 + e^2): a contact that stands creeps at e f_t/sqrt((mu f_n)^2 - f_t^2)";

const std::array parameters_of_points{
    Parameter{
        "point_contact_stiffness",
        "N/m",
        {{1e10}, ""},
        {},
        "of each surface, both in series; without one Drake takes it from penetration_allowance (1 mm) and "
        "the largest mass",
        1e-9},
    Parameter{"hunt_crossley_dissipation", "s/m", {{10.}, ""}, {}, dissipation_text},
    Parameter{"mu_static", "1", {{1.}, ""}, {}, "read by the continuous model alone"},
    Parameter{"mu_dynamic", "1", {{1.}, ""}, {}, "of two surfaces 2 mu1 mu2/(mu1 + mu2)"},
    Parameter{"stiction_tolerance", "m/s", {{1e-3}, ""}, {}, tolerance_text, 1e-12},
};
const std::array parameters_of_patches{
    Parameter{"hydroelastic_modulus",
              "Pa",
              {{1e7}, ""},
              {},
              "E of the pressure E d/H: stiffness E A/H [N/m] of a rigid face of area A",
              1e-9},
    Parameter{"slab_thickness",
              "m",
              {{0.1}, ""},
              {},
              "H of a half space; half the least edge of a box",
              1e-9},
    Parameter{"hunt_crossley_dissipation", "s/m", {{0.}, ""}, {}, dissipation_text},
    Parameter{"mu_static", "1", {{1.}, ""}, {}, "read by the continuous model alone"},
    Parameter{"mu_dynamic", "1", {{1.}, ""}, {}, "of two surfaces 2 mu1 mu2/(mu1 + mu2)"},
    Parameter{"stiction_tolerance", "m/s", {{1e-3}, ""}, {}, tolerance_text, 1e-12},
};

/// The smoothing of friction over the creep on the slope, sqrt((mu f_n)^2 - f_t^2)/f_t.
double tolerance_over_creep(double friction, const Situation& at) {
  const double limit = friction * normal_on_slope(at), tangential = tangential_on_slope(at);
  return std::sqrt(limit * limit - tangential * tangential) / tangential;
}

/// `stiffness`: of the pair [N/m].
Behaviour behaviour_of(double stiffness, const Parameters& parameters, const Situation& at) {
  const double dissipation = parameters.number("hunt_crossley_dissipation");
  const double mu = parameters.number("mu_dynamic");
  Behaviour result;
  result.friction_shape = "cone, smoothed over the stiction tolerance";
  result.static_depth = at.load / stiffness;
  // sap_driver.cc: a friction row yields by sigma/m of its impulse.
  constexpr double sigma = 1e-3;
  const double smoothing = std::max(parameters.number("stiction_tolerance"),
                                    mu * sigma / at.mass * normal_on_slope(at) * at.deltat);
  result.set_creep(mu, smoothing / tolerance_over_creep(mu, at));
  predict_rebound(result, at, [&](double depth, double approach) {
    // At the speed u of the step's end f = k (d + dt u)+ (1 + D u)+ and m (v - u) = dt f.
    const auto force = [&](double u) {
      return stiffness * std::max(0., depth + at.deltat * u) * std::max(0., 1. + dissipation * u);
    };
    const auto gained = [&](double u) { return u - approach + at.deltat / at.mass * force(u); };
    const double out = std::max(-depth / at.deltat, dissipation > 0. ? -1. / dissipation : -1e300);
    if (out >= approach) return 0.;
    return force(bisect(gained, out, approach));
  });
  return result;
}

void set_common(Parameters& parameters, const DesiredContact& desired, const Situation& at) {
  parameters.set("hunt_crossley_dissipation", hunt_crossley_damping(desired, at));
  if (desired.most_creep && holds(desired.kinetic_friction))
    parameters.set(
        "stiction_tolerance",
        std::min(parameters.number("stiction_tolerance"),
                 *desired.most_creep * tolerance_over_creep(desired.kinetic_friction, at)));
  parameters.set("mu_static", desired.static_friction);
  parameters.set("mu_dynamic", desired.kinetic_friction);
}

Parameters nearest_points(const DesiredContact& desired, const Situation& at) {
  Parameters result(parameters_of_points);
  result.set("point_contact_stiffness", 2. * desired.stiffness);
  set_common(result, desired, at);
  return result;
}
Parameters nearest_patches(const DesiredContact& desired, const Situation& at) {
  Parameters result(parameters_of_patches);
  result.set("hydroelastic_modulus", desired.stiffness * result.number("slab_thickness") / at.area);
  set_common(result, desired, at);
  return result;
}

Behaviour behaviour_of_points(const Parameters& parameters, const Situation& at) {
  return behaviour_of(0.5 * parameters.number("point_contact_stiffness"), parameters, at);
}
Behaviour behaviour_of_patches(const Parameters& parameters, const Situation& at) {
  return behaviour_of(
      parameters.number("hydroelastic_modulus") * at.area / parameters.number("slab_thickness"),
      parameters, at);
}

std::string head(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "MultibodyPlantConfig config;\n"
      "config.time_step = {};\n"
      "config.stiction_tolerance = {};  // discrete_contact_approximation = \"lagged\"\n",
      numbers_text({at.deltat}), parameters.text("stiction_tolerance"));
}
std::string friction_text(const Parameters& parameters) {
  return fmt::format("CoulombFriction<double>({}, {})", parameters.text("mu_static"),
                     parameters.text("mu_dynamic"));
}

std::string points_snippet(const Parameters& parameters, const Situation& at) {
  return head(parameters, at) +
         fmt::format(
             "geometry::ProximityProperties properties;  // the same of ground and foot\n"
             "geometry::AddContactMaterial({} /* s/m */, {} /* N/m */,\n"
             "                             {}, &properties);",
             parameters.text("hunt_crossley_dissipation"),
             parameters.text("point_contact_stiffness"), friction_text(parameters));
}

std::string patches_snippet(const Parameters& parameters, const Situation& at) {
  return head(parameters, at) +
         fmt::format(
             "config.contact_model = \"hydroelastic\";  // the foot rigid: AddRigidHydroelasticProperties\n"
             "geometry::ProximityProperties ground;\n"
             "geometry::AddCompliantHydroelasticPropertiesForHalfSpace({} /* m */, {} /* Pa */, &ground);\n"
             "geometry::AddContactMaterial({} /* s/m */, {{}}, {}, &ground);",
             parameters.text("slab_thickness"), parameters.text("hydroelastic_modulus"),
             parameters.text("hunt_crossley_dissipation"), friction_text(parameters));
}

std::vector<std::string> common_notes(const DesiredContact& desired) {
  std::vector<std::string> notes{
      fmt::format("its damping goes with the force: the rebound is right at {} m/s alone",
                  numbers_text({impact_speed})),
      "friction has no spring: a foot on a slope creeps at a part of the stiction tolerance"};
  if (desired.static_friction != desired.kinetic_friction)
    notes.emplace_back("discrete models read mu_dynamic alone");
  return notes;
}
std::vector<std::string> cannot_points(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = common_notes(desired);
  notes.emplace_back(
      "the approximation sap reads relaxation_time instead of the dissipation: c/(2 k) of each surface");
  return notes;
}
std::vector<std::string> cannot_patches(const DesiredContact& desired, const Situation& at) {
  std::vector<std::string> notes = common_notes(desired);
  notes.push_back(fmt::format("the stiffness of a patch goes with its area, here {} m^2 (--area)",
                              numbers_text({at.area})));
  return notes;
}

const char* const source =
    "Drake, multibody/plant/contact_properties.cc; contact_solvers/sap/sap_hunt_crossley_constraint.cc; "
    "geometry/proximity/hydroelastic_internal.cc";

}  // namespace

const Target drake_target{.name = "drake",
                          .title = "Drake, point contact",
                          .basis = Basis::formula,
                          .source = source,
                          .parameters = parameters_of_points,
                          .nearest = nearest_points,
                          .behaviour = behaviour_of_points,
                          .static_friction = "mu_dynamic",
                          .kinetic_friction = "mu_dynamic",
                          .snippet = points_snippet,
                          .cannot = cannot_points};

const Target drake_hydroelastic_target{.name = "drake_hydroelastic",
                                       .title = "Drake, hydroelastic contact",
                                       .basis = Basis::formula,
                                       .source = source,
                                       .parameters = parameters_of_patches,
                                       .nearest = nearest_patches,
                                       .behaviour = behaviour_of_patches,
                                       .static_friction = "mu_dynamic",
                                       .kinetic_friction = "mu_dynamic",
                                       .snippet = patches_snippet,
                                       .cannot = cannot_patches};

}  // namespace hookpoint::translation
