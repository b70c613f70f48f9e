// What stands in the world that a window shows, as plain data that a page is sent once: bodies with
// their shapes, the ground, sensors. Where they are is told by snapshots.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/text/json.h"
#include "simulation/experiment.h"
#include "simulation/ground_mesh.h"
#include "simulation/kinematics.h"

namespace hookpoint::view {

struct SceneBody {
  std::string trail;  ///< from the top
  int robot = 0;
  int parent = -1;                             ///< of the scene's bodies; -1: none
  std::optional<simulation::JointKind> joint;  ///< that carries it; none of a base
  simulation::MassSpec mass;
  std::vector<simulation::ShapeSpec> shapes;
  std::vector<Vector3d> points;  ///< boundary points, body axes [m]
  simulation::Pose start;        ///< X_WB at time 0
};

struct SceneSensor {
  std::string trail, type;
  int body = 0;       ///< of the scene's bodies
  Vector3d location;  ///< body axes [m]
};

struct Scene {
  std::vector<SceneBody> bodies;  ///< in the order of WorldState::bodies
  std::optional<simulation::GroundTiles> terrain;
  std::vector<std::string> materials;
  Vector3d gravity;
  std::vector<SceneSensor> sensors;
};

/// A sensor is at the origin of the body that it is attached to, or else of the body from which a
/// wire leads to it. One that has neither is left out. O(bodies + tiles + components * wires).
Scene make_scene(const simulation::Experiment& experiment);

/// The "scene" of docs/view_protocol.md.
void write_scene(const Scene& scene, output::JsonWriter& json);

}  // namespace hookpoint::view
