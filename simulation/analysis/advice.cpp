#include "simulation/analysis/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/predictions.h"
#include "integrators/stepper.h"
#include "simulation/analysis/advice_changes.h"
#include "simulation/analysis/advice_constants.h"
#include "simulation/analysis/carried_load.h"
#include "simulation/analysis/stability.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/ground.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

/// Wanted where neither the user nor the material says: a blow leaves a tenth of its speed.
constexpr double usual_rebound = 0.1;
/// Below it a damper would have to be endlessly strong.
constexpr double least_rebound = 0.01;

/// Of the load: what an exponential spring may carry where the ground begins. More, and a robot
/// stands on what is not there yet.
constexpr double surface_share = 0.1;

using Aim = ConstantAdvice::Aim;

void check_applicable(const Experiment& experiment) {
  if (experiment.engine != "dts")
    throw ExperimentError("advice is for the laws of engine dts, not for `" + experiment.engine +
                          "`: give --set " + experiment.world + ".engine=dts");
  if (!contact::find_force_law(experiment.contact))
    throw ExperimentError("the law `" + experiment.contact +
                          "` has no stiffness and no damping: there is nothing to advise on");
  if (!experiment.terrain)
    throw ExperimentError("the World has no terrain: there is no contact to advise on");
}

double wanted_rebound(const AdviceWishes& wishes,
                      const contact::MaterialConstants<double>& material) {
  if (wishes.rebound && *wishes.rebound < least_rebound)
    throw ExperimentError(fmt::format(
        "a damper takes all speed of a blow only when it is endlessly strong: require a rebound of "
        "{} or more",
        least_rebound));
  if (wishes.rebound) return *wishes.rebound;
  return material.restitution >= least_rebound ? material.restitution : usual_rebound;
}

/// Sets `field` to `value` among the advised constants.
void advise_constant(GroundAdvice& ground, const contact::MaterialConstants<double>& present,
                     ConstantAdvice::Aim aim, const MaterialField& field, double value,
                     std::string reason) {
  ground.advised.*field.member = value;
  ground.constants.push_back(
      {aim, field.name, field.unit, present.*field.member, value, std::move(reason)});
}

/// The vertical speed about rest at which a body just leaves what the law reaches, without its
/// damper: m v^2/2 = W (d + reach) - U(d) [m/s].
double survival_speed(const contact::LawDescription& law, const GroundAdvice& ground,
                      const contact::MaterialConstants<double>& material) {
  const double depth = law.static_depth(ground.load, material);
  const double reach = law.reach(material);
  const double energy = ground.load * (depth + reach) - law.stored_energy(depth, {}, material);
  return std::sqrt(2. * std::max(0., energy) / ground.mass);
}

/// The constant that sets the depth; of a law that acts above the tile the force there too, where
/// it is more than `surface_share`. False for a law without one.
bool advise_depth(GroundAdvice& ground, const contact::LawDescription& law,
                  const contact::MaterialConstants<double>& present) {
  using Constants = contact::MaterialConstants<double>;
  const auto stiffness = stiffness_field(law);
  if (!stiffness) return false;
  if (stiffness->member == &Constants::nominal_stiffness)
    ground.advised.nominal_penetration = ground.wanted_depth;
  ground.advised.*stiffness->member =
      stiffness_for_depth(law, *stiffness, ground.load, ground.wanted_depth, ground.advised);
  if (carries_above_ground(law, ground.load, surface_share, ground.advised)) {
    ground.advised =
        exponential_for_depth(ground.load, ground.wanted_depth, surface_share, ground.advised);
    advise_constant(
        ground, present, Aim::depth, field_named("exponential_force"),
        ground.advised.exponential_force,
        fmt::format("the ground carries {:.3g} % of that where it begins", 100. * surface_share));
  }
  advise_constant(ground, present, Aim::depth, *stiffness, ground.advised.*stiffness->member,
                  fmt::format("{} N rest {:.3g} mm deep", text::rounded(ground.load),
                              1e3 * ground.wanted_depth));
  return true;
}

void advise_constants(GroundAdvice& ground, const contact::LawDescription& law,
                      const contact::MaterialConstants<double>& present, double speed) {
  ground.advised = present;
  if (!advise_depth(ground, law, present)) return;
  const auto damping = damping_field(law);
  if (damping) {
    advise_constant(ground, present, Aim::rebound, *damping,
                    damping_for_rebound(law, *damping, ground.mass, speed, ground.wanted_rebound,
                                        ground.advised),
                    fmt::format("{} kg rebound with {:.3g} of the speed",
                                text::rounded(ground.mass), ground.wanted_rebound));
  }
  if (law.reads(&contact::Constants::tangential_stiffness))
    advise_constant(ground, present, Aim::friction, field_named("tangential_stiffness"),
                    ground.load / ground.wanted_depth,
                    "the hook's spring deflects as far as the point penetrates");
  if (damping && law.reads(&contact::Constants::tangential_damping)) {
    const double zeta = contact::kelvin_voigt_damping_ratio(ground.wanted_rebound);
    const double stiffness = ground.load / ground.wanted_depth;
    advise_constant(ground, present, Aim::friction, field_named("tangential_damping"),
                    2. * zeta * std::sqrt(stiffness * ground.mass),
                    "the hook's spring is damped as a linear spring with that rebound");
  }
}

