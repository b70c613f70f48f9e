#include "simulation/analysis/linear_dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/planar_base.h"
#include "simulation/analysis/eigen_decompositions.h"

namespace hookpoint::simulation {
namespace {

using Workspace = dts::Workspace<double>;

Eigen::Index velocity_size(const RobotSystem& robot) {
  return static_cast<Eigen::Index>(dts::velocity_count(robot.model()));
}

/// M^-1 J^T P, the answer to an impulse.
Eigen::VectorXd to_impulse(const RobotSystem& robot, Workspace& workspace,
                           const dts::BodyPoint<double>& point, const Vector3d& impulse_W) {
  Eigen::VectorXd change(velocity_size(robot));
  dts::velocity_change<double>(robot.model(), workspace, point, impulse_W,
                               {change.data(), static_cast<std::size_t>(change.size())});
  return change;
}

/// To the moment [N m s] that two opposite impulses at the base make.
Eigen::VectorXd to_moment_on_base(const RobotSystem& robot, Workspace& workspace,
                                  const Vector3d& arm, const Vector3d& impulse_W) {
  const Vector3d origin = workspace.bodies[0].p_WB;
  return to_impulse(robot, workspace, {0, origin + arm}, impulse_W) -
         to_impulse(robot, workspace, {0, origin}, impulse_W);
}

Eigen::VectorXd to_joint(const RobotSystem& robot, Workspace& workspace, std::size_t joint) {
  const dts::Model<double>& model = robot.model();
  std::vector<double> torques(model.link_count(), 0.);
  torques[joint] = 1.;
  dts::forward_dynamics<double>(model, {}, torques, workspace);
  Eigen::VectorXd change(velocity_size(robot));
  if (model.mobile())
    dts::write_base_velocity<double>(workspace.base_angular_acceleration,
                                     workspace.base_acceleration,
                                     {change.data(), static_cast<std::size_t>(change.size())});
  for (std::size_t l = 0; l < model.link_count(); ++l)
    change[change.size() - static_cast<Eigen::Index>(model.link_count() - l)] =
        workspace.joint_accelerations[l];
  return change;
}

/// Whether a plane holds the coordinate.
bool is_held(const dts::Model<double>& model, Eigen::Index coordinate) {
  return model.plane_normal() && coordinate < 6 &&
         dts::held_in_plane(static_cast<std::size_t>(coordinate), *model.plane_normal());
}

Eigen::MatrixXd inverse_mass_matrix(const RobotSystem& robot, Workspace& workspace) {
  const Eigen::Index size = velocity_size(robot);
  const auto links = static_cast<Eigen::Index>(robot.model().link_count());
  Eigen::MatrixXd inverse(size, size);
  if (robot.model().mobile()) {
    const Vector3d x{1., 0., 0.}, y{0., 1., 0.}, z{0., 0., 1.};
    const dts::BodyPoint<double> origin{0, workspace.bodies[0].p_WB};
    inverse.col(0) = to_moment_on_base(robot, workspace, y, z);
    inverse.col(1) = to_moment_on_base(robot, workspace, z, x);
    inverse.col(2) = to_moment_on_base(robot, workspace, x, y);
    inverse.col(3) = to_impulse(robot, workspace, origin, x);
    inverse.col(4) = to_impulse(robot, workspace, origin, y);
    inverse.col(5) = to_impulse(robot, workspace, origin, z);
  }
  for (Eigen::Index joint = 0; joint < links; ++joint)
    inverse.col(size - links + joint) = to_joint(robot, workspace, static_cast<std::size_t>(joint));
  Eigen::MatrixXd symmetric = 0.5 * (inverse + inverse.transpose());
  // What a plane holds answers nothing and is coupled to nothing: any inertia does for it.
  for (Eigen::Index k = 0; k < size; ++k)
    if (is_held(robot.model(), k)) symmetric(k, k) = 1.;
  return symmetric;
}

}  // namespace

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  if (symmetric.size() == 0) return 0.;  // a fixed base alone: nothing moves
  return symmetric_eigenvalues(symmetric).maxCoeff();
}

bool is_positive(const Eigen::MatrixXd& symmetric) {
  return Eigen::LLT<Eigen::MatrixXd>(symmetric).info() == Eigen::Success;
}

Eigen::VectorXd solve_positive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::LLT<Eigen::MatrixXd>(A).solve(b);
}

