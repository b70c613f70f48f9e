// An experiment as it is drawn: what has a pose of its own, and, for players of records, the shapes
// of bodies and obstacles and the ground as triangles.
#pragma once

#include <string>
#include <vector>

#include "output/records/scene.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// What is drawn at a pose that changes.
struct ShownFrame {
  std::string trail;     ///< with the world's name
  const char* position;  ///< name of its port that says where it is
};

/// Bodies in the order of WorldState::bodies, then obstacles, then the ground where it moves.
std::vector<ShownFrame> shown_frames(const Experiment& experiment);

/// Puts their poses in the place of `poses`. `world`: one of `experiment`.
void shown_poses(const Experiment& experiment, const World& world, std::vector<Pose>& poses);

/// A body a frame of shown_frames; that of the ground has no shape.
output::Scene shown_scene(const Experiment& experiment);

/// The ground, a surface a material that it has. Its tiles where they differ; planes and stairs are
/// as few triangles as their materials allow. Without an edge it reaches 20 m beyond all robots' beginnings
/// and patches. Of a grid with more than 256 cells along a side every second, third ... vertex is
/// taken, and the last.
std::vector<output::SceneSurface> shown_ground(const Experiment& experiment);

}  // namespace hookpoint::simulation
