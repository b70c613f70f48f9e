// The closed form of the threshold of slip.
#include <cmath>

#include "contact/bisect.h"
#include "contact/force_law.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using Constants = contact::MaterialConstants<double>;

/// Tangent of the steepest slope on which the law creeps no faster than `onset_speed`.
double steepest_hold(const contact::AnyForceLaw& law, const Constants& material) {
  const auto fast = [&](double tangent) {
    const std::optional<double> speed = contact::creep_speed(law, tangent, material);
    return !speed || *speed > onset_speed;
  };
  const double friction = material.static_friction;
  if (!fast(friction)) return friction;
  return contact::bisect([&](double tangent) { return fast(tangent) ? 1. : -1.; }, 0., friction);
}

/// Between impacts 2 u0/g apart nothing holds the body, so that it reaches 2 u0 tan.
bool hops_fast(const Constants& material) {
  return 2. * material.rebound_speed * material.static_friction >= onset_speed;
}

}  // namespace

std::optional<double> slip_onset(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  if (!context.ground || experiment.robots.size() != 1 || !robot.chains.empty() ||
      robot.plane_normal)
    return std::nullopt;
  const auto material = static_cast<std::size_t>(context.ground->query(context.start).material);
  const Constants& constants = experiment.materials[material].constants;
  const auto law = contact::find_force_law(experiment.contact);
  if (experiment.engine != "dts" || (!law && !hops_fast(constants)))
    return std::atan(constants.static_friction);
  return law ? std::optional(std::atan(steepest_hold(*law, constants))) : std::nullopt;
}

std::optional<double> threshold_error(const RunContext& context) {
  const std::optional<double> onset = slip_onset(context), friction = static_friction(context);
  return onset && friction ? std::optional(*onset - std::atan(*friction)) : std::nullopt;
}

}  // namespace hookpoint::studies
