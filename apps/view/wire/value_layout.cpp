#include "apps/view/wire/value_layout.h"

#include <limits>
#include <utility>

#include "simulation/wiring/port_search.h"
#include "text/json.h"

namespace hookpoint::view {

std::optional<simulation::Port> begin_port(const simulation::Experiment& experiment,
                                           const std::vector<simulation::Port>& ports,
                                           const std::string& trail) {
  auto port = simulation::look_up_port(experiment, ports, trail);
  if (port && port->lazy != nullptr) port->lazy->begin();
  return port;
}

void ValueLayout::lay_out(std::vector<std::string> trails, const simulation::Experiment& experiment,
                          const std::vector<simulation::Port>& ports) {
  trails_ = std::move(trails);
  units_.clear();
  sources_.clear();
  for (const std::string& trail : trails_) {
    const auto port = begin_port(experiment, ports, trail);
    units_.push_back(port ? port->unit : "");
    sources_.push_back(port ? port->value : nullptr);
  }
  values_.resize(sources_.size());
  ++number_;
}

std::span<const double> ValueLayout::read() {
  constexpr double no_port = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < sources_.size(); ++i)
    values_[i] = sources_[i] == nullptr ? no_port : *sources_[i];
  return values_;
}

std::string ValueLayout::text() const {
  text::JsonWriter json;
  json.begin_object().member("tell", "layout").member("layout", number_);
  json.key("values").begin_array();
  for (const std::string& trail : trails_) json.value(trail);
  json.end_array().key("units").begin_array();
  for (const std::string& unit : units_) json.value(unit);
  return json.end_array().end_object().text();
}

}  // namespace hookpoint::view
