#include "simulation/wiring/components.h"

#include <exception>
#include <new>

#include "control/random.h"
#include "control/registry.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/wiring/timing.h"

namespace hookpoint::simulation {
namespace {

/// Of the elements of short lists of a fixed length and of orientations, in their order; "" of other
/// ports.
std::string_view letters_of(const control::PortDescription& port) {
  if (port.orientation) return "wxyz";
  return !port.open && (port.count == 2 || port.count == 3) ? "xyz" : "";
}

/// Index among the component's values of "goal", "goal[3]" or "gyroscope.x".
std::optional<std::size_t> find_element(const control::Component& component,
                                        std::string_view name) {
  if (const auto found = control::find_value(component, name)) return found;
  if (name.size() < 2 || name[name.size() - 2] != '.') return std::nullopt;
  const char letter = name.back();
  name.remove_suffix(2);
  for (const control::PortDescription& port : component.ports()) {
    if (port.kind == control::PortKind::text || port.name != name) continue;
    const std::size_t element = letters_of(port).find(letter);
    if (element < port.count) return port.first + element;
  }
  return std::nullopt;
}

bool is_computed(const control::Component& component, std::size_t index) {
  for (const control::PortDescription& port : component.ports()) {
    if (port.kind == control::PortKind::text || index < port.first ||
        index >= port.first + port.count)
      continue;
    return port.kind == control::PortKind::output || port.kind == control::PortKind::state;
  }
  return false;
}

void take_from_world(const control::PortDescription& port, const Vector3d& gravity,
                     std::span<double> values) {
  using control::WorldValue;
  if (port.world == WorldValue::gravity_down) values[port.first] = -gravity.z;
  if (port.world == WorldValue::gravity_sideways) {
    values[port.first] = gravity.x;
    values[port.first + 1] = gravity.y;
  }
}

}  // namespace

std::string element_suffix(const control::PortDescription& port, std::size_t index) {
  if (port.count == 1) return "";
  if (!letters_of(port).empty()) return {'.', letters_of(port)[index]};
  return '[' + std::to_string(index) + ']';
}

Components::Components(const Experiment& experiment) {
  for (const ComponentSpec& spec : experiment.components) {
    const control::ComponentClass* type = control::Registry::instance().find(spec.type);
    if (type == nullptr) throw ExperimentError("there is no component class `" + spec.type + "`");
    control::Component& component = *components_.emplace_back(type->make());
    component.set_open_count(spec.open_inputs);
    for (const control::PortDescription& port : component.ports())
      take_from_world(port, experiment.gravity, component.values());
    for (const auto& [index, value] : spec.values) component.values()[index] = value;
    for (const auto& [index, text] : spec.texts) component.texts()[index] = text;
    by_trail_.emplace(spec.trail, by_trail_.size());
  }
  for (const WireSpec& wire : experiment.wires) {
    if (const auto to = find(wire.to)) components_[to->component]->set_driven(to->index, true);
  }
}

std::vector<StartProblem> Components::start(const Experiment& experiment) {
  std::vector<StartProblem> problems;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const ComponentSpec& spec = experiment.components[i];
    components_[i]->set_stream(control::stream_key(experiment.seed, spec.trail));
    try {
      components_[i]->start(update_schedule(spec, experiment.deltat).period());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      problems.push_back({i, error.what()});
    }
  }
  return problems;
}

std::optional<ComponentValue> Components::find(std::string_view trail) const {
  for (std::size_t dot = trail.find('.'); dot != std::string_view::npos;
       dot = trail.find('.', dot + 1)) {
    const auto found = by_trail_.find(trail.substr(0, dot));
    if (found == by_trail_.end()) continue;
    const control::Component& component = *components_[found->second];
    const auto index = find_element(component, trail.substr(dot + 1));
    if (index) return ComponentValue{found->second, *index, is_computed(component, *index)};
  }
  return std::nullopt;
}

}  // namespace hookpoint::simulation