/// Refuses to advise on a ground that nothing rests on, and numbers beyond a computer's.
void check_ground(const GroundAdvice& ground) {
  if (ground.load == 0.)
    throw ExperimentError(fmt::format(
        "robot {} does not press on {}: without a load there is no depth to advise on (gravity?)",
        ground.robot, ground.material));
  // In millimetres, as they are printed.
  bool finite = std::isfinite(1e3 * ground.depth) && std::isfinite(ground.survival_present) &&
                std::isfinite(ground.survival_advised);
  for (const ConstantAdvice& constant : ground.constants)
    finite = finite && std::isfinite(constant.advised);
  if (!finite)
    throw ExperimentError(fmt::format(
        "the advice for robot {} on {} is beyond the range of numbers: make gravity, masses and "
        "wishes smaller",
        ground.robot, ground.material));
}

/// One a material under the robot's carrying points.
std::vector<GroundAdvice> advise_robot(const Experiment& experiment, int index,
                                       const contact::Terrain& terrain, const WorldInputs& inputs,
                                       const AdviceWishes& wishes) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  const auto robot = static_cast<std::size_t>(index);
  std::vector<GroundAdvice> grounds;
  for (const CarriedLoad& share : carried_loads(experiment, robot, terrain, inputs)) {
    require_ground_alone(experiment, share, "advice");
    const MaterialSpec& spec = experiment.materials[static_cast<std::size_t>(share.material)];
    GroundAdvice ground;
    ground.robot = experiment.robots[robot].name;
    ground.material = spec.name;
    ground.points = share.points;
    ground.mass = share.mass;
    ground.load = share.load;
    ground.least_mass = share.least_mass;
    ground.depth = law.static_depth(ground.load, spec.constants);
    ground.rebound = law.restitution(ground.mass, wishes.impact_speed, spec.constants);
    ground.wanted_depth = wishes.penetration.value_or(spec.constants.nominal_penetration);
    ground.wanted_rebound = wanted_rebound(wishes, spec.constants);
    advise_constants(ground, law, spec.constants, wishes.impact_speed);
    ground.survival_present = survival_speed(law, ground, spec.constants);
    ground.survival_advised = survival_speed(law, ground, ground.advised);
    check_ground(ground);
    grounds.push_back(std::move(ground));
  }
  return grounds;
}

/// The experiment on the advised ground. Of two robots on one material the stiffer advice counts.
Experiment advised_experiment(const Experiment& experiment,
                              const std::vector<GroundAdvice>& grounds) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  const auto stiffness = [&](const GroundAdvice& ground) {
    return law.linearise(ground.load, ground.advised).normal_stiffness;
  };
  Experiment advised = experiment;
  for (MaterialSpec& material : advised.materials) {
    const GroundAdvice* stiffest = nullptr;
    for (const GroundAdvice& ground : grounds) {
      if (ground.material == material.name &&
          (stiffest == nullptr || stiffness(ground) > stiffness(*stiffest)))
        stiffest = &ground;
    }
    if (stiffest != nullptr) material.constants = stiffest->advised;
  }
  return advised;
}

StabilityBound bound_under(Experiment experiment, std::string_view integrator) {
  experiment.integrator = integrator;
  return stability_bound(experiment);
}

}  // namespace

Advice advise(const Experiment& experiment, const AdviceWishes& wishes) {
  check_applicable(experiment);
  const auto terrain = make_ground(experiment);
  const WorldInputs inputs = initial_inputs(experiment);
  Advice advice;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    for (GroundAdvice& ground :
         advise_robot(experiment, static_cast<int>(i), *terrain, inputs, wishes))
      advice.grounds.push_back(std::move(ground));
  }
  const Experiment advised = advised_experiment(experiment, advice.grounds);
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    if (stepper.adaptive()) continue;
    StabilityBound present = bound_under(experiment, stepper.name);
    const double then =
        present.not_computed.empty() ? bound_under(advised, stepper.name).step : present.step;
    advice.steps.push_back({std::string(stepper.name), present.step, then, present.not_computed});
    advice.controllers = std::move(present.controllers);
    advice.left_out = std::move(present.left_out);
  }
  advice.changes = advise_changes(experiment, advice);
  return advice;
}

}  // namespace hookpoint::simulation
