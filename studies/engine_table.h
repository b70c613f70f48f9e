// Engines by name, as the command hands them in: this folder includes none.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "simulation/creep_velocity.h"
#include "simulation/engine.h"

namespace hookpoint::studies {

struct EngineEntry {
  simulation::EngineDescription description;
  simulation::EngineFactory make = nullptr;
  /// Velocity of the origin of one body that rests on a plane within Coulomb's cone; nothing where
  /// no closed form holds. Null for our own engine, whose laws have theirs, and for an engine
  /// without any.
  std::optional<simulation::CreepVelocity> (*creep)(const simulation::Experiment&) = nullptr;
  /// Depth per newton of a contact at rest [m/N]; nothing where no closed form holds. Null for our
  /// engine, whose laws say it.
  std::optional<double> (*softness)(const simulation::Experiment&) = nullptr;
};

using EngineTable = std::map<std::string, EngineEntry>;

}  // namespace hookpoint::studies
