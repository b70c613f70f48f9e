// Engines by name, as the command hands them in: this folder includes none.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "simulation/closed_form.h"
#include "simulation/creep_velocity.h"
#include "simulation/engine.h"

namespace hookpoint::studies {

struct EngineEntry {
  simulation::EngineDescription description;
  simulation::EngineFactory make = nullptr;
  /// Velocity of the origin of one body that rests on a plane within Coulomb's cone. Null for our
  /// own engine, whose laws have theirs.
  simulation::ClosedForm<simulation::CreepVelocity> (*creep)(const simulation::Experiment&) =
      nullptr;
  /// Depth per newton of a contact at rest [m/N]. Null for our engine, whose laws say it.
  simulation::ClosedForm<double> (*softness)(const simulation::Experiment&) = nullptr;
  /// Settings at which it has one coefficient of friction, the kinetic one.
  std::vector<std::string> one_friction = {};
  bool has_one_friction(const simulation::Experiment& experiment) const {
    return std::ranges::count(one_friction, experiment.settings) > 0;
  }
};

using EngineTable = std::map<std::string, EngineEntry>;

}  // namespace hookpoint::studies
