#include "studies/measure/signal.h"

#include <algorithm>
#include <array>

namespace hookpoint::studies {

namespace {

double downhill_displacement(const RunContext&, const Observation& observation) {
  return observation.displacement;
}
double downhill_speed(const RunContext& context, const Observation& observation) {
  return dot(observation.body.velocity, context.downhill);
}
double deepest(const RunContext&, const Observation& observation) {
  double depth = 0.;
  for (const PointObservation& point : observation.points) depth = std::max(depth, point.depth);
  return depth;
}
double energy_of_robot(const RunContext& context, const Observation& observation) {
  return mechanical_energy(context, observation.world);
}

constexpr auto signals = std::to_array<SignalDefinition>({
    {.name = "displacement",
     .unit = "m",
     .doc = "downhill displacement of the body's origin",
     .value = downhill_displacement},
    {.name = "drift",
     .unit = "m",
     .doc = "downhill displacement of the body's origin since `settle`",
     .value = downhill_displacement,
     .since_settle = true},
    {.name = "speed",
     .unit = "m/s",
     .doc = "downhill velocity of the body's origin",
     .value = downhill_speed},
    {.name = "penetration",
     .unit = "m",
     .doc = "depth of the deepest boundary point",
     .value = deepest,
     .needs_points = true},
    {.name = "energy",
     .unit = "J",
     .doc = "kinetic and gravitational energy",
     .value = energy_of_robot},
});

}  // namespace

std::span<const SignalDefinition> signal_table() { return signals; }

const SignalDefinition* find_signal(std::string_view name) {
  for (const SignalDefinition& signal : signals)
    if (signal.name == name) return &signal;
  return nullptr;
}

}  // namespace hookpoint::studies
