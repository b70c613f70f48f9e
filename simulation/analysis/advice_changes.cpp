#include "simulation/analysis/advice_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/force_law.h"
#include "simulation/analysis/stability.h"
#include "simulation/experiment/material_fields.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

/// A depth or a rebound nearer to the wish than this is left alone.
constexpr double depth_tolerance = 0.2;
constexpr double rebound_tolerance = 0.1;
/// A constant that limits the step is lowered until the bound is this much above it.
constexpr double step_margin = 1.25;

using Member = double Constants::*;

/// Constants that may limit the step together.
using Culprit = std::vector<Member>;

/// From what costs least to lower; at last together what no single one helps.
std::vector<Culprit> culprits() {
  return {
      {&Constants::tangential_damping},
      {&Constants::normal_damping},
      {&Constants::hysteresis_damping},
      {&Constants::tangential_stiffness},
      {&Constants::normal_stiffness, &Constants::nominal_stiffness},
      {&Constants::exponential_rate},
      {&Constants::tangential_damping, &Constants::normal_damping, &Constants::hysteresis_damping},
      {&Constants::tangential_damping, &Constants::normal_damping, &Constants::hysteresis_damping,
       &Constants::tangential_stiffness, &Constants::normal_stiffness,
       &Constants::nominal_stiffness, &Constants::exponential_rate}};
}

/// Whether the law reads the constant about that load.
bool reads(const contact::LawDescription& law, double load, const Constants& material,
           Member member) {
  Constants more = material;
  more.*member = 1.001 * material.*member;
  const auto now = law.linearise(load, material);
  const auto then = law.linearise(load, more);
  return now.normal_stiffness != then.normal_stiffness ||
         now.normal_damping != then.normal_damping ||
         now.tangential_stiffness != then.tangential_stiffness ||
         now.tangential_damping != then.tangential_damping;
}

/// A constant of one of the experiment's materials.
struct Place {
  std::size_t material = 0;
  MaterialField field;
};

/// Those of the culprit's that the law reads of the grounds that carry: each point its share of the
/// weight, or one all of it.
std::vector<Place> places(const Experiment& experiment, const Advice& advice,
                          const Culprit& culprit) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  std::vector<Place> places;
  for (std::size_t i = 0; i < experiment.materials.size(); ++i) {
    const MaterialSpec& material = experiment.materials[i];
    for (const MaterialField& field : material_fields()) {
      if (std::ranges::find(culprit, field.member) == culprit.end()) continue;
      const bool matters = std::ranges::any_of(advice.grounds, [&](const GroundAdvice& ground) {
        if (ground.material != material.name) return false;
        const double whole = ground.load * static_cast<double>(ground.points);
        return reads(law, ground.load, material.constants, field.member) ||
               reads(law, whole, material.constants, field.member);
      });
      if (matters) places.push_back({i, field});
    }
  }
  return places;
}

/// The bound with those constants `factor` times as large.
double bound_with(const Experiment& experiment, const std::vector<Place>& places, double factor) {
  Experiment changed = experiment;
  for (const Place& place : places)
    changed.materials[place.material].constants.*place.field.member *= factor;
  return stability_bound(changed).step;
}

/// The largest factor below 1 with which the step is stable; none when even a ten-thousandth is not
/// enough.
std::optional<double> factor_for_step(const Experiment& experiment,
                                      const std::vector<Place>& places) {
  const double wanted = step_margin * experiment.deltat;
  double low = 1e-4, high = 1.;
  if (places.empty() || bound_with(experiment, places, low) < wanted) return std::nullopt;
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (bound_with(experiment, places, middle) < wanted ? high : low) = middle;
  }
  return low;
}

/// "surface.normal_damping = 1.41 N.s/m": those constants `factor` times as large.
std::string lowered(const Experiment& experiment, const std::vector<Place>& places, double factor) {
  std::string text;
  for (const Place& place : places) {
    const MaterialSpec& material = experiment.materials[place.material];
    text += fmt::format(
        "{}{}.{} = {} {}", text.empty() ? "" : " and ", material.name, place.field.name,
        text::rounded(factor * material.constants.*place.field.member, 3), place.field.unit);
  }
  return text;
}

