#include "simulation/wiring/wiring_order.h"

#include <algorithm>
#include <unordered_map>

namespace hookpoint::simulation {
namespace {

/// Depth-first search from what takes values to what gives them: an item is laid down after all
/// that it takes from.
class Search {
 public:
  Search(const Experiment& experiment, const Components& components)
      : experiment_(experiment), component_count_(components.size()) {
    takes_from_.resize(component_count_ + experiment.wires.size());
    marks_.resize(takes_from_.size());
    std::unordered_map<std::string, std::vector<std::size_t>> into;
    for (std::size_t i = 0; i < experiment.wires.size(); ++i) {
      if (experiment.wires[i].delay > 0.) continue;
      into[experiment.wires[i].to].push_back(component_count_ + i);
      if (const auto to = components.find(experiment.wires[i].to))
        takes_from_[to->component].push_back(component_count_ + i);
    }
    for (std::size_t i = 0; i < experiment.wires.size(); ++i) {
      const auto from = components.find(experiment.wires[i].from);
      std::vector<std::size_t>& givers = takes_from_[component_count_ + i];
      if (from && from->computed) {
        givers.push_back(from->component);
      } else if (const auto found = into.find(experiment.wires[i].from); found != into.end()) {
        givers = found->second;
      }
    }
  }

  WiringOrder run() {
    for (std::size_t node = 0; node < takes_from_.size() && order_.loop.empty(); ++node) {
      const bool delayed = is_wire(node) && wire(node).delay > 0.;
      if (!delayed) visit(node);
    }
    return std::move(order_);
  }

 private:
  enum class Mark : char { unseen, open, done };

  bool is_wire(std::size_t node) const { return node >= component_count_; }
  const WireSpec& wire(std::size_t node) const {
    return experiment_.wires[node - component_count_];
  }

  void visit(std::size_t first) {
    // Each entry: a node and how many of those that it takes from were visited.
    std::vector<std::pair<std::size_t, std::size_t>> path;
    const auto open = [&](std::size_t node) {
      if (marks_[node] == Mark::unseen) {
        marks_[node] = Mark::open;
        path.emplace_back(node, 0);
      } else if (marks_[node] == Mark::open) {
        keep_loop(path, node);
      }
    };
    open(first);
    while (!path.empty() && order_.loop.empty()) {
      auto& [node, next] = path.back();
      if (next < takes_from_[node].size()) {
        open(takes_from_[node][next++]);
        continue;
      }
      marks_[node] = Mark::done;
      order_.items.push_back({is_wire(node), is_wire(node) ? node - component_count_ : node});
      path.pop_back();
    }
  }

  /// The path goes against the values; the loop with them.
  void keep_loop(const std::vector<std::pair<std::size_t, std::size_t>>& path, std::size_t node) {
    auto step = std::ranges::find(path, node, &std::pair<std::size_t, std::size_t>::first);
    for (; step != path.end(); ++step) {
      if (is_wire(step->first)) order_.loop.push_back(step->first - component_count_);
    }
    std::ranges::reverse(order_.loop);
    std::rotate(order_.loop.begin(), std::ranges::min_element(order_.loop), order_.loop.end());
  }

  const Experiment& experiment_;
  std::size_t component_count_;
  std::vector<std::vector<std::size_t>> takes_from_;  // nodes: components, then wires
  std::vector<Mark> marks_;
  WiringOrder order_;
};

}  // namespace

WiringOrder order_wiring(const Experiment& experiment, const Components& components) {
  return Search(experiment, components).run();
}

}  // namespace hookpoint::simulation
