#include "control/component.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace hookpoint::control {

PortHandle::PortHandle(Component& owner, PortDescription description)
    : owner_(&owner), port_(owner.ports_.size()), first_(0) {
  const std::string& name = description.name;
  const bool after_open = std::ranges::any_of(owner.ports_, &PortDescription::open);
  if (after_open && description.kind != PortKind::text)
    throw std::logic_error("port '" + name + "' stands after one that is open");
  if (name.empty()) throw std::logic_error("a port has no name");
  if (description.count == 0) throw std::logic_error("port '" + name + "' has no values");
  if (std::any_of(owner.ports_.begin(), owner.ports_.end(),
                  [&name](const PortDescription& port) { return port.name == name; })) {
    throw std::logic_error("two ports are named '" + name + "'");
  }
  if (description.kind == PortKind::text) {
    first_ = owner.texts_.size();
    owner.texts_.emplace_back();
  } else {
    first_ = owner.values_.size();
    owner.values_.resize(first_ + description.count, description.default_value);
    owner.driven_.resize(owner.values_.size(), 0);
  }
  description.first = first_;
  owner.ports_.push_back(std::move(description));
}

PortDescription& PortHandle::description() { return owner_->ports_[port_]; }

Input::Input(Component& owner, std::string name, std::string unit, std::string doc,
             double default_value, std::size_t count)
    : PortHandle(owner, {.kind = PortKind::input,
                         .name = std::move(name),
                         .unit = std::move(unit),
                         .doc = std::move(doc),
                         .default_value = default_value,
                         .count = count}) {}

std::size_t Input::count() const { return owner_->ports_[port_].count; }

bool Input::driven(std::size_t i) const { return owner_->driven_[first_ + i] != 0; }

Input&& Input::attached(std::string port) && {
  description().attached = std::move(port);
  return std::move(*this);
}

Input&& Input::counted_by(std::string name) && {
  description().counted_by = std::move(name);
  return std::move(*this);
}

Input&& Input::mean() && {
  description().mean = true;
  return std::move(*this);
}

Input&& Input::open() && {
  description().open = true;
  return std::move(*this);
}

Parameter::Parameter(Component& owner, std::string name, std::string unit, double default_value,
                     std::string doc, std::size_t count)
    : PortHandle(owner, {.kind = PortKind::parameter,
                         .name = std::move(name),
                         .unit = std::move(unit),
                         .doc = std::move(doc),
                         .default_value = default_value,
                         .count = count}) {}

Parameter&& Parameter::range(double minimum, double maximum) && {
  PortDescription& port = description();
  if (!(minimum <= port.default_value && port.default_value <= maximum)) {
    throw std::logic_error("the default of '" + port.name + "' is outside its range");
  }
  port.minimum = minimum;
  port.maximum = maximum;
  return std::move(*this);
}

Parameter&& Parameter::of_world(WorldValue value) && {
  PortDescription& port = description();
  const std::size_t numbers = value == WorldValue::gravity_sideways ? 2 : 1;
  if (port.count != numbers)
    throw std::logic_error("'" + port.name + "' has not as many values as the World gives it");
  port.world = value;
  return std::move(*this);
}

Parameter&& Parameter::orientation() && {
  if (description().count != 4)
    throw std::logic_error("'" + description().name + "' has not the 4 values of a quaternion");
  description().orientation = true;
  value_at(0) = 1.;
  return std::move(*this);
}

Parameter&& Parameter::counted_by(std::string name) && {
  description().counted_by = std::move(name);
  return std::move(*this);
}

Output::Output(Component& owner, std::string name, std::string unit, std::string doc,
               std::size_t count)
    : PortHandle(owner, {.kind = PortKind::output,
                         .name = std::move(name),
                         .unit = std::move(unit),
                         .doc = std::move(doc),
                         .count = count}) {}

Output&& Output::attached(std::string port) && {
  description().attached = std::move(port);
  return std::move(*this);
}

State::State(Component& owner, std::string name, std::string unit, std::string doc,
             std::size_t count)
    : PortHandle(owner, {.kind = PortKind::state,
                         .name = std::move(name),
                         .unit = std::move(unit),
                         .doc = std::move(doc),
                         .count = count}) {}

State&& State::initial(double value) && {
  PortDescription& port = description();
  port.default_value = value;
  for (std::size_t i = 0; i < port.count; ++i) value_at(i) = value;
  return std::move(*this);
}

Text::Text(Component& owner, std::string name, std::string doc, std::string default_text)
    : PortHandle(owner, {.kind = PortKind::text, .name = std::move(name), .doc = std::move(doc)}) {
  description().default_text = default_text;
  owner_->texts_[first_] = std::move(default_text);
}

const std::string& Text::value() const { return owner_->texts_[first_]; }

Text&& Text::choices(std::vector<std::string> choices) && {
  PortDescription& port = description();
  if (std::find(choices.begin(), choices.end(), port.default_text) == choices.end()) {
    throw std::logic_error("the default of '" + port.name + "' is none of its choices");
  }
  port.choices = std::move(choices);
  return std::move(*this);
}

Text&& Text::path() && {
  description().path = true;
  return std::move(*this);
}

namespace {

/// "name[3]" as name and index; no index where there is none or it is malformed.
std::pair<std::string_view, std::optional<std::size_t>> split_index(std::string_view name) {
  const std::size_t open = name.find('[');
  if (open == std::string_view::npos || name.back() != ']') return {name, std::nullopt};
  const std::string_view digits = name.substr(open + 1, name.size() - open - 2);
  std::size_t index = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, index);
  if (error != std::errc{} || stop != end) return {name, std::nullopt};
  return {name.substr(0, open), index};
}

}  // namespace

void Component::set_open_count(std::size_t count) {
  const auto open = std::ranges::find_if(ports_, &PortDescription::open);
  if (open == ports_.end()) return;
  open->count = std::max<std::size_t>(count, 1);
  values_.resize(open->first + open->count, open->default_value);
  driven_.resize(values_.size(), 0);
}

std::optional<std::size_t> find_value(const Component& component, std::string_view name) {
  const auto [port_name, index] = split_index(name);
  for (const PortDescription& port : component.ports()) {
    if (port.kind == PortKind::text || port.name != port_name) continue;
    if (index.has_value() != (port.count > 1) || index.value_or(0) >= port.count) return {};
    return port.first + index.value_or(0);
  }
  return {};
}

}  // namespace hookpoint::control
