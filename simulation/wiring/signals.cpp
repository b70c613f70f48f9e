#include "simulation/wiring/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <unordered_map>
#include <utility>

#include "control/data/table.h"
#include "simulation/wiring/force_window.h"
#include "simulation/wiring/measured_section.h"
#include "text/units.h"

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

Port held_port(std::string trail, std::string unit, double& value, bool writable) {
  Port port;
  port.trail = std::move(trail);
  port.unit = std::move(unit);
  port.value = &value;
  port.writable = writable ? &value : nullptr;
  return port;
}

std::string layout_of(const control::Component& component) {
  std::string layout;
  for (const control::PortDescription& port : component.ports()) {
    if (port.kind != control::PortKind::text)
      layout += fmt::format("{}[{}] ", port.name, port.count);
  }
  return layout + "updates last_update";
}

}  // namespace

Signals::Signals(const Experiment& experiment, Engine& engine)
    : experiment_(experiment),
      engine_(engine),
      derived_(experiment, engine),
      components_(experiment),
      pull_(experiment) {
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
  find_held_lines();
  watch_values();
}

void Signals::find_held_lines() {
  std::vector<bool> held(lines_.size(), false);
  std::unordered_map<const double*, std::size_t> by_end;
  for (std::size_t i = 0; i < lines_.size(); ++i) by_end.emplace(lines_[i].to, i);
  for (const WiringItem& item : order_) {
    if (!item.is_wire) continue;
    const Line& line = lines_[item.index];
    const auto driver = by_end.find(line.from);
    const bool still = driver == by_end.end() || held[driver->second];
    held[item.index] = line.copies && line.starts_at_input && still;
    if (held[item.index]) held_lines_.push_back(item.index);
  }
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
      const bool copies = line.copies();
      lines_.push_back(
          {from->value, to->writable, copies, std::move(line), from->writable != nullptr});
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw ExperimentError("the wire from `" + wire.from + "` to `" + wire.to +
                            "`: " + error.what());
    }
    if (lines_.back().line.delayed()) delayed_.push_back(lines_.size() - 1);
  }
}

void Signals::sense(std::int64_t step) {
  held_.step = static_cast<double>(step);
  held_.impacts = static_cast<double>(engine_.state().impacts);
  derived_.update();
}

void Signals::deliver(std::int64_t step) {
  for (const std::size_t i : delayed_) *lines_[i].to = lines_[i].line.deliver(step);
}

void Signals::propagate(std::int64_t step) {
  const double time = engine_.state().time;
  for (const WiringItem& item : order_) {
    if (item.is_wire) {
      Line& line = lines_[item.index];
      // A sample is the value and its noise: of -0 and none it is 0.
      *line.to = line.copies ? *line.from + 0. : line.line.at(step, *line.from);
    } else {
      update_component(item.index, step, time);
    }
  }
}

void Signals::sample(std::int64_t step) {
  for (const std::size_t i : delayed_) lines_[i].line.sample(step, *lines_[i].from);
}

bool Signals::finite() const {
  // Of finite numbers it is 0; one that is not finite makes it NaN.
  double nothing = 0.;
  for (const double* value : watched_) nothing += 0. * *value;
  return nothing == 0. && derived_.finite();
}

std::vector<Port> Signals::settable() {
  std::vector<Port> settable = ports();
  std::erase_if(settable, [this](const Port& port) {
    return port.writable == nullptr ||
           std::ranges::find(lines_, port.writable, &Line::to) != lines_.end();
  });
  return settable;
}

std::optional<Port> Signals::input(std::string_view trail) {
  if (all_ports_.empty()) all_ports_ = ports();
  std::optional<Port> port = look_up_port(experiment_, all_ports_, trail);
  if (port && port->writable == nullptr) port.reset();
  return port;
}

