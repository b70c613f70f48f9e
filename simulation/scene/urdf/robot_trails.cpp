#include "simulation/scene/urdf/robot_trails.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/tree/references.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignField;
using language::ForeignObject;
using language::ForeignWire;
using language::Position;

class RobotTrails {
 public:
  RobotTrails(ForeignObject& robot, language::Report& report) : robot_(robot), report_(report) {}

  void run() { visit(robot_); }

 private:
  using Parts = std::span<const std::string_view>;
  enum class Prefer { longest, shortest };

  void visit(ForeignObject& object) {
    around_.push_back(&object);
    for (ForeignField& field : object.fields) {
      if (field.name == "mimic")
        settle(field.values.front().text, 0, Prefer::longest, object.position);
    }
    for (auto& [from, to] : object.wires) {
      for (std::string* end : {&from, &to}) {
        // A port of its own has a name alone.
        if (end->find('.') != std::string::npos) settle(*end, 1, Prefer::shortest, object.position);
      }
    }
    for (ForeignObject& child : object.children) visit(child);
    around_.pop_back();
  }

  /// `ports`: how many parts of the trail name a port, at its end.
  void settle(std::string& trail, std::size_t ports, Prefer prefer, const Position& place) {
    if (trail.empty()) return;  // of what is not there, which is reported
    const std::vector<std::string_view> parts = language::parts_of_trail(trail);
    const Parts objects(parts.data(), parts.size() - ports);
    const ForeignObject* const target = descend(&robot_, objects.subspan(1));
    const std::size_t count = objects.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = prefer == Prefer::longest ? i : count - 1 - i;
      if (reached(objects.subspan(first)) != target) continue;
      trail = fmt::format(
          "{}", fmt::join(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end(), "."));
      return;
    }
    report_.error(place,
                  fmt::format("`{}` cannot be named from here: links or joints around this one are "
                              "called as parts of its trail; call the robot otherwise (name = ...)",
                              trail));
  }

  /// What a trail names from the innermost of the objects around; null for nothing of the robot.
  const ForeignObject* reached(Parts trail) {
    for (const ForeignObject* scope : std::views::reverse(around_)) {
      if (const ForeignObject* child = held(*scope, trail.front()))
        return descend(child, trail.subspan(1));
    }
    return trail.front() == robot_.name ? descend(&robot_, trail.subspan(1)) : nullptr;
  }

  const ForeignObject* descend(const ForeignObject* from, Parts trail) {
    for (const std::string_view part : trail) {
      if (from == nullptr) break;
      from = held(*from, part);
    }
    return from;
  }

  /// The object of that name in another; null where there is none.
  const ForeignObject* held(const ForeignObject& in, std::string_view name) {
    const auto [known, is_new] = held_.try_emplace(&in);
    if (is_new) {
      for (const ForeignObject& child : in.children) {
        if (child.type.starts_with("Base.")) known->second.emplace("base", &child);
        if (!child.name.empty()) known->second.emplace(child.name, &child);
      }
    }
    const auto found = known->second.find(name);
    return found == known->second.end() ? nullptr : found->second;
  }

  ForeignObject& robot_;
  language::Report& report_;
  std::vector<const ForeignObject*> around_;  ///< the object that is visited, outermost first
  std::unordered_map<const ForeignObject*,
                     std::unordered_map<std::string_view, const ForeignObject*>>
      held_;
};

}  // namespace

void settle_trails(ForeignObject& robot, language::Report& report) {
  RobotTrails(robot, report).run();
}

}  // namespace hookpoint::simulation
