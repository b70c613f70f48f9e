#include "simulation/analysis/matched_ground.h"

#include <cmath>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "simulation/analysis/advice_constants.h"
#include "simulation/experiment/ground.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

/// What hookpoint does with a material's own constants.
struct Wanted {
  double load, mass, speed;  // [N], [kg], [m/s]
  double depth, stiffness;   // [m], [N/m]
  double rebound;            // of a landing
  double damping;            // about rest [N s/m]

  Wanted(const CarriedLoad& under, const Constants& material)
      : load(under.load),
        mass(under.mass),
        speed(under.impact_speed),
        depth(contact::Hookpoint::static_depth(load, material)),
        stiffness(material.normal_stiffness),
        rebound(contact::Hookpoint::restitution(mass, speed, material)),
        damping(material.normal_damping) {}
  bool lands() const { return speed > 0.; }
};

/// alpha of k d^n (1 + alpha d'), whatever the spring: by its closed form of the rebound at the
/// landing's speed, or alpha N = c about rest.
double hysteresis_for(const Wanted& wanted, const contact::LawDescription& law,
                      const Constants& now) {
  if (!wanted.lands() || wanted.damping == 0.) return wanted.damping / wanted.load;
  return damping_for_rebound(law, field_of(&Constants::hysteresis_damping), wanted.mass,
                             wanted.speed, wanted.rebound, now);
}

// k1 = W/d: one line with the stiffness beyond the nominal depth, which is hookpoint's own.
Constants matched(const contact::Nominal&, const contact::LawDescription&, const Wanted& wanted,
                  Constants material) {
  material.nominal_stiffness = wanted.stiffness;
  return material;
}

// n W/d = W/d wants n = 1; then k = W/d.
Constants matched(const contact::HuntCrossley&, const contact::LawDescription& law,
                  const Wanted& wanted, Constants material) {
  material.exponent = 1.;
  material.normal_stiffness = wanted.load / wanted.depth;
  material.hysteresis_damping = hysteresis_for(wanted, law, material);
  return material;
}

// d1 exp(d2 (d + d0)) = W with the tangent d2 W = W/d.
Constants matched(const contact::Exponential&, const contact::LawDescription& law,
                  const Wanted& wanted, Constants material) {
  material.exponential_rate = 1. / wanted.depth;
  material.exponential_force = wanted.load * std::exp(-material.exponential_rate *
                                                      (wanted.depth + material.exponential_height));
  material.hysteresis_damping = hysteresis_for(wanted, law, material);
  return material;
}

/// Any law by its own predictions: the constant that sets its depth, then the one of its rebound,
/// or of its damping about rest, to which that is proportional.
template <class Law>
Constants matched(const Law&, const contact::LawDescription& law, const Wanted& wanted,
                  Constants material) {
  const auto stiffness = stiffness_field(law), damping = damping_field(law);
  if (stiffness)
    material.*stiffness->member =
        stiffness_for_depth(law, *stiffness, wanted.load, wanted.depth, material);
  if (!damping) return material;
  if (wanted.lands() && wanted.damping > 0.) {
    material.*damping->member =
        damping_for_rebound(law, *damping, wanted.mass, wanted.speed, wanted.rebound, material);
    return material;
  }
  material.*damping->member = 1.;
  material.*damping->member = wanted.damping / law.linearise(wanted.load, material).normal_damping;
  return material;
}

/// The laws whose normal force is hookpoint's own.
template <class Law>
requires std::derived_from<Law, contact::SpringDamperPredictions> ||
    std::derived_from<Law, contact::LugrePredictions>
        Constants matched(const Law&, const contact::LawDescription&, const Wanted&,
                          Constants material) {
  return material;
}

/// The constants that differ. A law may read its stiffness in a unit of its own.
std::vector<MatchedConstant> changed(const Constants& own, const Constants& chosen,
                                     const contact::NormalConstants& along_normal = {}) {
  std::vector<MatchedConstant> constants;
  for (const MaterialField& field : material_fields()) {
    if (own.*field.member == chosen.*field.member) continue;
    const bool has_own_unit = field.member == along_normal.stiffness;
    constants.push_back(
        {field.name,
         std::string(has_own_unit ? along_normal.stiffness_unit : std::string_view(field.unit)),
         own.*field.member, chosen.*field.member});
  }
  return constants;
}

MatchedMaterial match(const contact::LawDescription& law, const CarriedLoad& under,
                      const MaterialSpec& spec) {
  const Wanted wanted(under, spec.constants);
  const Constants chosen = std::visit(
      [&](const auto& one) { return matched(one, law, wanted, spec.constants); }, law.variant);
  const contact::LinearContact about = law.linearise(wanted.load, chosen);
  MatchedMaterial made{under.material, spec.name, under,
                       changed(spec.constants, chosen, law.normal_constants)};
  made.depth = law.static_depth(wanted.load, chosen) / wanted.depth;
  made.stiffness = about.normal_stiffness / wanted.stiffness;
  if (wanted.lands())
    made.rebound = law.restitution(wanted.mass, wanted.speed, chosen) / wanted.rebound;
  else if (wanted.damping > 0.)
    made.rebound = about.normal_damping / wanted.damping;
  return made;
}

MatchedMaterial match_impulses(const CarriedLoad& under, const MaterialSpec& spec) {
  const Wanted wanted(under, spec.constants);
  Constants chosen = spec.constants;
  if (wanted.lands()) chosen.restitution = wanted.rebound;
  return {under.material,          spec.name, under, changed(spec.constants, chosen), 0., 0.,
          wanted.lands() ? 1. : 0.};
}

std::size_t first_robot(const Experiment& experiment) {
  const auto mobile = std::ranges::find_if(experiment.robots, &RobotSpec::mobile);
  return mobile == experiment.robots.end()
             ? 0
             : static_cast<std::size_t>(mobile - experiment.robots.begin());
}

}  // namespace

std::vector<MatchedMaterial> matched_to_hookpoint(const Experiment& experiment) {
  if (experiment.engine != "dts")
    throw ExperimentError("`match` chooses constants of a law of engine dts; engine " +
                          experiment.engine + " has the material's at `settings = matched`");
  const auto terrain = make_ground(experiment);
  if (!terrain || experiment.robots.empty())
    throw ExperimentError("there is no robot on a ground: nothing to `match`");
  if (norm(experiment.gravity) == 0.)
    throw ExperimentError("without gravity nothing bears on the ground: no depth to `match`");
  // What carries the robot, and how it lands, is the scene's: under hookpoint.
  Experiment reference = experiment;
  reference.contact = contact::Hookpoint::name;
  const auto* const law = contact::find_force_law(experiment.contact);
  std::vector<MatchedMaterial> materials;
  for (const CarriedLoad& under :
       carried_loads(reference, first_robot(reference), *terrain, initial_inputs(reference))) {
    require_ground_alone(experiment, under, "`match`");
    const MaterialSpec& spec = experiment.materials[static_cast<std::size_t>(under.material)];
    materials.push_back(law ? match(*law, under, spec) : match_impulses(under, spec));
  }
  return materials;
}

}  // namespace hookpoint::simulation
