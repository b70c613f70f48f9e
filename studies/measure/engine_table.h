// Engines by name, as the command hands them in: this folder includes none.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"

namespace hookpoint::studies {

/// The description of an engine that is known before it runs, for EngineEntry::describe.
inline std::function<simulation::EngineDescription()> described_as(
    simulation::EngineDescription description) {
  return [description = std::move(description)] { return description; };
}

struct EngineEntry {
  /// Of a program, which is started for it, may take a moment the first time.
  std::function<simulation::EngineDescription()> describe;
  simulation::EngineFactory make = nullptr;
  /// Velocity of the origin of one body that rests on a plane within Coulomb's cone. Null for our
  /// own engine, whose laws have theirs.
  simulation::ClosedForm<simulation::CreepVelocity> (*creep)(const simulation::Experiment&) =
      nullptr;
  /// Depth per newton of a contact at rest [m/N]. Null for our engine, whose laws say it.
  simulation::ClosedForm<double> (*softness)(const simulation::Experiment&) = nullptr;
  bool is_program = false;  ///< one that has to be started for its description
  /// Whether it has one coefficient of friction, the kinetic one.
  bool has_one_friction(const simulation::Experiment& experiment) const {
    return std::ranges::count(describe().one_friction, experiment.settings) > 0;
  }
};

/// The engines of a program, in the order of their names.
class EngineTable {
 public:
  void add(std::string name, EngineEntry entry) {
    entries_.insert_or_assign(std::move(name), std::move(entry));
  }
  /// Null where the program has none of that name.
  const EngineEntry* find(const std::string& name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? nullptr : &found->second;
  }
  /// One that the program has.
  const EngineEntry& at(const std::string& name) const { return entries_.at(name); }
  /// Whether the machine has it, so that it can run.
  bool available(const std::string& name) const {
    const EngineEntry* entry = find(name);
    return entry != nullptr && entry->describe().found;
  }
  /// Why one that is not available is not: "engine mujoco is not on this machine".
  std::string absence(const std::string& name) const {
    const std::string missing = describe(name).missing;
    return "engine " + name +
           (missing.empty() ? " is not on this machine" : " cannot run: " + missing);
  }
  /// What is known of it; of one that the program has not, its name alone.
  simulation::EngineDescription describe(const std::string& name) const {
    const EngineEntry* entry = find(name);
    return entry != nullptr ? entry->describe()
                            : simulation::EngineDescription{name, {}, {}, false, {}};
  }
  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }

 private:
  std::map<std::string, EngineEntry> entries_;
};

}  // namespace hookpoint::studies
