#include "studies/run/stance_ports.h"

#include <fmt/format.h>

#include <map>
#include <string>

namespace hookpoint::studies {

std::vector<const double*> stance_ports(const RunContext& context, simulation::World& world) {
  const std::size_t chains = context.robot_spec().chains.size();
  if (chains == 0) return {};
  const std::vector<simulation::Port> ports = world.ports();
  std::map<std::string, const double*, std::less<>> by_trail;
  for (const simulation::Port& port : ports) by_trail.emplace(port.trail, port.value);
  for (const simulation::ComponentSpec& component : context.experiment->components) {
    std::vector<const double*> stance;
    for (std::size_t i = 0; i < chains; ++i) {
      const auto found = by_trail.find(fmt::format("{}.stance[{}]", component.trail, i));
      if (found != by_trail.end()) stance.push_back(found->second);
    }
    const bool more = by_trail.contains(fmt::format("{}.stance[{}]", component.trail, chains));
    if (stance.size() == chains && !more) return stance;
  }
  return {};
}

}  // namespace hookpoint::studies
