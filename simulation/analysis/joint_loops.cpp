#include "simulation/analysis/joint_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "language/wording.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/wiring/components.h"

namespace hookpoint::simulation {
namespace {

struct JointPlace {
  std::size_t robot = 0, joint = 0;
  std::string port;  ///< "angle", "rate", "torque"
};

/// The joints of all robots by the trails of their ports.
std::map<std::string, JointPlace> joint_ports(const Experiment& experiment) {
  std::map<std::string, JointPlace> places;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    const RobotSpec& robot = experiment.robots[i];
    for_each_link(robot, [&](const TreeLink& at) {
      const std::string trail =
          experiment.world + "." + robot.name + "." + at.chain.name + "." + at.link.body.name + ".";
      for (const char* port : {"angle", "rate", "torque"})
        places[trail + port] = {i, at.joint(), port};
    });
  }
  return places;
}

/// Samples that the map of one period can carry: an eigenvalue problem of that size more.
constexpr int most_under_way = 80;

/// What the wires of an experiment say of its loops.
class LoopFinder {
 public:
  explicit LoopFinder(const Experiment& experiment)
      : experiment_(experiment), components_(experiment), joints_(joint_ports(experiment)) {
    for (const WireSpec& wire : experiment.wires) {
      if (const auto to = components_.find(wire.to)) into_.emplace(key(*to), &wire);
      if (const auto from = components_.find(wire.from)) out_of_.emplace(key(*from), &wire);
    }
    for (const RobotSpec& robot : experiment.robots) robots_.insert(robot.name);
  }

  WiredControl find() {
    WiredControl control;
    const std::set<std::size_t> reacting = reacting_components();
    double under_way = 0.;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const ComponentSpec& spec = experiment_.components[i];
      const std::vector<control::LinearFeedback> ways = components_[i].linearise();
      std::string why = ways.empty() ? language::with_article(spec.type) +
                                           " is not one of the PD and PID controllers whose "
                                           "feedback is computed"
                                     : std::string("it drives nothing");
      const std::size_t before = control.loops.size();
      bool whole = true;
      for (const control::LinearFeedback& way : ways)
        whole = add_loop(i, way, control, why) && whole;
      if (whole && control.loops.size() > before && fits(control.loops, before, why, under_way))
        continue;
      control.loops.resize(before);
      if (reacting.contains(i)) control.left_out.push_back(spec.trail + ": " + why);
    }
    for (const WireSpec& wire : experiment_.wires) {
      if (is_of_a_robot(wire.from) && !components_.find(wire.from) && !components_.find(wire.to) &&
          wire.to.starts_with(experiment_.world + "."))
        control.left_out.push_back(wire.to + ": it follows " + wire.from +
                                   " by a wire alone, without a controller");
    }
    std::ranges::stable_sort(control.loops, {}, &JointLoop::robot);
    control.driven = driven_joints(control);
    return control;
  }

 private:
  std::vector<DrivenJoint> driven_joints(const WiredControl& control) const {
    std::vector<DrivenJoint> driven;
    for (const WireSpec& wire : experiment_.wires) {
      const JointPlace* place = joint_at(wire.to, "torque");
      if (!place) continue;
      DrivenJoint& joint = driven.emplace_back(DrivenJoint{place->robot, place->joint, {}, 0.});
      const auto loops = loops_of(control, place->robot);
      const auto loop = std::ranges::find_if(loops, [&](const JointLoop& each) {
        return each.driven == place->joint && each.sensed == each.driven &&
               each.gains.integral == 0.;
      });
      if (loop == loops.end() || !loop->goal) continue;
      joint.goal = loop->goal;
      joint.proportional = loop->gains.proportional;
    }
    std::ranges::sort(driven, {},
                      [](const DrivenJoint& joint) { return std::pair(joint.robot, joint.joint); });
    return driven;
  }

  /// Whether the loops from `first` on go into one map with those before them. `under_way`: the
  /// samples of all that do.
  static bool fits(const std::vector<JointLoop>& loops, std::size_t first, std::string& why,
                   double& under_way) {
    double with_these = under_way;
    for (std::size_t i = first; i < loops.size(); ++i) {
      const double delay = loops[i].delay + loops[i].rate_delay;
      if (delay > 0.) with_these += delay / loops[i].period;
      if (loops[i].period != loops.front().period)
        why = "does not update at the rate of " + loops.front().controller;
      else if (delay > 0. && loops[i].period == 0.)
        why = "late, without a rate";
      else if (with_these > most_under_way)
        why = fmt::format("more than {} samples under way", most_under_way);
      else
        continue;
      return false;
    }
    under_way = with_these;
    return true;
  }

  /// A component and one of its values, by index.
  using Key = std::pair<std::size_t, std::size_t>;
  static Key key(const ComponentValue& value) { return {value.component, value.index}; }

  const WireSpec* wire_into(const Key& value) const {
    const auto found = into_.find(value);
    return found == into_.end() ? nullptr : found->second;
  }

  const JointPlace* joint_at(const std::string& trail, const char* port) const {
    const auto found = joints_.find(trail);
    return found == joints_.end() || found->second.port != port ? nullptr : &found->second;
  }

