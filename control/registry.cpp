#include "control/registry.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace hookpoint::control {
namespace {

/// Fields of the stub around every component, which no port may hide.
constexpr std::array stub_fields{"rate", "delay", "noise"};

/// A name as the language reads it: a letter or underscore, then digits too.
bool is_identifier(std::string_view name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// Identifiers joined by dots.
bool is_class_name(std::string_view name) {
  for (std::size_t dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
    if (!is_identifier(name.substr(0, dot))) return false;
    name.remove_prefix(dot + 1);
  }
  return is_identifier(name);
}

/// "" or why `name` cannot be a default port of the kinds that `fits` accepts. An array stands for
/// its first value.
template <class Fits>
std::string default_port_problem(const Component& component, const std::string& name, Fits fits) {
  if (name.empty()) return "";
  for (const PortDescription& port : component.ports()) {
    if (port.name == name) {
      return fits(port.kind) ? "" : "the default port '" + name + "' is of the wrong direction";
    }
  }
  return "the default port '" + name + "' does not exist";
}

/// Whether `name` is a parameter of one number.
bool has_counter(const Component& component, const std::string& name) {
  return std::ranges::any_of(component.ports(), [&name](const PortDescription& port) {
    return port.name == name && port.kind == PortKind::parameter && port.count == 1;
  });
}

}  // namespace

Registry& Registry::instance() {
  static Registry registry;
  return registry;
}

void Registry::add(ComponentClass type) {
  type.origin = origin_;
  const std::string name = type.name;
  const auto [place, added] = classes_.try_emplace(name, std::move(type));
  if (added) return;
  const auto from = [](const std::string& origin) {
    return origin.empty() ? std::string("the program") : "'" + origin + "'";
  };
  problems_.push_back("class '" + name + "' of " + from(origin_) +
                      " is refused: " + from(place->second.origin) + " has one of that name");
}

void Registry::remove(const std::string& origin) {
  std::erase_if(classes_, [&origin](const auto& entry) { return entry.second.origin == origin; });
}

const ComponentClass* Registry::find(std::string_view name) const {
  const auto place = classes_.find(name);
  return place == classes_.end() ? nullptr : &place->second;
}

std::string declaration_problem(const ComponentClass& type) {
  if (!is_class_name(type.name)) return "a class is named by identifiers joined by dots";
  try {
    const std::unique_ptr<Component> component = type.make();
    for (const PortDescription& port : component->ports()) {
      if (!is_identifier(port.name))
        return "port '" + port.name + "' is not named by an identifier";
      if (std::find(stub_fields.begin(), stub_fields.end(), port.name) != stub_fields.end()) {
        return "port '" + port.name + "' has the name of a field of the stub";
      }
      if (!port.attached.empty() && type.attachment == Attachment::none) {
        return "port '" + port.name + "' is attached, but the class attaches to nothing";
      }
      if (!port.counted_by.empty() && !has_counter(*component, port.counted_by)) {
        return "port '" + port.name + "' is counted by '" + port.counted_by +
               "', which is no parameter of one number";
      }
    }
    const auto is_input = [](PortKind kind) {
      return kind == PortKind::input || kind == PortKind::parameter;
    };
    const auto is_output = [](PortKind kind) { return kind == PortKind::output; };
    const std::string input = default_port_problem(*component, type.default_input, is_input);
    return input.empty() ? default_port_problem(*component, type.default_output, is_output) : input;
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace hookpoint::control
