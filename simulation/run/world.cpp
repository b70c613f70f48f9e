// One step of a run: sense, wires, controllers, engine, record (docs/wires.md, "One step"). At step
// k, time k dt, between two steps of the engine:
//
//   samples that were under way arrive
//   components that are due update, wires without delay carry values
//   wires with delay sample
//   drives and forces reach the engine
//   row k of the record is written: the state at k dt and every signal as it then is
//   the engine steps to k + 1 with the inputs held
//
// World::update has the first four, World::step the last; the loop around them writes the rows.
#include "simulation/run/world.h"

#include <fmt/format.h>

#include <utility>

#include "simulation/analysis/failure.h"
#include "simulation/analysis/stability.h"
#include "simulation/engine_interface/restartable.h"
#include "simulation/wiring/port_value.h"

namespace hookpoint::simulation {

namespace {

/// What costs something is worked out for those who ask for it, who are yet to come.
std::unique_ptr<Engine> on_demand(std::unique_ptr<Engine> engine) {
  engine->enable_mean_forces(false);
  return engine;
}

/// Whether what acts on the engine may change by itself: by wires, or over a time.
bool inputs_are_driven(const Experiment& experiment) {
  const auto drives = [&](const WireSpec& wire) {
    return std::ranges::none_of(experiment.components, [&](const ComponentSpec& component) {
      return wire.to.starts_with(component.trail + ".");
    });
  };
  return std::ranges::any_of(experiment.wires, drives) ||
         std::ranges::any_of(experiment.forces,
                             [](const ForceSpec& force) { return force.window.has_value(); });
}

}  // namespace

World::World(const Experiment& experiment, std::unique_ptr<Engine> engine)
    : experiment_(experiment),
      engine_(on_demand(std::move(engine))),
      signals_(experiment, *engine_) {
  start_ = status_of_signals(update(signals_));
}

// From row k to row k + 1.
StepStatus World::step() {
  if (!start_.ok()) return start_;
  if (!signals_.running()) return {};

  signals_.begin_step();
  // The engine steps with the inputs held, those that actuate() below left at k. Ours: step.cpp.
  const StepStatus status = engine_->step();
  if (!status.ok()) return with_advice(status, as_it_stands());

  // The signals follow its state at k + 1.
  return status_of_signals(update(signals_));
}

void World::announce(std::int64_t steps) {
  if (!inputs_are_driven(experiment_)) engine_->announce(steps);
}

Experiment World::as_it_stands() const {
  Experiment now = experiment_;
  now.components = signals_.as_held(std::move(now.components));
  return now;
}

bool World::update(Signals& signals) const {
  const std::int64_t k = engine_->state().step;
  signals.sense(k);      // accelerations, contacts and other ports derived from the engine's state
  signals.deliver(k);    // samples that were under way arrive
  signals.propagate(k);  // sensors, controllers and actuators that are due; wires without delay
  signals.sample(k);     // wires with delay sample
  signals.actuate(k);    // drives and forces reach the engine
  return signals.finite();
  // Row k is recorded from the ports as they are now: by who calls step() (records.h).
}

StepStatus World::status_of_signals(bool finite) {
  if (finite) return {};
  StepStatus status = stopped_by_port(engine_->state().time, signals_.first_not_finite());
  const std::string controllers = controller_advice(stability_bound(as_it_stands()));
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
    if (const std::string problem = value_problem(port, value); !problem.empty())
      throw ExperimentError(fmt::format("`{}` {}", port.trail, problem));
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
                        "` cannot be saved and resumed exactly: its library hides what its solver "
                        "remembers; with `engine = dts` it can be saved");
}

std::vector<StateSection> World::layout_of(const Saveable& engine) const {
  std::vector<StateSection> sections{
      {"engine " + experiment_.engine, engine.state_layout(), engine.state_size()}};
  for (StateSection& section : signals_.state_layout()) sections.push_back(std::move(section));
  return sections;
}

void World::save(const Saveable& engine, std::span<double> numbers) const {
  const std::size_t size = engine.state_size();
  engine.save(numbers.first(size));
  signals_.save(numbers.subspan(size));
}

std::vector<StateSection> World::state_layout() const { return layout_of(resumable()); }
std::size_t World::state_size() const { return resumable().state_size() + signals_.state_size(); }
void World::save(std::span<double> numbers) const { save(resumable(), numbers); }

std::vector<StateSection> World::instant_layout() const { return layout_of(*engine_->saveable()); }
std::size_t World::instant_size() const {
  return engine_->saveable()->state_size() + signals_.state_size();
}
void World::save_instant(std::span<double> numbers) const { save(*engine_->saveable(), numbers); }

void World::restore(std::span<const double> numbers) {
  Resumable& engine = resumable();
  const std::size_t size = engine.state_size();
  engine.restore(numbers.first(size));
  signals_.restore(numbers.subspan(size));
}

void World::restart(const Experiment& start) {
  auto* engine = dynamic_cast<Restartable*>(engine_.get());
  if (engine == nullptr)
    throw ExperimentError("engine `" + experiment_.engine + "` cannot go back to time 0");
  engine->restart(start);
  // Controllers and wires take the numbers of new ones at that state.
  Signals fresh(start, *engine_);
  const bool finite = update(fresh);
  std::vector<double> numbers(fresh.state_size());
  fresh.save(numbers);
  signals_.restore(numbers);
  start_ = status_of_signals(finite);
}

}  // namespace hookpoint::simulation