Port Signals::settable(std::string_view trail) {
  if (all_ports_.empty()) all_ports_ = ports();
  Port port = find_port(experiment_, all_ports_, trail);
  if (port.writable == nullptr)
    throw ExperimentError(fmt::format("`{}` follows from the run: nobody sets it", port.trail));
  const auto line = std::ranges::find(lines_, port.writable, &Line::to);
  if (line == lines_.end()) return port;
  const WireSpec& wire = experiment_.wires[static_cast<std::size_t>(line - lines_.begin())];
  throw ExperimentError(
      fmt::format("`{}` is set by the wire from `{}`: {}", port.trail, wire.from,
                  line->starts_at_input ? "set that instead" : "nobody else sets it"));
}

void Signals::follow() {
  for (const std::size_t i : held_lines_) *lines_[i].to = *lines_[i].from + 0.;
  actuate(engine_.state().step);
}

std::vector<ComponentSpec> Signals::as_held(std::vector<ComponentSpec> specs) const {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const auto& values = components_[i].values();
    specs[i].values.clear();
    for (std::size_t index = 0; index < values.size(); ++index)
      if (std::isfinite(values[index])) specs[i].values.emplace_back(index, values[index]);
  }
  return specs;
}

bool Signals::sampled_after(std::int64_t step, const double* value) const {
  return std::ranges::all_of(lines_, [&](const Line& line) {
    return line.from != value || line.line.last_sample(engine_.state().step) > step;
  });
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

void Signals::actuate(std::int64_t step) {
  pull_.act(engine_.state(), engine_.inputs().pull);
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

// The ports of a run that are not the engine's.

std::vector<Port> Signals::ports() {
  std::vector<Port> ports = list_ports(experiment_, engine_, derived_);
  add_held_ports(ports);
  add_component_ports(ports);
  if (!experiment_.values) return ports;
  // After the others: a value that the engine computes hides the one that the file gave it.
  for (std::size_t i = 0; i < held_.values.size(); ++i) {
    const ValueSpec& value = (*experiment_.values)[i];
    ports.push_back(held_port(value.trail, value.unit, held_.values[i], value.writable));
  }
  return ports;
}

void Signals::add_held_ports(std::vector<Port>& ports) {
  const std::string world = experiment_.world + ".";
  ports.push_back(held_port(world + "step", "", held_.step, false));
  ports.push_back(held_port(world + "impacts", "", held_.impacts, false));
  ports.push_back(held_port(world + "running", "", held_.running, true));
  ports.push_back(held_port("Simulator.quit", "", held_.quit, true));
  pull_.add_ports(ports);
  for (std::size_t i = 0; i < held_.forces.size(); ++i) {
    const std::string trail = world + experiment_.forces[i].name + ".";
    const auto add = [&](const std::string& name, const char* unit, Vector3d& v) {
      ports.push_back(held_port(trail + name + ".x", unit, v.x, true));
      ports.push_back(held_port(trail + name + ".y", unit, v.y, true));
      ports.push_back(held_port(trail + name + ".z", unit, v.z, true));
    };
    add("point", "m", held_.forces[i].point);
    add("force", "N", held_.forces[i].force);
    add("torque", "N.m", held_.forces[i].torque);
    ports.push_back(held_port(trail + "envelope", "", held_.envelopes[i], false));
  }
}

namespace {

/// The unit of an element of an output: the class's, or that of the table which it reads.
std::string unit_of_element(const control::Component& component,
                            const control::PortDescription& port, std::size_t element) {
  if (port.unit != "?") return port.unit;
  const auto* table = dynamic_cast<const control::ReadsTable*>(&component);
  if (table == nullptr) return "";
  for (const control::TableReport::Unit& unit : table->report().units)
    if (unit.output == port.name && unit.element == element) return text::unit_text(unit.dimension);
  return "";
}

}  // namespace

void Signals::add_component_ports(std::vector<Port>& ports) {
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const std::string trail = experiment_.components[c].trail + ".";
    for (const control::PortDescription& description : components_[c].ports()) {
      if (description.kind == control::PortKind::text) continue;
      const bool computed = description.kind == control::PortKind::output ||
                            description.kind == control::PortKind::state;
      for (std::size_t i = 0; i < description.count; ++i) {
        Port port = held_port(trail + description.name + element_suffix(description, i),
                              unit_of_element(components_[c], description, i),
                              components_[c].values()[description.first + i], !computed);
        port.doc = description.doc;
        port.minimum = description.minimum;
        port.maximum = description.maximum;
        ports.push_back(std::move(port));
      }
    }
  }
}

// What the signals carry from one step to the next: ports that hold what was written, the
// components' values, and what is under way on the wires. Random numbers need nothing: each follows
// from its stream's key and its count (control/random.h).

/// The values of the file that nothing can write stay as they are; `envelopes` and what acts follow
/// from the step.
template <class Self, class Archive>
void Signals::exchange(Self& self, Archive& archive) {
  archive("running", self.held_.running);
  archive("quit", self.held_.quit);
  archive("joint_torque", self.engine_.inputs().joint_torques);
  archive("gravity", self.engine_.inputs().gravity);
  archive.each("force", self.held_.forces, [](auto& force, auto& part) {
    part("point", force.point);
    part("force", force.force);
    part("torque", force.torque);
  });
  for (std::size_t i = 0; i < self.held_.values.size(); ++i) {
    if ((*self.experiment_.values)[i].writable) archive("value", self.held_.values[i]);
  }
  Pull::exchange(self.pull_, archive);
}

std::vector<StateSection> Signals::state_layout() const {
  StateCount held;
  StateLayout layout;
  exchange(*this, held);
  exchange(*this, layout);
  const EnergyBalance& balance = derived_.balance();
  std::vector<StateSection> sections{
      {"signals", layout.text(), held.count()},
      {std::string(measured_section), simulation::layout_of(balance), count_of(balance)}};
  for (std::size_t i = 0; i < components_.size(); ++i) {
    sections.push_back({experiment_.components[i].trail, layout_of(components_[i]),
                        components_[i].values().size() + 2});
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const WireSpec& wire = experiment_.wires[i];
    if (const std::size_t size = lines_[i].line.state_size(); size > 0) {
      sections.push_back(
          {fmt::format("wire {} -> {}", wire.from, wire.to), lines_[i].line.state_layout(), size});
    }
  }
  return sections;
}

std::size_t Signals::state_size() const {
  std::size_t size = 0;
  for (const StateSection& section : state_layout()) size += section.size;
  return size;
}

void Signals::save(std::span<double> numbers) const {
  StateCount held;
  exchange(*this, held);
  StateSaver saver(numbers);
  exchange(*this, saver);
  std::span<double> left = numbers.subspan(held.count());
  save_to(left, derived_.balance());
  left = left.subspan(count_of(derived_.balance()));
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const std::span<const double> values = components_[i].values();
    std::ranges::copy(values, left.begin());
    left = left.subspan(values.size());
    left[0] = static_cast<double>(updates_[i].count);
    left[1] = updates_[i].last;
    left = left.subspan(2);
  }
  for (const Line& line : lines_) {
    line.line.save(left.first(line.line.state_size()));
    left = left.subspan(line.line.state_size());
  }
}

void Signals::restore(std::span<const double> numbers) {
  const std::int64_t step = engine_.state().step;
  StateCount held;
  exchange(*this, held);
  StateRestorer restorer(numbers);
  exchange(*this, restorer);
  std::span<const double> left = numbers.subspan(held.count());
  restore_from(left, derived_.balance());
  left = left.subspan(count_of(derived_.balance()));
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const std::span<double> values = components_[i].values();
    std::ranges::copy(left.first(values.size()), values.begin());
    left = left.subspan(values.size());
    updates_[i].count = static_cast<std::int64_t>(left[0]);
    updates_[i].schedule.resume(updates_[i].count);
    updates_[i].last = left[1];
    left = left.subspan(2);
  }
  for (Line& line : lines_) {
    line.line.restore(step, left.first(line.line.state_size()));
    left = left.subspan(line.line.state_size());
  }
  held_.step = static_cast<double>(step);
  held_.impacts = static_cast<double>(engine_.state().impacts);
  actuate(step);
  derived_.restart();
}

}  // namespace hookpoint::simulation
