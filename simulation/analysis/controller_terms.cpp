#include "simulation/analysis/controller_terms.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "dts/bias_forces.h"
#include "dts/configuration.h"
#include "dts/forward_kinematics.h"
#include "dts/mass_matrix.h"
#include "dts/planar_base.h"
#include "simulation/dts_engine/articulated_robot.h"
#include "simulation/dts_engine/robot_description.h"
#include "simulation/experiment/joint_type.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The robot's part of what is published.
dts::State<double> state_of(const Experiment& experiment, std::size_t robot,
                            const WorldState& published) {
  std::size_t body = 0, joint = 0;
  for (std::size_t i = 0; i < robot; ++i) {
    body += body_count(experiment.robots[i]);
    joint += joint_count(experiment.robots[i]);
  }
  dts::State<double> state;
  const BodyState& base = published.bodies[body];
  state.base_position = base.position;
  state.base_orientation = base.orientation;
  state.base_velocity = base.velocity;
  state.base_angular_velocity = base.angular_velocity;
  for (std::size_t l = 0; l < joint_count(experiment.robots[robot]); ++l) {
    state.joint_positions.push_back(published.joints[joint + l].angle);
    state.joint_rates.push_back(published.joints[joint + l].rate);
  }
  return state;
}

constexpr std::size_t base_velocities = 6;

/// Of the engine's velocities those that are free: a plane holds three of its base's.
std::vector<std::size_t> free_velocities(const RobotSpec& robot) {
  const std::size_t all = (robot.mobile ? base_velocities : 0) + joint_count(robot);
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < all; ++k)
    if (!robot.plane_normal || k >= base_velocities || !dts::held_in_plane(k, *robot.plane_normal))
      indices.push_back(k);
  return indices;
}

/// The columns `chosen` of rows of so many numbers.
std::vector<double> columns_of(const std::vector<double>& matrix, std::size_t columns,
                               const std::vector<std::size_t>& chosen) {
  std::vector<double> picked;
  if (columns == 0) return picked;
  picked.reserve(matrix.size());
  for (std::size_t row = 0; row + columns <= matrix.size(); row += columns)
    for (const std::size_t column : chosen) picked.push_back(matrix[row + column]);
  return picked;
}

std::vector<VelocityCoordinate> coordinates_of(const RobotSpec& robot,
                                               const std::vector<std::size_t>& free) {
  std::vector<VelocityCoordinate> coordinates;
  for (const std::size_t k : free) {
    if (!robot.mobile || k >= base_velocities) break;
    const bool turns = k < 3;
    coordinates.push_back({robot.name + "." + robot.base.name +
                               (turns ? ".angular_velocity." : ".velocity.") + "xyz"[k % 3],
                           turns ? "rad/s" : "m/s"});
  }
  for_each_link(robot, [&](const TreeLink& at) {
    coordinates.push_back({robot.name + "." + at.chain.name + "." + at.link.body.name + ".rate",
                           joint_type(at.link.joint).units.rate});
  });
  return coordinates;
}

/// v' of a robot that is moved to other states.
class FreeMotion {
 public:
  FreeMotion(const Experiment& experiment, std::size_t robot, const dts::State<double>& state,
             const std::vector<double>& torques)
      : inputs_(initial_inputs(experiment)), robot_(experiment, robot, inputs_) {
    std::ranges::copy(torques, inputs_.joint_torques.begin() +
                                   static_cast<std::ptrdiff_t>(inputs_.first_joints[robot]));
    const ArticulatedRobot& at = robot_;
    q_.resize(at.position_count());
    v_.resize(at.velocity_count());
    moved_ = q_;
    dts::get_velocity<double>(at.model(), state, v_);
    if (at.model().mobile()) {
      const Vector3d& p = state.base_position;
      const Quaterniond& r = state.base_orientation;
      std::ranges::copy(std::array{p.x, p.y, p.z, r.w, r.x, r.y, r.z}, q_.begin());
    }
    std::ranges::copy(state.joint_positions,
                      q_.end() - static_cast<std::ptrdiff_t>(state.joint_positions.size()));
  }

  Eigen::VectorXd accelerations(const std::vector<double>& displacement,
                                const std::vector<double>& change) {
    std::vector<double> v = v_, a(v_.size());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += change[i];
    robot_.retract(q_, displacement, moved_);
    robot_.read(moved_, v);
    robot_.update_kinematics();
    robot_.apply_external_forces();
    robot_.accelerate();
    robot_.write_accelerations(a);
    return Eigen::Map<const Eigen::VectorXd>(a.data(), static_cast<Eigen::Index>(a.size()));
  }

