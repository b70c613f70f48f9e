#include "simulation/wiring/signals.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <unordered_map>
#include <utility>

#include "simulation/wiring/force_window.h"

namespace hookpoint::simulation {
namespace {

using PortsByTrail = std::unordered_map<std::string_view, const Port*>;

const Port& port_of(const PortsByTrail& ports, const std::string& trail) {
  const auto found = ports.find(trail);
  if (found == ports.end())
    throw ExperimentError("a wire or an attachment needs the port `" + trail +
                          "`, which does not exist");
  return *found->second;
}

}  // namespace

Signals::Signals(const Experiment& experiment, Engine& engine)
    : experiment_(experiment),
      engine_(engine),
      derived_(experiment, engine),
      components_(experiment) {
  for (const ForceSpec& force : experiment.forces)
    held_.forces.push_back({force.point, force.force, force.torque});
  held_.envelopes.resize(experiment.forces.size(), 1.);
  if (experiment.values) {
    for (const ValueSpec& value : *experiment.values)
      held_.values.push_back(value.value.value_or(0.));
  }
  for (const ComponentSpec& component : experiment.components)
    updates_.push_back({update_schedule(component, experiment.deltat)});
  for (const StartProblem& problem : components_.start(experiment))
    throw ExperimentError(experiment.components[problem.component].trail + ": " + problem.message);
  if (!experiment.wires.empty()) connect(ports());
  const WiringOrder order = order_wiring(experiment, components_);
  if (!order.loop.empty()) throw ExperimentError("wires without delay form a loop");
  order_ = order.items;
  watch_values();
}

void Signals::watch_values() {
  for (const Line& line : lines_) watched_.push_back(line.to);
  for (std::size_t c = 0; c < components_.size(); ++c) {
    for (const control::PortDescription& port : components_[c].ports()) {
      if (port.kind != control::PortKind::output) continue;
      for (std::size_t i = 0; i < port.count; ++i)
        watched_.push_back(&components_[c].values()[port.first + i]);
    }
  }
}

void Signals::connect(const std::vector<Port>& ports) {
  PortsByTrail by_trail;
  for (const Port& port : ports) by_trail.emplace(port.trail, &port);
  const auto ends = [&](const WireSpec& wire) {
    return std::pair{&port_of(by_trail, wire.from), &port_of(by_trail, wire.to)};
  };
  // A slider that states no value stands where the input that it sets stands.
  for (std::size_t i = 0; i < held_.values.size(); ++i) {
    const ValueSpec& value = (*experiment_.values)[i];
    if (value.value) continue;
    const auto wire = std::ranges::find(experiment_.wires, value.trail, &WireSpec::from);
    if (wire != experiment_.wires.end()) held_.values[i] = *ends(*wire).second->value;
  }
  for (const WireSpec& wire : experiment_.wires) {
    const auto [from, to] = ends(wire);
    if (from->lazy != nullptr) from->lazy->begin();
    if (to->writable == nullptr) throw ExperimentError("no wire can end at `" + wire.to + "`");
    try {
      control::TransmissionLine line = transmission_line(wire, experiment_, *to->value);
      lines_.push_back({from->value, to->writable, line.copies(), std::move(line)});
    } catch (const std::exception& error) {
      throw ExperimentError("the wire from `" + wire.from + "` to `" + wire.to +
                            "`: " + error.what());
    }
    if (lines_.back().line.delayed()) delayed_.push_back(lines_.size() - 1);
  }
}

bool Signals::update(std::int64_t step) {
  const double time = engine_.state().time;
  held_.step = static_cast<double>(step);
  held_.impacts = static_cast<double>(engine_.state().impacts);
  derived_.update();
  for (const std::size_t i : delayed_) *lines_[i].to = lines_[i].line.deliver(step);
  for (const WiringItem& item : order_) {
    if (item.is_wire) {
      Line& line = lines_[item.index];
      // A sample is the value and its noise: of -0 and none it is 0.
      *line.to = line.copies ? *line.from + 0. : line.line.at(step, *line.from);
    } else {
      update_component(item.index, step, time);
    }
  }
  for (const std::size_t i : delayed_) lines_[i].line.sample(step, *lines_[i].from);
  apply_forces(step);
  // Of finite numbers it is 0; one that is not finite makes it NaN.
  double nothing = 0.;
  for (const double* value : watched_) nothing += 0. * *value;
  return nothing == 0. && derived_.finite();
}

std::string Signals::first_not_finite() {
  for (const Port& port : ports()) {
    if (!std::isfinite(*port.value)) return port.trail;
  }
  return "";
}

void Signals::update_component(std::size_t index, std::int64_t step, double time) {
  Updates& updates = updates_[index];
  if (!updates.schedule.due(step)) return;
  const double period = updates.count == 0 ? updates.schedule.period() : time - updates.last;
  components_[index].update({time, period, updates.count});
  updates.last = time;
  ++updates.count;
}

void Signals::apply_forces(std::int64_t step) {
  std::vector<ForceInput>& acting = engine_.inputs().forces;
  for (std::size_t i = 0; i < acting.size(); ++i) {
    const ForceInput& whole = held_.forces[i];
    acting[i] = whole;
    const std::optional<ForceWindow>& window = experiment_.forces[i].window;
    if (!window) continue;
    const double part = envelope(*window, step, experiment_.deltat);
    held_.envelopes[i] = part;
    acting[i].force = part * whole.force;
    acting[i].torque = part * whole.torque;
  }
}

}  // namespace hookpoint::simulation
