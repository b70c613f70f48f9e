// A robot about a rest, as linear dynamics: its mass matrix, the springs and dampers of its
// contacts and joints, and the stiffness that steady loads have by themselves (a pendulum's). What
// the largest stable step of an integrator follows from.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dts/impulse_response.h"
#include "simulation/dts_engine/robot_system.h"

namespace hookpoint::simulation {

inline Eigen::Vector3d eigen(const Vector3d& v) { return {v.x, v.y, v.z}; }

/// A contact about its load, world axes: force -K x - C v on the point.
struct ContactSpring {
  Eigen::MatrixXd lever;               ///< RobotAtRest::lever of the point
  Eigen::Matrix3d stiffness, damping;  ///< symmetric [N/m, N s/m]
};

/// A force that keeps its size and direction while its point moves with the body.
struct SteadyLoad {
  dts::BodyPoint<double> point;
  Vector3d force;  ///< world axes [N]
};

/// z'' + C z' + K z = 0 in coordinates z with the mass matrix 1; both symmetric.
struct LinearDynamics {
  Eigen::MatrixXd stiffness;  ///< K [1/s^2]
  Eigen::MatrixXd damping;    ///< C [1/s]
  Eigen::MatrixXd joints;     ///< a row a joint: its position over z; a torque moves z by the row
  /// What springs and dampers of joints have of K and C.
  struct OfJoints {
    Eigen::MatrixXd stiffness, damping;
  } of_joints;
};

/// A refreshed robot at its present posture, at rest, in coordinates z in which its mass matrix
/// is 1.
class RobotAtRest {
 public:
  /// O(size^3).
  explicit RobotAtRest(const RobotSystem& robot);

  const RobotSystem& robot() const { return *robot_; }
  Eigen::Index size() const { return root_.rows(); }
  /// False where a body that moves has no mass: there are no such coordinates.
  bool is_regular() const { return regular_; }

  /// size() x 3: how a force at the point moves z, world axes; transposed, how the point moves.
  Eigen::MatrixXd lever(const dts::BodyPoint<double>& point) const;
  /// The norm of that matrix. O(links between the base and the point's body).
  double lever_size(const dts::BodyPoint<double>& point) const;
  /// How all these forces together move z: the sum of lever(point) force. O(loads size + size^2).
  Eigen::VectorXd pushed_by(const std::vector<SteadyLoad>& loads) const;
  /// How torques of joints move z, a row a joint; transposed, how joints move.
  Eigen::MatrixXd joint_levers() const;
  /// z of a motion of the base [rad, m], joints still. Of a mobile base.
  Eigen::VectorXd base_motion(const Vector3d& rotation, const Vector3d& translation) const;
  /// The rotation of the base in z [rad]; 0 of a fixed one.
  Vector3d base_rotation(const Eigen::VectorXd& z) const;

  /// What the robot does by itself: of its joints spring, damper, dry friction that sticks, a stop that
  /// is reached; and the springs and dampers of compliant loops.
  LinearDynamics without_contacts() const;
  /// What the springs of compliant loops exert at this posture.
  std::vector<SteadyLoad> loop_loads() const;
  /// -d(J^T f)/dz of loads that stay as they are while their points move: of gravity a pendulum's
  /// m g l. Exact where the loads are in equilibrium with all else. O(loads + size^3), of which the
  /// cubic part is a product of matrices.
  Eigen::MatrixXd stiffness_of(const std::vector<SteadyLoad>& loads) const;
  /// The weights of all bodies, in a gravity of that direction and size [m/s^2].
  std::vector<SteadyLoad> weights(const Vector3d& gravity) const;

 private:
  Eigen::Index first_joint() const { return size() - robot_links(); }
  Eigen::Index robot_links() const {
    return static_cast<Eigen::Index>(robot_->model().link_count());
  }

  /// With c = x_a - x_b the gap: the force -k c moves z by -k (J_a - J_b)^T c, which changes with the gap,
  /// (J_a - J_b)^T k (J_a - J_b), and with the directions in which the places move, stiffness_of.
  void add_loop_springs(LinearDynamics& dynamics) const;

  const RobotSystem* robot_;
  mutable dts::Workspace<double> workspace_;  ///< articulated inertias, and what a response needs
  Eigen::MatrixXd root_;                      ///< R of M^-1 = R R^T, z = R^-1 q
  bool regular_ = true;
};

/// Of a symmetric matrix; 0 of one without rows.
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

/// Whether a symmetric matrix is positive definite.
bool is_positive(const Eigen::MatrixXd& symmetric);

/// x of A x = b for a symmetric positive definite A.
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The robot on its contacts `springs` under `loads`. Wired controllers are not in it
/// (stable_step.h). O((springs + links) links^2 + loads).
LinearDynamics linear_dynamics(const RobotAtRest& rest, const std::vector<ContactSpring>& springs,
                               const std::vector<SteadyLoad>& loads);

}  // namespace hookpoint::simulation
