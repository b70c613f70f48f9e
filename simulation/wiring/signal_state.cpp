// What the signals of a run carry from one step to the next: ports that hold what was written, the
// components' values, and what is under way on the wires. Random numbers need nothing: each follows
// from its stream's key and its count (control/random.h).
#include <fmt/format.h>

#include "simulation/wiring/signals.h"

namespace hookpoint::simulation {
namespace {

std::string layout_of(const control::Component& component) {
  std::string layout;
  for (const control::PortDescription& port : component.ports()) {
    if (port.kind != control::PortKind::text)
      layout += fmt::format("{}[{}] ", port.name, port.count);
  }
  return layout + "updates last_update";
}

}  // namespace

/// The values of the file that nothing can write stay as they are; `envelopes` and what acts follow
/// from the step.
template <class Self, class Archive>
void Signals::exchange(Self& self, Archive& archive) {
  archive("running", self.held_.running);
  archive("quit", self.held_.quit);
  archive("joint_torque", self.engine_.inputs().joint_torques);
  archive.each("force", self.held_.forces, [](auto& force, auto& part) {
    part("point", force.point);
    part("force", force.force);
    part("torque", force.torque);
  });
  for (std::size_t i = 0; i < self.held_.values.size(); ++i) {
    if ((*self.experiment_.values)[i].writable) archive("value", self.held_.values[i]);
  }
}

std::vector<StateSection> Signals::state_layout() const {
  StateCount held;
  StateLayout layout;
  exchange(*this, held);
  exchange(*this, layout);
  std::vector<StateSection> sections{{"signals", layout.text(), held.count()}};
  for (std::size_t i = 0; i < components_.size(); ++i) {
    sections.push_back({experiment_.components[i].trail, layout_of(components_[i]),
                        components_[i].values().size() + 2});
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const WireSpec& wire = experiment_.wires[i];
    if (const std::size_t size = lines_[i].line.state_size(); size > 0) {
      sections.push_back({fmt::format("wire {} -> {}", wire.from, wire.to),
                          fmt::format("samples output under_way value[{}]", size - 3), size});
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
  apply_forces(step);
  derived_.restart();
}

}  // namespace hookpoint::simulation
