#include "simulation/vibration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "integrators/stability_bound.h"

namespace hookpoint::simulation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of the fastest: below, an eigenvalue is a motion that nothing resists, and round-off.
constexpr double least_eigenvalue = 1e-6;

/// The robot's equations at rest, answers to impulses: columns of M^-1 J^T.
class Responses {
 public:
  explicit Responses(const DtsRobot& robot)
      : model_(robot.model()), workspace_(robot.workspace()), still_(robot.state()) {
    still_.base_velocity = still_.base_angular_velocity = {};
    for (double& rate : still_.joint_rates) rate = 0.;
    dts::clear_external_forces(workspace_);
    dts::forward_kinematics(model_, still_, workspace_);
    dts::articulated_inertias(model_, workspace_);
  }

  Eigen::Index size() const { return static_cast<Eigen::Index>(dts::velocity_count(model_)); }
  Eigen::Index first_joint() const {
    return size() - static_cast<Eigen::Index>(model_.link_count());
  }

  Eigen::VectorXd to_impulse(const dts::BodyPoint<double>& point, const Vector3d& impulse_W) {
    Eigen::VectorXd change(size());
    dts::velocity_change<double>(model_, workspace_, point, impulse_W,
                                 {change.data(), static_cast<std::size_t>(size())});
    return change;
  }

  /// To the moment [N m s] that two opposite impulses at the base make.
  Eigen::VectorXd to_moment_on_base(const Vector3d& arm, const Vector3d& impulse_W) {
    const Vector3d origin = workspace_.bodies[0].p_WB;
    return to_impulse({0, origin + arm}, impulse_W) - to_impulse({0, origin}, impulse_W);
  }

  Eigen::VectorXd to_joint(Eigen::Index joint) {
    std::vector<double> torques(model_.link_count(), 0.);
    torques[static_cast<std::size_t>(joint)] = 1.;
    dts::forward_dynamics<double>(model_, {}, torques, workspace_);
    Eigen::VectorXd change(size());
    if (model_.mobile())
      dts::write_base_velocity<double>(workspace_.base_angular_acceleration,
                                       workspace_.base_acceleration,
                                       {change.data(), static_cast<std::size_t>(size())});
    for (std::size_t l = 0; l < model_.link_count(); ++l)
      change[first_joint() + static_cast<Eigen::Index>(l)] = workspace_.joint_accelerations[l];
    return change;
  }

  Eigen::MatrixXd inverse_mass_matrix() {
    Eigen::MatrixXd inverse(size(), size());
    if (model_.mobile()) {
      const Vector3d x{1., 0., 0.}, y{0., 1., 0.}, z{0., 0., 1.};
      const dts::BodyPoint<double> origin{0, workspace_.bodies[0].p_WB};
      inverse.col(0) = to_moment_on_base(y, z);
      inverse.col(1) = to_moment_on_base(z, x);
      inverse.col(2) = to_moment_on_base(x, y);
      inverse.col(3) = to_impulse(origin, x);
      inverse.col(4) = to_impulse(origin, y);
      inverse.col(5) = to_impulse(origin, z);
    }
    for (Eigen::Index joint = 0; first_joint() + joint < size(); ++joint)
      inverse.col(first_joint() + joint) = to_joint(joint);
    return 0.5 * (inverse + inverse.transpose());
  }

 private:
  const dts::Model<double>& model_;
  dts::Workspace<double> workspace_;
  dts::State<double> still_;
};

/// -d(passive_joint_torque)/d(position), /d(rate) at rest.
struct JointSpring {
  double stiffness = 0., damping = 0.;
};

JointSpring joint_spring(const dts::JointProperties<double>& joint, double position) {
  JointSpring spring{joint.stiffness, joint.damping + joint.friction / joint.friction_speed};
  if (position < joint.lower_limit || position > joint.upper_limit) {
    spring.stiffness += joint.limit_stiffness;
    spring.damping += joint.limit_damping;
  }
  return spring;
}

