// Controllers, sensors, actuators and sources as plain values.
#include <fmt/format.h>

#include "control/registry.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

using control::PortDescription;
using control::PortKind;

void load_text(const language::Object& object, const PortDescription& port, ComponentSpec& spec,
               Loading& loading) {
  if (!object.given(port.name)) return;
  std::string text = object.word(port.name);
  if (port.path && !text.empty()) {
    const std::filesystem::path path = find_file(text, place_of(object, port.name), loading);
    if (path.empty()) return;
    text = std::filesystem::absolute(path).string();
  }
  spec.texts.emplace_back(port.first, std::move(text));
}

/// One number holds for all elements of an array.
void load_numbers(const language::Object& object, const PortDescription& port, ComponentSpec& spec,
                  Loading& loading) {
  if (!object.given(port.name)) return;
  const std::vector<double>& numbers = object.numbers(port.name);
  if (numbers.size() != 1 && numbers.size() != port.count) {
    return loading.error(place_of(object, port.name),
                         fmt::format("`{}` takes one number for all or {} numbers, not {}",
                                     port.name, port.count, numbers.size()));
  }
  for (std::size_t i = 0; i < port.count; ++i)
    spec.values.emplace_back(port.first + i, numbers[numbers.size() == 1 ? 0 : i]);
}

void load_component(const language::Object& object, const control::ComponentClass& type,
                    Loading& loading) {
  ComponentSpec spec;
  spec.trail = loading.trails.at(&object);
  spec.type = type.name;
  if (object.given("rate")) spec.rate = object.number("rate");
  const auto component = type.make();
  for (const PortDescription& port : component->ports()) {
    if (port.kind == PortKind::text) load_text(object, port, spec, loading);
    if (port.kind == PortKind::input || port.kind == PortKind::parameter)
      load_numbers(object, port, spec, loading);
  }
  loading.components.push_back(&object);
  loading.experiment.components.push_back(std::move(spec));
}

}  // namespace

void load_components(const language::Object& parent, Loading& loading) {
  for (const auto& child : parent.children) {
    if (const auto* type = control::Registry::instance().find(child->type))
      load_component(*child, *type, loading);
    load_components(*child, loading);
  }
}

}  // namespace hookpoint::simulation
