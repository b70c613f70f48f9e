// The robots of an experiment as one flat list of bodies, in the order in which they are published:
// what a peer builds its bodies and joints from.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::reference {

struct TreeBody {
  std::shared_ptr<const simulation::BodySpec> body;  ///< copies: an experiment may end before
  std::shared_ptr<const simulation::LinkSpec>
      link;  ///< the world that was built of it; null: a base
  int robot = 0;
  int parent = -1;     ///< index in this list of the body that carries it; -1: a base
  int joint = -1;      ///< index among all joints, as published; -1: a base
  bool mobile = true;  ///< false: a base that nothing moves
  /// X_PL at joint position 0: of a chain's first link the hip, then Rot_x(alpha) Trans_x(a)
  /// Rot_z(theta) Trans_z(d). The joint then turns about, or slides along, the link's own z:
  /// X_PL(q) = X_PL(0) Rot_z(q), or X_PL(0) Trans_z(q).
  simulation::Pose X_PL0;
  simulation::BodyState initial;  ///< at time 0, by the joints' angles and rates
  /// Of a base that is kept in a plane through where it starts: which of x, y, z is its normal.
  std::optional<std::size_t> plane_normal = {};

  bool turns() const { return simulation::joint_type(link->joint).turns; }
};

struct RobotTree {
  std::vector<TreeBody> bodies;    ///< robots in order: the base, then links chain by chain
  std::vector<std::size_t> bases;  ///< index of each robot's base in `bodies`
  std::size_t joints = 0;

  /// Body `body` of robot `robot`, as a ForceSpec or a PointSpec counts them.
  std::size_t index(int robot, int body) const {
    return bases[static_cast<std::size_t>(robot)] + static_cast<std::size_t>(body);
  }
};

/// The axes of a plane, right-handed: two in it, then its normal.
struct PlaneAxes {
  Vector3d first, second, normal;
  Quaterniond turn;  ///< from x, y, z to them
};
/// Of the plane of world axes whose normal is x, y or z: `normal` 0, 1, 2.
PlaneAxes plane_axes(std::size_t normal);

RobotTree robot_tree(const simulation::Experiment& experiment);

/// How a link stands and moves on a body that stands and moves as `parent` does, at a joint
/// position [rad, m] and rate [rad/s, m/s]. No contact.
simulation::BodyState link_state(const simulation::BodyState& parent, const TreeBody& link,
                                 double angle, double rate);

}  // namespace hookpoint::reference