/// The step h at which h^2 K + 2 h C first has the eigenvalue 4: there a mode turns round in every
/// step. Exact for symmetric K and C (docs/contact.md).
double semi_implicit_euler_step(const Vibration& vibration) {
  const double k = largest_eigenvalue(vibration.stiffness);
  const double c = largest_eigenvalue(vibration.damping);
  double low = integrators::semi_implicit_euler_bound({k, c, 1.});
  double high = std::min(2. / std::sqrt(k), 2. / c);
  for (int i = 0; i < 40 && high - low > 1e-12 * high; ++i) {
    const double h = 0.5 * (low + high);
    const Eigen::MatrixXd step = h * h * vibration.stiffness + 2. * h * vibration.damping;
    (largest_eigenvalue(step) < 4. ? low : high) = h;
  }
  return low;
}

/// Of z'' + C z' + K z = 0, for all but motions that nothing resists.
std::vector<std::complex<double>> eigenvalues(const Vibration& vibration) {
  const Eigen::Index n = vibration.stiffness.rows();
  // Rates in units of the fastest, so that positions and velocities are of one size.
  const double unit = std::max(std::sqrt(largest_eigenvalue(vibration.stiffness)),
                               largest_eigenvalue(vibration.damping));
  Eigen::MatrixXd system(2 * n, 2 * n);
  system << Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Identity(n, n),
      -vibration.stiffness / (unit * unit), -vibration.damping / unit;
  const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(system, false).eigenvalues();
  std::vector<std::complex<double>> resisted;
  for (const std::complex<double>& value : all) {
    if (std::abs(value) > least_eigenvalue) resisted.push_back(unit * value);
  }
  return resisted;
}

}  // namespace

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

Vibration linear_vibration(const DtsRobot& robot, const std::vector<ContactSpring>& springs) {
  Responses responses(robot);
  // M^-1 = R R^T, z = R^-1 q: a force J^T f moves z by R^T J^T f = R^-1 (M^-1 J^T) f.
  const Eigen::LLT<Eigen::MatrixXd> factors(responses.inverse_mass_matrix());
  const Eigen::MatrixXd root = factors.matrixL();
  const Eigen::Index n = responses.size();
  Vibration vibration{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n),
                      root.bottomRows(n - responses.first_joint())};
  for (const ContactSpring& spring : springs) {
    Eigen::MatrixXd moved(n, 3);
    moved << responses.to_impulse(spring.point, {1., 0., 0.}),
        responses.to_impulse(spring.point, {0., 1., 0.}),
        responses.to_impulse(spring.point, {0., 0., 1.});
    factors.matrixL().solveInPlace(moved);
    vibration.stiffness += moved * spring.stiffness * moved.transpose();
    vibration.damping += moved * spring.damping * moved.transpose();
  }
  for (Eigen::Index joint = 0; responses.first_joint() + joint < n; ++joint) {
    const auto l = static_cast<std::size_t>(joint);
    const JointSpring spring = joint_spring(robot.joints()[l], robot.state().joint_positions[l]);
    const Eigen::VectorXd moved = root.row(responses.first_joint() + joint).transpose();
    vibration.stiffness += spring.stiffness * moved * moved.transpose();
    vibration.damping += spring.damping * moved * moved.transpose();
  }
  return vibration;
}

double largest_stable_step(std::string_view integrator, const Vibration& vibration) {
  if (vibration.stiffness.isZero(0.) && vibration.damping.isZero(0.)) return infinity;
  if (integrator == "semi_implicit_euler") return semi_implicit_euler_step(vibration);
  const bool rk4 = integrator == "rk4";
  if (!rk4 && integrator != "explicit_euler") return infinity;
  double least = infinity;
  for (const std::complex<double>& eigenvalue : eigenvalues(vibration))
    least = std::min(least, rk4 ? integrators::rk4_bound(eigenvalue)
                                : integrators::explicit_euler_bound(eigenvalue));
  return least;
}

}  // namespace hookpoint::simulation
