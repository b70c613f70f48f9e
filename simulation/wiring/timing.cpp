#include "simulation/wiring/timing.h"

namespace hookpoint::simulation {
namespace {

using control::Rational;

std::optional<Rational> exact(const std::optional<double>& rate) {
  return rate ? std::optional(Rational::from(*rate)) : std::nullopt;
}

}  // namespace

control::Schedule update_schedule(const ComponentSpec& component, double deltat) {
  return {exact(component.rate), Rational::from(deltat)};
}

control::TransmissionLine transmission_line(const WireSpec& wire, const Experiment& experiment,
                                            double initial) {
  control::LineDescription line;
  line.rate = exact(wire.rate);
  line.delay = Rational::from(wire.delay);
  line.noise = wire.noise;
  line.stream_seed = control::stream_key(experiment.seed, wire.from + " -> " + wire.to);
  line.initial = initial;
  line.mean = wire.mean;
  return {line, Rational::from(experiment.deltat)};
}

}  // namespace hookpoint::simulation
