#include "simulation/run/world.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "output/text/number.h"
#include "simulation/analysis/failure.h"
#include "simulation/analysis/stability.h"

namespace hookpoint::simulation {

namespace {

/// What costs something is worked out for those who ask for it, who are yet to come.
std::unique_ptr<Engine> on_demand(std::unique_ptr<Engine> engine) {
  engine->publish_contact_forces(false);
  return engine;
}

}  // namespace

World::World(const Experiment& experiment, std::unique_ptr<Engine> engine)
    : experiment_(experiment),
      engine_(on_demand(std::move(engine))),
      signals_(experiment, *engine_) {
  start_ = update_signals();
}

StepStatus World::step() {
  if (!start_.ok()) return start_;
  if (!signals_.running()) return {};
  const StepStatus status = engine_->step();
  return status.ok() ? update_signals() : with_advice(status, experiment_);
}

StepStatus World::update_signals() {
  if (signals_.update(engine_->state().step)) return {};
  StepStatus status = stopped_by_port(engine_->state().time, signals_.first_not_finite());
  const std::string controllers = controller_advice(stability_bound(experiment_));
  if (!controllers.empty()) status.advice = "it is no longer a finite number: " + controllers;
  return status;
}

StepStatus stopped_by_port(double time, const std::string& trail) {
  return {StepStatus::Kind::not_finite, time, trail,
          "it is no longer a finite number: look at the gains, amplitudes and noise of what leads "
          "to it"};
}

std::vector<Port> World::settable(std::span<const PortValue> values) {
  std::vector<Port> ports;
  for (const auto& [trail, value] : values) {
    const Port& port = ports.emplace_back(signals_.settable(trail));
    if (!std::isfinite(value))
      throw ExperimentError(fmt::format("`{}` takes a finite number", port.trail));
    if (value < port.minimum || value > port.maximum)
      throw ExperimentError(fmt::format(
          "`{}` takes numbers from {} to {}, not {}", port.trail, output::rounded(port.minimum, 6),
          output::rounded(port.maximum, 6), output::rounded(value, 6)));
  }
  return ports;
}

void World::set(const Port& port, double value) {
  *port.writable = value;
  signals_.follow();
}

std::string World::ended() const {
  if (signals_.quit()) return "Simulator.quit is true";
  if (!signals_.running())
    return "World.running is false, and nothing can set it true again while time stands still";
  return "";
}

Resumable& World::resumable() const {
  if (Resumable* resumable = engine_->resumable()) return *resumable;
  throw ExperimentError("engine `" + experiment_.engine +
                        "` cannot be saved and resumed exactly, so there is no movie or film of "
                        "its run: its library hides what its solver remembers; `hookpoint view` "
                        "shows the run in a window, and with `engine = dts` it can be saved");
}

std::vector<StateSection> World::state_layout() const {
  const Resumable& engine = resumable();
  std::vector<StateSection> sections{
      {"engine " + experiment_.engine, engine.state_layout(), engine.state_size()}};
  for (StateSection& section : signals_.state_layout()) sections.push_back(std::move(section));
  return sections;
}

std::size_t World::state_size() const { return resumable().state_size() + signals_.state_size(); }

void World::save(std::span<double> numbers) const {
  const Resumable& engine = resumable();
  const std::size_t size = engine.state_size();
  engine.save(numbers.first(size));
  signals_.save(numbers.subspan(size));
}

void World::restore(std::span<const double> numbers) {
  Resumable& engine = resumable();
  const std::size_t size = engine.state_size();
  engine.restore(numbers.first(size));
  signals_.restore(numbers.subspan(size));
}

}  // namespace hookpoint::simulation
