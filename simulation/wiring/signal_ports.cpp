// The ports of a run that are not the engine's.
#include "simulation/wiring/signals.h"

namespace hookpoint::simulation {
namespace {

Port held_port(std::string trail, std::string unit, double& value, bool writable) {
  Port port;
  port.trail = std::move(trail);
  port.unit = std::move(unit);
  port.value = &value;
  port.writable = writable ? &value : nullptr;
  return port;
}

}  // namespace

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

void Signals::add_component_ports(std::vector<Port>& ports) {
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const std::string trail = experiment_.components[c].trail + ".";
    for (const control::PortDescription& description : components_[c].ports()) {
      if (description.kind == control::PortKind::text) continue;
      const bool computed = description.kind == control::PortKind::output ||
                            description.kind == control::PortKind::state;
      for (std::size_t i = 0; i < description.count; ++i) {
        Port port = held_port(trail + description.name + element_suffix(description, i),
                              description.unit == "?" ? "" : description.unit,
                              components_[c].values()[description.first + i], !computed);
        port.doc = description.doc;
        port.minimum = description.minimum;
        port.maximum = description.maximum;
        ports.push_back(std::move(port));
      }
    }
  }
}

}  // namespace hookpoint::simulation
