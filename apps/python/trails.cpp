#include "apps/python/trails.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "apps/python/errors.h"

namespace hookpoint::python {
namespace {

/// Whether the ends of a wire named by these trails are one port, or one is a part of the other.
bool same_port(const std::string& a, const std::string& b) {
  const std::string& shorter = a.size() < b.size() ? a : b;
  const std::string& longer = a.size() < b.size() ? b : a;
  return longer.starts_with(shorter) &&
         (longer.size() == shorter.size() || longer[shorter.size()] == '.');
}

/// ".x" or "[7]".
bool names_element(std::string_view suffix) {
  if (suffix.size() == 2 && suffix[0] == '.')
    return std::string_view("wxyz").find(suffix[1]) != std::string_view::npos;
  if (suffix.size() < 3 || suffix.front() != '[' || suffix.back() != ']') return false;
  return suffix.substr(1, suffix.size() - 2).find_first_not_of("0123456789") ==
         std::string_view::npos;
}

std::vector<simulation::Port> elements_of(const std::vector<simulation::Port>& ports,
                                          const std::string& trail) {
  std::vector<simulation::Port> elements;
  for (const simulation::Port& port : ports) {
    if (!port.trail.starts_with(trail)) continue;
    if (!names_element(std::string_view(port.trail).substr(trail.size()))) continue;
    // The first of a trail hides later ones.
    if (std::ranges::find(elements, port.trail, &simulation::Port::trail) != elements.end())
      continue;
    elements.push_back(port);
  }
  return elements;
}

}  // namespace

std::vector<simulation::Port> ports_of(const simulation::Experiment& experiment,
                                       const std::vector<simulation::Port>& ports,
                                       const std::string& trail) {
  if (auto port = simulation::look_up_port(experiment, ports, trail)) return {std::move(*port)};
  for (const std::string& whole : {trail, experiment.world + "." + trail}) {
    std::vector<simulation::Port> elements = elements_of(ports, whole);
    if (elements.empty()) continue;
    for (const simulation::Port& element : elements) {
      if (element.lazy != nullptr) element.lazy->begin();
    }
    return elements;
  }
  return {simulation::find_port(experiment, ports, trail)};
}

const simulation::WireSpec* wire_to(const simulation::Experiment& experiment,
                                    const simulation::Port& port) {
  const auto wire = std::ranges::find_if(experiment.wires, [&](const simulation::WireSpec& each) {
    return same_port(each.to, port.trail);
  });
  return wire == experiment.wires.end() ? nullptr : &*wire;
}

void require_writable(const simulation::Experiment& experiment, const simulation::Port& port) {
  if (port.writable == nullptr)
    throw_error(fmt::format("`{}` can be read, not written: inputs can, such as a joint's torque",
                            port.trail));
  if (const simulation::WireSpec* wire = wire_to(experiment, port))
    throw_error(
        fmt::format("`{}` is driven by a wire from `{}`: write that, or leave the wire out of the "
                    "file",
                    port.trail, wire->from));
}

}  // namespace hookpoint::python