 private:
  WorldInputs inputs_;
  ArticulatedRobot robot_;
  std::vector<double> q_, v_, moved_;
};

}  // namespace

ControllerTerms::ControllerTerms(const Experiment& experiment, std::size_t robot,
                                 const WorldState& state)
    : ControllerTerms(experiment, robot, state_of(experiment, robot, state)) {}

ControllerTerms::ControllerTerms(const Experiment& experiment, std::size_t robot)
    : ControllerTerms(experiment, robot, initial_state(experiment.robots[robot])) {}

ControllerTerms::ControllerTerms(const Experiment& experiment, std::size_t robot,
                                 dts::State<double> state)
    : experiment_(&experiment),
      robot_(robot),
      free_(free_velocities(experiment.robots[robot])),
      coordinates_(coordinates_of(experiment.robots[robot], free_)),
      bodies_(body_names(experiment.robots[robot])),
      model_(describe_robot(experiment.robots[robot])),
      state_(std::move(state)),
      workspace_(model_) {
  dts::forward_kinematics(model_, state_, workspace_);
  composite_ = dts::composite_bodies(model_, workspace_);
  center_ = dts::center_of_mass(model_, composite_, state_.base_position);
  center_.jacobian = in_free(center_.jacobian);
}

std::vector<double> ControllerTerms::in_free(const std::vector<double>& rows) const {
  return columns_of(rows, dts::velocity_count(model_), free_);
}

std::vector<double> ControllerTerms::mass_matrix() const {
  const std::vector<double> M = in_free(dts::mass_matrix(model_, composite_));
  std::vector<double> rows;
  for (const std::size_t row : free_) {
    const auto begin = M.begin() + static_cast<std::ptrdiff_t>(row * free_.size());
    rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(free_.size()));
  }
  return rows;
}

std::vector<double> ControllerTerms::bias_forces() const {
  dts::Workspace<double> workspace = workspace_;
  return in_free(dts::bias_forces(model_, experiment_->gravity, workspace));
}

std::vector<double> ControllerTerms::gravity_forces() const {
  return dts::gravity_forces(center_, experiment_->gravity);
}

std::vector<double> ControllerTerms::jacobian(std::size_t body, const Vector3d& point) const {
  const dts::BodyMotion<double>& at = workspace_.bodies[body];
  return in_free(dts::body_jacobian(model_, composite_, state_.base_position, body,
                                    at.p_WB + at.R_WB * point));
}

LinearisedRobot ControllerTerms::linearised(const std::vector<double>& torques) const {
  const auto n = static_cast<Eigen::Index>(coordinates_.size());
  const auto joints = static_cast<Eigen::Index>(model_.link_count());
  FreeMotion motion(*experiment_, robot_, state_, torques);
  // Where rounding and what the difference leaves out are alike: the cube root of the precision.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon());
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  if (model_.mobile() && !model_.plane_normal()) {
    // Of a turn d against a base that itself turns, d' = w' + w x d.
    const Vector3d& w = state_.base_angular_velocity;
    A.topLeftCorner(3, 3) << 0., -w.z, w.y, w.z, 0., -w.x, -w.y, w.x, 0.;
  }
  const std::vector<double> none(dts::velocity_count(model_));
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t moved = free_[static_cast<std::size_t>(k)];
    std::vector<double> forth = none, back = none;
    forth[moved] = step;
    back[moved] = -step;
    A.col(k).tail(n) =
        (motion.accelerations(forth, none) - motion.accelerations(back, none))(free_) / (2. * step);
    A.col(n + k).tail(n) =
        (motion.accelerations(none, forth) - motion.accelerations(none, back))(free_) / (2. * step);
  }
  Matrix B = Matrix::Zero(2 * n, joints);
  if (joints > 0) {
    const std::vector<double> M = mass_matrix();
    Matrix drives = Matrix::Zero(n, joints);
    drives.bottomRows(joints).setIdentity();
    B.bottomRows(n) = Eigen::Map<const Matrix>(M.data(), n, n).ldlt().solve(drives);
  }
  return {{A.data(), A.data() + A.size()}, {B.data(), B.data() + B.size()}};
}

}  // namespace hookpoint::simulation