std::string another_integrator(const Experiment& experiment, const Advice& advice) {
  for (const StepAdvice& step : advice.steps) {
    if (step.integrator != experiment.integrator && step.present > experiment.deltat)
      return fmt::format(", or integrator = {} (stable up to {:.3g} s)", step.integrator,
                         step.present);
  }
  return "";
}

void advise_step(const Experiment& experiment, const Advice& advice,
                 std::vector<std::string>& changes) {
  const StabilityBound whole = stability_bound(experiment);
  const double bound = whole.step;
  if (!std::isfinite(bound) || experiment.deltat <= bound) return;
  if (const std::string controllers = controller_advice(whole); !controllers.empty()) {
    changes.push_back(controllers);
    if (experiment.deltat <= whole.without_controllers) return;
  }
  std::string smaller = bound > 0. ? fmt::format("deltat = {:.3g} s", bound / step_margin)
                                   : std::string("some damping");
  for (const Culprit& culprit : culprits()) {
    const std::vector<Place> changed = places(experiment, advice, culprit);
    const auto factor = factor_for_step(experiment, changed);
    if (!factor) continue;
    changes.push_back(fmt::format(
        "deltat {:.4g} s is above the largest stable step {:.4g} s of {}: set {}, or {}{}",
        experiment.deltat, bound, experiment.integrator, lowered(experiment, changed, *factor),
        smaller, another_integrator(experiment, advice)));
    return;
  }
  changes.push_back(fmt::format(
      "deltat {:.4g} s is above the largest stable step {:.4g} s of {}, and no softer ground "
      "helps: {}{}",
      experiment.deltat, bound, experiment.integrator, smaller,
      another_integrator(experiment, advice)));
}

/// "normal_stiffness = 6896 N/m": all constants advised for that aim; "" when there are none.
std::string settings(const GroundAdvice& ground, ConstantAdvice::Aim aim) {
  std::string text;
  for (const ConstantAdvice& constant : ground.constants) {
    if (constant.aim != aim) continue;
    text += fmt::format("{}{} = {} {}", text.empty() ? "" : " and ", constant.name,
                        text::rounded(constant.advised), constant.unit);
  }
  return text;
}

void advise_ground(const GroundAdvice& ground, std::vector<std::string>& changes) {
  const std::string stiffness = settings(ground, ConstantAdvice::Aim::depth);
  if (!stiffness.empty() && std::abs(ground.depth / ground.wanted_depth - 1.) > depth_tolerance)
    changes.push_back(fmt::format("{} {} {:.3g} mm {} {}, {:.3g} mm are allowed: set {}",
                                  ground.robot, ground.depth < 0. ? "hovers" : "sinks",
                                  1e3 * std::abs(ground.depth), ground.depth < 0. ? "over" : "into",
                                  ground.material, 1e3 * ground.wanted_depth, stiffness));
  const std::string damping = settings(ground, ConstantAdvice::Aim::rebound);
  if (!damping.empty() && ground.rebound &&
      std::abs(*ground.rebound - ground.wanted_rebound) > rebound_tolerance)
    changes.push_back(fmt::format(
        "{} rebounds from {} with {:.2g} of its speed, {:.2g} is wanted: set {} (with "
        "the advised stiffness)",
        ground.robot, ground.material, *ground.rebound, ground.wanted_rebound, damping));
}

void advise_for_advised(const Experiment& experiment, const Advice& advice,
                        std::vector<std::string>& changes) {
  for (const StepAdvice& step : advice.steps) {
    if (step.integrator != experiment.integrator || step.advised >= experiment.deltat) continue;
    changes.push_back(fmt::format(
        "with all advised constants {} needs deltat below {:.3g} s (it is {:.3g} s); allow more "
        "penetration or more rebound to keep the step",
        step.integrator, step.advised, experiment.deltat));
  }
}

}  // namespace

std::vector<std::string> advise_changes(const Experiment& experiment, const Advice& advice) {
  std::vector<std::string> changes;
  advise_step(experiment, advice, changes);
  for (const GroundAdvice& ground : advice.grounds) advise_ground(ground, changes);
  advise_for_advised(experiment, advice, changes);
  return changes;
}

}  // namespace hookpoint::simulation
