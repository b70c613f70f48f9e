// How the joints of a robot answer torques in them: the joints' part of M^-1 S tau, of its tree
// that nothing else touches, from where an engine has its bodies.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/matrix3.h"
#include "math/pivoted_cholesky.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

class JointResponse {
 public:
  /// Allocates; nothing else does.
  explicit JointResponse(const simulation::RobotSpec& robot);

  /// The mass matrix with the robot's bodies as they stand, factored: composite rigid bodies in
  /// world axes (Featherstone 2008, section 6.2). O(links^3).
  void stand_at(std::span<const simulation::BodyState> bodies);
  /// Joint accelerations that `torques` alone cause there, both one a joint. O(links^2).
  void solve(std::span<const double> torques, std::span<double> accelerations);

 private:
  /// Of a rigid body, about the base's origin, world axes.
  struct Inertia {
    double mass = 0.;
    Vector3d moment;    ///< m c
    Matrix3d rotation;  ///< about the origin
  };
  /// A velocity w, v of what is at the origin, or a moment and a force about it.
  struct Screw {
    Vector3d angular, linear;
  };
  struct Link {
    simulation::MassSpec mass;
    std::size_t parent = 0;
    bool turns = true;
    double rotor_inertia = 0.;
  };
  static Screw momentum(const Inertia& inertia, const Screw& motion);

  std::vector<Link> bodies_;    ///< the base first, which no joint carries
  std::size_t base_count_;      ///< coordinates of the base
  std::vector<Screw> motions_;  ///< that a unit rate of each coordinate gives: base, then joints
  std::vector<Inertia> composites_;  ///< of each body with all that it carries
  PivotedCholesky mass_matrix_;
  std::vector<double> forces_, accelerations_;
};

}  // namespace hookpoint::reference
