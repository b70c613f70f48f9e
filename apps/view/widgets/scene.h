// What stands in the world that a window shows, as plain data that a page is sent once: bodies and
// obstacles with their shapes, the ground, sensors. Snapshots say where they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"
#include "simulation/experiment/ground_mesh.h"
#include "simulation/experiment/kinematics.h"
#include "text/json.h"

namespace hookpoint::view {

/// A body of a robot, an obstacle, or ground that moves, which has no shape of its own.
struct SceneBody {
  std::string trail;                               ///< from the top
  int robot = -1;                                  ///< -1: no robot carries it
  int parent = -1;                                 ///< of the scene's bodies; -1: none
  std::optional<simulation::JointKind> joint;      ///< that carries it; none of a base
  std::optional<double> lower_limit, upper_limit;  ///< of its joint [rad or m]
  simulation::MassSpec mass;
  std::optional<int> material;  ///< of an obstacle: index into Scene::materials
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
  std::vector<SceneBody> bodies;  ///< in the order of simulation::shown_frames
  std::optional<simulation::GroundTiles> terrain;
  std::optional<int> endless;  ///< material of a plane, which continues beyond its tiles
  int terrain_body = -1;       ///< of the bodies, whose axes the terrain is in; -1: world axes
  std::vector<std::string> materials;
  Vector3d gravity;
  std::vector<SceneSensor> sensors;
};

/// A sensor is at the origin of the body that it is attached to, or else of the body from which a
/// wire leads to it. One that has neither is left out. O(bodies + tiles + components * wires).
Scene make_scene(const simulation::Experiment& experiment);

/// The "scene" of docs/view_protocol.md.
void write_scene(const Scene& scene, text::JsonWriter& json);

}  // namespace hookpoint::view
