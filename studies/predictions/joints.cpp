// The closed form of a walking robot whose joint loops are unstable.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "simulation/wiring/components.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using simulation::ComponentSpec;
using simulation::Experiment;

/// The greatest of a list that the component at `trail` holds under `name`.
double greatest(simulation::Components& components, const std::string& trail,
                const std::string& name) {
  double value = -std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    const auto element = components.find(trail + "." + name + "[" + std::to_string(i) + "]");
    if (!element) return value;
    value = std::max(value, components.value(*element));
  }
}

double least_damping(const simulation::RobotSpec& robot) {
  double damping = std::numeric_limits<double>::infinity();
  simulation::for_each_link(
      robot, [&](const simulation::TreeLink& at) { damping = std::min(damping, at.link.damping); });
  return damping;
}

/// The longest delay on wires that end (begin) at `port` of the component.
double delay_to(const Experiment& experiment, const std::string& port) {
  double delay = 0.;
  for (const simulation::WireSpec& wire : experiment.wires)
    if (wire.to.starts_with(port)) delay = std::max(delay, wire.delay);
  return delay;
}
double delay_from(const Experiment& experiment, const std::string& port) {
  double delay = 0.;
  for (const simulation::WireSpec& wire : experiment.wires)
    if (wire.from.starts_with(port)) delay = std::max(delay, wire.delay);
  return delay;
}

}  // namespace

Prediction predicted::fell(const RunContext& context, const PeerContact&) {
  const Experiment& experiment = *context.experiment;
  const auto spec = std::find_if(
      experiment.components.begin(), experiment.components.end(),
      [](const ComponentSpec& component) { return component.type == "Controller.JointPD"; });
  if (spec == experiment.components.end())
    return NoClosedForm{"no Controller.JointPD moves the joints"};
  simulation::Components components(experiment);
  const double damping = least_damping(context.robot_spec());
  if (!(damping > 0.) || !std::isfinite(damping))
    return NoClosedForm{"a joint has no damping: its inertia counts"};
  if (greatest(components, spec->trail, "dconstant") != 0.)
    return NoClosedForm{spec->trail + " has a dconstant"};
  if (delay_from(experiment, spec->trail + ".torque") != 0.)
    return NoClosedForm{"the torques of " + spec->trail + " come late"};
  const double gain = greatest(components, spec->trail, "pconstant") / damping;
  const double period =
      spec->rate ? std::max(1. / *spec->rate, experiment.deltat) : experiment.deltat;
  const double periods = delay_to(experiment, spec->trail + ".angle") / period;
  const double samples = std::ceil(periods * (1. - 1e-9));
  const double bound = 2. * std::sin(std::numbers::pi / (2. * (2. * samples + 1.)));
  return gain * period < bound ? 0. : 1.;
}

}  // namespace hookpoint::studies
