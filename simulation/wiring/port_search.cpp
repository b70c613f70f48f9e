#include "simulation/wiring/port_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "language/document/document.h"
#include "language/names.h"
#include "language/tree/references.h"

namespace hookpoint::simulation {
namespace {

constexpr std::size_t longest_glob = 1000;

bool is_glob(std::string_view pattern) { return pattern.find_first_of("*?") != pattern.npos; }

bool fits(const std::string& pattern, std::string_view trail) {
  const std::string_view whole = whole_of(trail);
  if (is_glob(pattern) && glob_fits(pattern, trail)) return true;
  return !whole.empty() && glob_fits(pattern, whole);
}

/// The first part of a glob that fits nothing, and the names that stand there in the trails.
struct Gap {
  std::size_t part = 0;
  std::set<std::string> names;
};

Gap first_gap(const std::vector<std::string_view>& pattern,
              const std::vector<std::string>& trails) {
  Gap gap;
  std::vector<std::vector<std::string_view>> left;
  for (const std::string& trail : trails) left.push_back(language::parts_of_trail(trail));
  for (; gap.part < pattern.size(); ++gap.part) {
    std::vector<std::vector<std::string_view>> fitting;
    gap.names.clear();
    for (std::vector<std::string_view>& parts : left) {
      if (parts.size() <= gap.part) continue;
      gap.names.emplace(parts[gap.part]);
      if (glob_fits(pattern[gap.part], parts[gap.part])) fitting.push_back(std::move(parts));
    }
    if (fitting.empty()) return gap;
    left = std::move(fitting);
  }
  return gap;
}

/// "; did you mean `block.base.*`?": the glob with its first wrong name put right.
std::string near_glob(const std::string& pattern, const std::vector<std::string>& trails) {
  std::vector<std::string_view> parts = language::parts_of_trail(pattern);
  const Gap gap = first_gap(parts, trails);
  if (gap.part < parts.size()) {
    std::string_view& wrong = parts[gap.part];
    const std::string near = language::nearest_name(wrong, {gap.names.begin(), gap.names.end()});
    if (!near.empty()) {
      wrong = near;
      return fmt::format("; did you mean `{}`?", fmt::join(parts, "."));
    }
  }
  return "; `hookpoint ports FILE` lists them";
}

std::vector<std::string> names_of(const std::vector<Port>& ports, std::string_view world,
                                  bool with_world) {
  std::vector<std::string> names;
  for (const Port& port : ports)
    names.push_back(!with_world && port.trail.starts_with(world) ? port.trail.substr(world.size())
                                                                 : port.trail);
  return names;
}

[[noreturn]] void fail(const std::vector<Port>& ports, std::string_view world,
                       const std::string& pattern) {
  // Trails are suggested as the user writes them: with or without the world's name.
  std::vector<std::string> names = names_of(ports, world, pattern.starts_with(world));
  if (is_glob(pattern))
    throw ExperimentError(fmt::format("no port fits `{}`{}", pattern, near_glob(pattern, names)));
  for (std::size_t i = 0, count = names.size(); i < count; ++i)
    if (const std::string_view whole = whole_of(names[i]); !whole.empty())
      names.emplace_back(whole);
  const std::string nearest = language::nearest_name(pattern, names);
  throw ExperimentError(fmt::format("there is no port `{}`{}", pattern,
                                    nearest.empty()
                                        ? "; `hookpoint ports FILE` lists them"
                                        : fmt::format("; did you mean `{}`?", nearest)));
}

/// The ports that `pattern` fits under `names`, one a port.
std::vector<Port> fitting(const std::vector<Port>& ports, const std::vector<std::string>& names,
                          const std::string& pattern) {
  std::vector<Port> found;
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    // Of two ports of one trail the first hides the second.
    if (!fits(pattern, names[i]) || !seen.insert(names[i]).second) continue;
    found.push_back(ports[i]);
    found.back().trail = names[i];
    if (ports[i].lazy != nullptr) ports[i].lazy->begin();
  }
  return found;
}

}  // namespace

bool glob_fits(std::string_view pattern, std::string_view text) {
  if (pattern.size() > longest_glob) return false;
  // reached[i]: what was read of the pattern fits the first i characters of the text.
  std::vector<bool> reached(text.size() + 1, false);
  reached[0] = true;
  while (!pattern.empty()) {
    const char sign = pattern[0];
    const bool any = pattern.starts_with("**");
    pattern.remove_prefix(any ? 2 : 1);
    std::vector<bool> next(text.size() + 1, false);
    for (std::size_t i = 0; i <= text.size(); ++i) {
      if (sign == '*' && reached[i]) next[i] = true;
      if (i == text.size()) break;
      const bool taken = sign == '*'   ? next[i] && (any || text[i] != '.')
                         : sign == '?' ? reached[i] && text[i] != '.'
                                       : reached[i] && text[i] == sign;
      if (taken) next[i + 1] = true;
    }
    reached = std::move(next);
  }
  return reached[text.size()];
}

std::string_view whole_of(std::string_view trail) {
  if (trail.ends_with(']')) return trail.substr(0, trail.rfind('['));
  if (trail.size() < 3 || trail[trail.size() - 2] != '.') return {};
  return std::string_view("wxyz").find(trail.back()) == std::string_view::npos
             ? std::string_view{}
             : trail.substr(0, trail.size() - 2);
}

std::vector<Port> find_ports(const Experiment& experiment, const std::vector<Port>& ports,
                             const std::string& pattern) {
  if (!is_glob(pattern)) {
    if (auto port = look_up_port(experiment, ports, pattern)) {
      port->trail = pattern;
      return {std::move(*port)};
    }
  }
  const std::string world = experiment.world + ".";
  for (const bool with_world : {true, false}) {
    auto found = fitting(ports, names_of(ports, world, with_world), pattern);
    if (!found.empty()) return found;
  }
  fail(ports, world, pattern);
}

std::vector<Port> find_all_ports(const Experiment& experiment, const std::vector<Port>& ports,
                                 const std::vector<std::string>& patterns) {
  std::vector<Port> all;
  std::set<const double*> there;
  for (const std::string& pattern : patterns) {
    std::vector<Port> found = find_ports(experiment, ports, pattern);
    const bool asked_for_by_name = found.size() == 1 && found.front().trail == pattern;
    for (Port& port : found)
      if (there.insert(port.value).second || asked_for_by_name) all.push_back(std::move(port));
  }
  return all;
}

}  // namespace hookpoint::simulation
