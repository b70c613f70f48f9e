// Engines by name, as the command hands them in: this folder includes none.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "simulation/engine.h"

namespace hookpoint::studies {

struct EngineEntry {
  simulation::EngineDescription description;
  simulation::EngineFactory make = nullptr;
  /// Tangential speed per newton of friction of a sticking contact in the engine's constraints
  /// [m/(N s)] (ODE: CFM); nothing where no closed form holds. Null for an engine without such
  /// constraints.
  std::optional<double> (*friction_mixing)(const simulation::Experiment&) = nullptr;
  /// Normal speed per newton at which a contact gives way for good [m/(N s)] (ODE: CFM within its
  /// surface layer). Null or 0 for an engine that pushes penetration out.
  double (*normal_mixing)(const simulation::Experiment&) = nullptr;
  /// Depth per newton of a contact at rest [m/N]; nothing where no closed form holds. Null for our
  /// engine, whose laws say it.
  std::optional<double> (*softness)(const simulation::Experiment&) = nullptr;
};

using EngineTable = std::map<std::string, EngineEntry>;

}  // namespace hookpoint::studies
