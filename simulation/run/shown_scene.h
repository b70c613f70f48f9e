// An experiment as players of its records draw it: the bodies' shapes, the ground as triangles.
#pragma once

#include <vector>

#include "output/records/scene.h"
#include "simulation/experiment.h"

namespace hookpoint::simulation {

/// Bodies in the order of WorldState::bodies, with the world's name in theirs.
output::Scene shown_scene(const Experiment& experiment);

/// The ground, a surface a material that it has. Its tiles where they differ; a plane is as few
/// triangles as its materials allow. Without an edge it reaches 20 m beyond all robots' beginnings
/// and patches. Of a grid with more than 256 cells along a side every second, third ... vertex is
/// taken, and the last.
std::vector<output::SceneSurface> shown_ground(const Experiment& experiment);

}  // namespace hookpoint::simulation