RobotAtRest::RobotAtRest(const RobotSystem& robot) : robot_(&robot), workspace_(robot.workspace()) {
  dts::State<double> still = robot.state();
  still.base_velocity = still.base_angular_velocity = {};
  for (double& rate : still.joint_rates) rate = 0.;
  dts::clear_external_forces(workspace_);
  dts::forward_kinematics(robot.model(), still, workspace_);
  dts::articulated_inertias(robot.model(), workspace_);
  // A force J^T f moves z = R^-1 q by R^T J^T f = R^-1 (M^-1 J^T) f.
  const Eigen::LLT<Eigen::MatrixXd> factors(inverse_mass_matrix(robot, workspace_));
  root_ = factors.matrixL();
  regular_ = factors.info() == Eigen::Success && root_.allFinite();
}

Eigen::MatrixXd RobotAtRest::lever(const dts::BodyPoint<double>& point) const {
  Eigen::MatrixXd moved(size(), 3);
  moved << to_impulse(*robot_, workspace_, point, {1., 0., 0.}),
      to_impulse(*robot_, workspace_, point, {0., 1., 0.}),
      to_impulse(*robot_, workspace_, point, {0., 0., 1.});
  root_.triangularView<Eigen::Lower>().solveInPlace(moved);
  return moved;
}

double RobotAtRest::lever_size(const dts::BodyPoint<double>& point) const {
  const Symmetric3d K = symmetric_part(dts::collision_matrix(robot_->model(), workspace_, point));
  return std::sqrt(std::max(0., K.xx + K.yy + K.zz));
}

Eigen::VectorXd RobotAtRest::pushed_by(const std::vector<SteadyLoad>& loads) const {
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(size());
  for (const SteadyLoad& load : loads)
    pushed += to_impulse(*robot_, workspace_, load.point, load.force);
  root_.triangularView<Eigen::Lower>().solveInPlace(pushed);
  return pushed;
}

Eigen::MatrixXd RobotAtRest::joint_levers() const { return root_.bottomRows(robot_links()); }

Eigen::VectorXd RobotAtRest::base_motion(const Vector3d& rotation,
                                         const Vector3d& translation) const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(size());
  q.head<3>() = eigen(rotation);
  q.segment<3>(3) = eigen(translation);
  for (Eigen::Index k = 0; k < 6; ++k)
    if (is_held(robot_->model(), k)) q[k] = 0.;
  root_.triangularView<Eigen::Lower>().solveInPlace(q);
  return q;
}

Vector3d RobotAtRest::base_rotation(const Eigen::VectorXd& z) const {
  if (!robot_->model().mobile()) return {};
  const Eigen::Vector3d rotation = root_.topRows(3) * z;
  return {rotation.x(), rotation.y(), rotation.z()};
}

LinearDynamics RobotAtRest::without_contacts() const {
  const Eigen::MatrixXd levers = joint_levers();
  LinearDynamics dynamics{
      Eigen::MatrixXd::Zero(size(), size()), Eigen::MatrixXd::Zero(size(), size()), levers, {}};
  for (Eigen::Index joint = 0; joint < levers.rows(); ++joint) {
    const auto l = static_cast<std::size_t>(joint);
    const JointSpring spring = resting_spring(robot_->robot().joints().properties()[l],
                                              robot_->state().joint_positions[l]);
    if (spring.stiffness == 0. && spring.damping == 0.) continue;
    const Eigen::VectorXd moved = levers.row(joint).transpose();
    dynamics.stiffness += spring.stiffness * moved * moved.transpose();
    dynamics.damping += spring.damping * moved * moved.transpose();
  }
  dynamics.of_joints = {dynamics.stiffness, dynamics.damping};
  add_loop_springs(dynamics);
  return dynamics;
}

void RobotAtRest::add_loop_springs(LinearDynamics& dynamics) const {
  for (const LoopSpring& spring : robot_->robot().constraints().springs(workspace_)) {
    const Eigen::MatrixXd apart = lever(spring.places[0]) - lever(spring.places[1]);
    dynamics.stiffness += spring.stiffness * apart * apart.transpose();
    dynamics.damping += spring.damping * apart * apart.transpose();
  }
  const std::vector<SteadyLoad> loads = loop_loads();
  if (!loads.empty()) dynamics.stiffness += stiffness_of(loads);
}

std::vector<SteadyLoad> RobotAtRest::loop_loads() const {
  std::vector<SteadyLoad> loads;
  for (const LoopSpring& spring : robot_->robot().constraints().springs(workspace_)) {
    loads.push_back({spring.places[0], spring.force});
    loads.push_back({spring.places[1], -spring.force});
  }
  return loads;
}