  /// The loop that the component closes that way, if it closes one; false where it does something
  /// else.
  bool add_loop(std::size_t component, const control::LinearFeedback& way, WiredControl& control,
                std::string& why) const {
    const ComponentSpec& spec = experiment_.components[component];
    const WireSpec* angle = wire_into({component, way.input});
    const WireSpec* rate = way.rate ? wire_into({component, *way.rate}) : nullptr;
    const auto [first, last] = out_of_.equal_range({component, way.output});
    if (first == last) return true;  // it drives nothing
    const WireSpec* torque = first->second;
    const JointPlace* driven = joint_at(torque->to, "torque");
    const JointPlace* sensed = angle ? joint_at(angle->from, "angle") : nullptr;
    const JointPlace* moved = rate ? joint_at(rate->from, "rate") : sensed;
    const auto not_plain = [&](std::string reason) {
      why = std::move(reason);
      return false;
    };
    if (std::next(first) != last) return not_plain("its output goes to more than one place");
    if (!driven)
      return not_plain("its output goes to " + torque->to + ", not straight to a joint's torque");
    if (!angle) return not_plain("no wire brings it what it controls");
    if (!sensed)
      return not_plain("it reads " + angle->from + ", not straight the angle of a joint");
    if (!moved) return not_plain("it reads " + rate->from + ", not straight the rate of a joint");
    if (sensed->robot != driven->robot || moved->robot != sensed->robot ||
        moved->joint != sensed->joint)
      return not_plain("it reads one joint and another, or drives another robot's");
    JointLoop loop{spec.trail, driven->robot, sensed->joint, driven->joint, way.gains};
    if (rate == nullptr && !loop.gains.differenced) loop.gains.derivative = 0.;
    if (way.goal && !wire_into({component, *way.goal}))
      loop.goal = components_[component].values()[*way.goal];
    loop.delay = angle->delay + torque->delay;
    const bool reads_rate = rate != nullptr && loop.gains.derivative != 0.;
    loop.rate_delay = reads_rate ? rate->delay + torque->delay : 0.;
    if (!set_period(loop, spec, {angle, rate ? rate : angle, torque})) {
      why = "its wires are sampled at rates of their own";
      return false;
    }
    control.loops.push_back(std::move(loop));
    return true;
  }

  /// The one period of controller and wires. A controller without memory that is faster than its
  /// wires does what it would do at their rate.
  static bool set_period(JointLoop& loop, const ComponentSpec& spec,
                         const std::vector<const WireSpec*>& wires) {
    const bool has_memory = control::memory_size(loop.gains) > 0;
    std::optional<double> slowest = spec.rate;
    for (const WireSpec* wire : wires) {
      if (!wire->rate || wire->rate == slowest) continue;
      if (slowest || has_memory) return false;
      slowest = wire->rate;
    }
    loop.period = slowest ? 1. / *slowest : 0.;
    return true;
  }

  /// Components on a way from a robot's ports to a robot's or a force's.
  std::set<std::size_t> reacting_components() const {
    const std::size_t count = components_.size();
    std::vector<std::set<std::size_t>> feeds(count);
    std::vector<char> sees(count, 0), moves(count, 0);
    for (const WireSpec& wire : experiment_.wires) {
      const auto from = components_.find(wire.from), to = components_.find(wire.to);
      if (from && to) feeds[from->component].insert(to->component);
      if (!from && to && is_of_a_robot(wire.from)) sees[to->component] = 1;
      if (from && !to) moves[from->component] = 1;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t fed : feeds[i]) {
          changed = changed || sees[i] > sees[fed] || moves[fed] > moves[i];
          sees[fed] = std::max(sees[fed], sees[i]);
          moves[i] = std::max(moves[i], moves[fed]);
        }
      }
    }
    std::set<std::size_t> reacting;
    for (std::size_t i = 0; i < count; ++i) {
      if (sees[i] && moves[i]) reacting.insert(i);
    }
    return reacting;
  }

  bool is_of_a_robot(const std::string& trail) const {
    const std::string world = experiment_.world + ".";
    if (!trail.starts_with(world)) return false;
    const std::size_t end = trail.find('.', world.size());
    return end != std::string::npos &&
           robots_.contains(trail.substr(world.size(), end - world.size()));
  }

  const Experiment& experiment_;
  Components components_;
  std::map<std::string, JointPlace> joints_;
  std::set<std::string> robots_;
  std::map<Key, const WireSpec*> into_;
  std::multimap<Key, const WireSpec*> out_of_;
};

/// Those of a robot, out of a list that is in the order of robots.
template <class Element>
std::span<const Element> of_robot(const std::vector<Element>& all, std::size_t robot) {
  const auto first = std::ranges::lower_bound(all, robot, {}, &Element::robot);
  return {first, std::ranges::upper_bound(first, all.end(), robot, {}, &Element::robot)};
}

}  // namespace

std::span<const JointLoop> loops_of(const WiredControl& control, std::size_t robot) {
  return of_robot(control.loops, robot);
}

std::span<const DrivenJoint> driven_of(const WiredControl& control, std::size_t robot) {
  return of_robot(control.driven, robot);
}

WiredControl wired_control(const Experiment& experiment) {
  if (experiment.wires.empty()) return {};
  return LoopFinder(experiment).find();
}

}  // namespace hookpoint::simulation
