// The experiment's terrain as the contact laws ask it.
#pragma once

#include <optional>

#include "contact/terrain/terrain.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The ground of the experiment; none when it has no terrain.
inline std::optional<contact::Terrain> make_ground(const Experiment& experiment) {
  if (!experiment.terrain) return std::nullopt;
  return contact::Terrain(*experiment.terrain);
}

}  // namespace hookpoint::simulation