// Where the coordinate i stands before j on the way to the point, turning by i turns all that j
// does to it: d^2 p/dq_i dq_j = a_i x J_j, a_i the axis of i, 0 for one that slides. Rotations of
// the base follow one another in no order, and count half in each. J_j = a_j x r of a coordinate
// that turns, r from its axis to the point, and F . (a_i x (a_j x r)) = a_j . (F r^T) a_i -
// (a_i . a_j) F . r: linear in F r^T, so that the sums over all loads beyond j are enough.
Eigen::MatrixXd RobotAtRest::stiffness_of(const std::vector<SteadyLoad>& loads) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size(), size());
  const dts::Model<double>& model = robot_->model();
  /// Of the loads on a body and on all that it carries.
  struct Sums {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  ///< F p^T
    bool any = false;
  };
  std::vector<Sums> beyond(model.body_count());
  for (const SteadyLoad& load : loads) {
    Sums& sums = beyond[load.point.body];
    sums.force += eigen(load.force);
    sums.moment += eigen(load.force) * eigen(load.point.p_WP).transpose();
    sums.any = true;
  }
  // A body stands behind the one that carries it.
  for (std::size_t body = model.body_count(); body-- > 1;) {
    if (!beyond[body].any) continue;
    Sums& carrier = beyond[model.carrier_of(body)];
    carrier.force += beyond[body].force;
    carrier.moment += beyond[body].moment;
    carrier.any = true;
  }
  struct Coordinate {
    Eigen::Index index;
    Vector3d axis;
    Eigen::Vector3d origin;
    bool slides;
  };
  std::vector<Coordinate> base, links(model.body_count());
  if (model.mobile()) {
    constexpr std::array axes{Vector3d{1., 0., 0.}, Vector3d{0., 1., 0.}, Vector3d{0., 0., 1.}};
    for (Eigen::Index k = 0; k < 3; ++k)
      if (!is_held(model, k))
        base.push_back(
            {k, axes[static_cast<std::size_t>(k)], eigen(workspace_.bodies[0].p_WB), false});
  }
  for (std::size_t body = 1; body < model.body_count(); ++body) {
    const dts::BodyMotion<double>& link = workspace_.bodies[body];
    const dts::Seat& seat = model.seat_of(body);
    const bool slides =
        model.groups()[seat.group].links[seat.link].joint == dts::JointType::prismatic;
    links[body] = {first_joint() + static_cast<Eigen::Index>(body) - 1,
                   link.R_WB * Vector3d{0., 0., 1.}, eigen(link.p_WB), slides};
  }
  /// Sum of F . (a_i x J_j) over the loads of `sums`, all beyond j.
  const auto second = [](const Coordinate& i, const Coordinate& j, const Sums& sums) {
    if (i.slides) return 0.;
    if (j.slides) return sums.force.dot(eigen(cross(i.axis, j.axis)));
    const Eigen::Matrix3d moment = sums.moment - sums.force * j.origin.transpose();
    return eigen(j.axis).dot(moment * eigen(i.axis)) - dot(i.axis, j.axis) * moment.trace();
  };
  const auto add = [&](const Coordinate& i, const Coordinate& j, double value) {
    stiffness(i.index, j.index) -= value;
    if (i.index != j.index) stiffness(j.index, i.index) -= value;
  };
  for (std::size_t i = 0; i < base.size(); ++i)
    for (std::size_t j = i; j < base.size(); ++j)
      add(base[i], base[j],
          0.5 * (second(base[i], base[j], beyond[0]) + second(base[j], base[i], beyond[0])));
  for (std::size_t body = 1; body < model.body_count(); ++body) {
    if (!beyond[body].any) continue;
    for (const Coordinate& turn : base)
      add(turn, links[body], second(turn, links[body], beyond[body]));
    for (std::size_t before = body; before > 0; before = model.carrier_of(before))
      add(links[before], links[body], second(links[before], links[body], beyond[body]));
  }
  return root_.transpose() * stiffness * root_;
}

std::vector<SteadyLoad> RobotAtRest::weights(const Vector3d& gravity) const {
  std::vector<SteadyLoad> loads;
  for (std::size_t body = robot_->model().mobile() ? 0 : 1; body < robot_->model().body_count();
       ++body) {
    const dts::RigidInertia<double>& inertia = robot_->model().inertia(body);
    if (inertia.mass == 0.) continue;
    const dts::BodyMotion<double>& motion = workspace_.bodies[body];
    const Vector3d center = (1. / inertia.mass) * inertia.mass_moment;
    loads.push_back({{body, motion.p_WB + motion.R_WB * center}, inertia.mass * gravity});
  }
  return loads;
}

LinearDynamics linear_dynamics(const RobotAtRest& rest, const std::vector<ContactSpring>& springs,
                               const std::vector<SteadyLoad>& loads) {
  LinearDynamics dynamics = rest.without_contacts();
  for (const ContactSpring& spring : springs) {
    dynamics.stiffness += spring.lever * spring.stiffness * spring.lever.transpose();
    dynamics.damping += spring.lever * spring.damping * spring.lever.transpose();
  }
  dynamics.stiffness += rest.stiffness_of(loads);
  return dynamics;
}

}  // namespace hookpoint::simulation
