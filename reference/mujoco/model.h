// The experiment as a MuJoCo model: bodies, joints, shapes and ground.
#pragma once

#include <optional>
#include <vector>

#include "reference/mujoco/library.h"
#include "reference/mujoco/settings.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

inline Vector3d vector(const mjtNum* a) { return {a[0], a[1], a[2]}; }
inline Quaterniond quaternion(const mjtNum* q) { return {q[0], q[1], q[2], q[3]}; }

/// A body of the tree in MuJoCo.
struct MujocoBody {
  int id = 0;        ///< MuJoCo's number of it
  int geometry = 0;  ///< that stands for it where its points touch
  Vector3d offset;   ///< p_BM [m]: where MuJoCo has its frame, in its body axes
  int position =
      0;  ///< where its joint's coordinates begin in qpos; of a base that moves, the free joint's
  int velocity = 0;  ///< and its speeds in qvel
};

/// What a geometry of MuJoCo's stands for.
struct MujocoGeometry {
  bool of_robot = false;
  /// Of a robot's shape or an obstacle, index into Experiment::materials; of the ground its tiles say.
  int material = simulation::no_material;
  std::optional<std::size_t> obstacle{};
};

struct MujocoModel {
  MujocoPointer<mjModel> model;
  std::vector<MujocoBody> bodies;          ///< as in the tree
  std::vector<MujocoGeometry> geometries;  ///< by MuJoCo's number
  int ground = 0;                          ///< geometry that boundary points meet
};

/// Throws ExperimentError with MuJoCo's message where its compiler refuses the model.
MujocoModel make_mujoco_model(const simulation::Experiment& experiment, const RobotTree& tree,
                              const MujocoSettings& settings);

}  // namespace hookpoint::reference
