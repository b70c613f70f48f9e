// The truth that the recursions are held against: the mass matrix written out. Body Jacobians from
// world kinematics, M = sum J^T diag(I, m) J with the rotors' inertias on its diagonal, and J' v by
// differentiating those same Jacobians along the motion with dual numbers, so that no velocity
// product is ever derived by hand. Shares nothing with dts/ but its descriptions.
#pragma once

#include <eigen3/Eigen/Dense>
#include <eigen3/unsupported/Eigen/AutoDiff>
#include <vector>

#include "dts/model.h"
#include "dts/state.h"

namespace hookpoint::tests {

using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

inline Eigen::Vector3d eigen(const Vector3d& a) { return {a.x, a.y, a.z}; }
inline Eigen::Matrix3d eigen(const Symmetric3d& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz).finished();
}
inline Eigen::Matrix3d eigen(const Matrix3d& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz).finished();
}
inline Eigen::Matrix3d eigen(const Quaterniond& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
}

/// A number and its rate along the motion.
inline Dual moving(double value, double rate) {
  return Dual(value, Eigen::Matrix<double, 1, 1>(rate));
}

template <class Scalar>
struct DenseBody {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Jacobian = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;
  Eigen::Matrix<Scalar, 3, 3> R;  // R_WB
  Vector p, c;                    // origin, centre of mass
  Jacobian J_angular, J_linear;   // of the angular velocity; of the velocity of c
};

/// Jacobians of one robot in one configuration; columns are [w_WB, v_WB] of a mobile base, then the
/// joints.
template <class Scalar>
class DenseKinematics {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  DenseKinematics(const dts::RobotDescription& robot, const Vector& p, const Matrix& R,
                  const std::vector<Scalar>& q)
      : robot_(robot), offset_(robot.mobile ? 6 : 0), columns_(offset_ + int(q.size())) {
    base_origin_ = p;
    add_body(p, R, robot.base.center_of_mass, {});
    int joint = 0;
    for (const auto& chain : robot.chains) {
      const DenseBody<Scalar>& carrier = bodies_[chain.carrier];
      Vector origin = carrier.p + carrier.R * eigen(chain.hip_position).cast<Scalar>();
      Matrix axes = carrier.R * eigen(chain.hip_orientation).cast<Scalar>();
      std::vector<Axis> path = paths_[chain.carrier];
      for (const auto& link : chain.links) {
        const bool revolute = link.joint == dts::JointType::revolute;
        const Scalar theta = revolute ? Scalar(link.theta + q[joint]) : Scalar(link.theta);
        const Scalar d = revolute ? Scalar(link.d) : Scalar(link.d + q[joint]);
        origin = origin + axes * eigen(link.joint_position).cast<Scalar>();
        axes = axes * eigen(link.joint_orientation).cast<Scalar>();
        axes = axes * Matrix(about(0, Scalar(link.alpha)));
        origin = origin + axes.col(0) * Scalar(link.a);
        axes = axes * Matrix(about(2, theta));
        origin = origin + axes.col(2) * d;
        path.push_back({joint, revolute, axes.col(2), origin});
        add_body(origin, axes, link.mass.center_of_mass, path);
        ++joint;
      }
    }
  }

  const std::vector<DenseBody<Scalar>>& bodies() const { return bodies_; }
  int columns() const { return columns_; }

  /// Jacobian of the velocity of the point `x` (world) that moves with `body`.
  typename DenseBody<Scalar>::Jacobian point_jacobian(std::size_t body, const Vector& x) const {
    return linear_jacobian(x, paths_[body]);
  }

 private:
  struct Axis {
    int joint;
    bool revolute;
    Vector z, origin;
  };

  static Matrix about(int axis, const Scalar& angle) {
    using std::cos, std::sin;
    const Scalar c = cos(angle), s = sin(angle);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Matrix R = Matrix::Identity();
    R(u, u) = c, R(v, v) = c, R(v, u) = s, R(u, v) = -s;
    return R;
  }

  typename DenseBody<Scalar>::Jacobian linear_jacobian(const Vector& x,
                                                       const std::vector<Axis>& path) const {
    typename DenseBody<Scalar>::Jacobian J(3, columns_);
    J.setZero();
    for (int k = 0; k < offset_; ++k) {
      const Vector unit = Vector::Unit(k % 3);
      J.col(k) = k < 3 ? Vector(unit.cross(Vector(x - base_origin_))) : unit;
    }
    for (const Axis& axis : path) {
      J.col(offset_ + axis.joint) =
          axis.revolute ? Vector(axis.z.cross(Vector(x - axis.origin))) : axis.z;
    }
    return J;
  }

  void add_body(const Vector& p, const Matrix& R, const Vector3d& center,
                const std::vector<Axis>& path) {
    DenseBody<Scalar> body;
    body.R = R;
    body.p = p;
    body.c = p + R * eigen(center).cast<Scalar>();
    body.J_linear = linear_jacobian(body.c, path);
    body.J_angular.setZero(3, columns_);
    for (int k = 0; k < std::min(offset_, 3); ++k) body.J_angular(k, k) = Scalar(1.);
    for (const Axis& axis : path) {
      if (axis.revolute) body.J_angular.col(offset_ + axis.joint) = axis.z;
    }
    bodies_.push_back(body);
    paths_.push_back(path);
  }

  const dts::RobotDescription& robot_;
  int offset_, columns_;
  Vector base_origin_;
  std::vector<DenseBody<Scalar>> bodies_;
  std::vector<std::vector<Axis>> paths_;
};

/// A constant wrench on a body: a force [N] at a world point and a torque [N m], world axes.
struct DenseForce {
  std::size_t body = 0;
  Eigen::Vector3d point, force, torque;
};

struct DenseWrench {
  Eigen::Vector3d moment, force;
};

/// Of all bodies together, the angular part about the world's origin.
struct DenseMomentum {
  Eigen::Vector3d linear, angular;
  double kinetic_energy = 0.;
};

/// One robot in one state: M, its accelerations, and what follows from them.
class DenseDynamics {
 public:
  DenseDynamics(const dts::RobotDescription& robot, const dts::State<double>& state)
      : robot_(robot), still_(at_rest(robot, state)) {
    velocity_.setZero(still_.columns());
    const Eigen::Vector3d w = eigen(state.base_angular_velocity), v = eigen(state.base_velocity);
    if (robot.mobile) velocity_.head(6) << w, v;
    for (std::size_t l = 0; l < state.joint_rates.size(); ++l) {
      velocity_[still_.columns() - state.joint_rates.size() + l] = state.joint_rates[l];
    }
    differentiate(state);
    M_.setZero(still_.columns(), still_.columns());
    for (std::size_t i = 0; i < still_.bodies().size(); ++i) {
      const auto& body = still_.bodies()[i];
      M_ += body.J_angular.transpose() * inertia(i) * body.J_angular +
            properties(i).mass * body.J_linear.transpose() * body.J_linear;
    }
    Eigen::Index joint = robot.mobile ? 6 : 0;
    for (const auto& chain : robot.chains) {
      for (const auto& link : chain.links) M_.diagonal()[joint++] += link.rotor_inertia;
    }
  }

  const Eigen::MatrixXd& mass_matrix() const { return M_; }
  const Eigen::VectorXd& velocity() const { return velocity_; }
  const DenseKinematics<double>& kinematics() const { return still_; }

  DenseMomentum momentum() const {
    DenseMomentum sum{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                      0.5 * velocity_.dot(M_ * velocity_)};
    for (std::size_t i = 0; i < still_.bodies().size(); ++i) {
      const auto& body = still_.bodies()[i];
      const Eigen::Vector3d p = properties(i).mass * (body.J_linear * velocity_);
      sum.linear += p;
      sum.angular += body.c.cross(p) + inertia(i) * (body.J_angular * velocity_);
    }
    return sum;
  }

  /// v' of M v' = tau + sum J^T (wrenches - what the velocities take).
  Eigen::VectorXd accelerations(const Eigen::Vector3d& gravity, const std::vector<double>& torques,
                                const std::vector<DenseForce>& forces) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(M_.rows());
    for (std::size_t l = 0; l < torques.size(); ++l) {
      f[M_.rows() - torques.size() + l] = torques[l];
    }
    for (std::size_t i = 0; i < still_.bodies().size(); ++i) {
      const auto& body = still_.bodies()[i];
      const Eigen::Vector3d w = body.J_angular * velocity_;
      f += body.J_linear.transpose() * (properties(i).mass * (gravity - linear_bias_[i]));
      f -= body.J_angular.transpose() * (inertia(i) * angular_bias_[i] + w.cross(inertia(i) * w));
    }
    for (const DenseForce& x : forces) {
      f += still_.point_jacobian(x.body, x.point).transpose() * x.force +
           still_.bodies()[x.body].J_angular.transpose() * x.torque;
    }
    return M_.fullPivLu().solve(f);
  }

  /// J' v of the point `x` (world) that moves with `body`.
  Eigen::Vector3d point_bias(std::size_t body, const Eigen::Vector3d& x) const {
    const auto& at = still_.bodies()[body];
    const Eigen::Vector3d r = x - at.c, w = at.J_angular * velocity_;
    return linear_bias_[body] + angular_bias_[body].cross(r) + w.cross(w.cross(r));
  }

  /// The wrench of chain `k` on its carrier about its hip: less the rate of momentum of the chain
  /// and all that hangs on it, plus what acts on them.
  DenseWrench hip_wrench(std::size_t k, const Eigen::VectorXd& a, const Eigen::Vector3d& gravity,
                         const std::vector<DenseForce>& forces) const {
    std::vector<bool> beyond(still_.bodies().size());
    std::size_t next = 1;
    for (std::size_t j = 0; j < robot_.chains.size(); ++j) {
      const bool hangs = j == k || beyond[robot_.chains[j].carrier];
      for (std::size_t n = 0; n < robot_.chains[j].links.size(); ++n) beyond[next++] = hangs;
    }
    const auto& carrier = still_.bodies()[robot_.chains[k].carrier];
    const Eigen::Vector3d hip = carrier.p + carrier.R * eigen(robot_.chains[k].hip_position);
    DenseWrench on_carrier{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (std::size_t i = 1; i < beyond.size(); ++i) {
      if (!beyond[i]) continue;
      const auto& body = still_.bodies()[i];
      const Eigen::Vector3d w = body.J_angular * velocity_;
      const Eigen::Vector3d dw = body.J_angular * a + angular_bias_[i];
      const Eigen::Vector3d force =
          properties(i).mass * (body.J_linear * a + linear_bias_[i] - gravity);
      on_carrier.force -= force;
      on_carrier.moment -= (body.c - hip).cross(force) + inertia(i) * dw + w.cross(inertia(i) * w);
    }
    for (const DenseForce& x : forces) {
      if (!beyond[x.body]) continue;
      on_carrier.force += x.force;
      on_carrier.moment += x.torque + (x.point - hip).cross(x.force);
    }
    return on_carrier;
  }

 private:
  static DenseKinematics<double> at_rest(const dts::RobotDescription& robot,
                                         const dts::State<double>& state) {
    return {robot, eigen(state.base_position), eigen(state.base_orientation),
            state.joint_positions};
  }

  const dts::MassProperties<double>& properties(std::size_t body) const {
    static const dts::MassProperties<double> nothing;
    if (body == 0) return robot_.mobile ? robot_.base : nothing;
    --body;
    for (const auto& chain : robot_.chains) {
      if (body < chain.links.size()) return chain.links[body].mass;
      body -= chain.links.size();
    }
    return nothing;
  }
  Eigen::Matrix3d inertia(std::size_t body) const {
    const Eigen::Matrix3d& R = still_.bodies()[body].R;
    return R * eigen(properties(body).inertia) * R.transpose();
  }

  void differentiate(const dts::State<double>& state) {
    Eigen::Matrix<Dual, 3, 1> p;
    Eigen::Matrix<Dual, 3, 3> R;
    const Eigen::Vector3d w =
        robot_.mobile ? eigen(state.base_angular_velocity) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d v = robot_.mobile ? eigen(state.base_velocity) : Eigen::Vector3d::Zero();
    const Eigen::Matrix3d R0 = eigen(state.base_orientation);
    for (int column = 0; column < 3; ++column) {
      const Eigen::Vector3d rate = w.cross(R0.col(column));
      for (int row = 0; row < 3; ++row) R(row, column) = moving(R0(row, column), rate[row]);
      p[column] = moving(eigen(state.base_position)[column], v[column]);
    }
    std::vector<Dual> q;
    for (std::size_t l = 0; l < state.joint_positions.size(); ++l) {
      q.push_back(moving(state.joint_positions[l], state.joint_rates[l]));
    }
    const DenseKinematics<Dual> in_motion(robot_, p, R, q);
    for (const auto& body : in_motion.bodies()) {
      angular_bias_.push_back(rate_times_velocity(body.J_angular));
      linear_bias_.push_back(rate_times_velocity(body.J_linear));
    }
  }
  Eigen::Vector3d rate_times_velocity(const DenseBody<Dual>::Jacobian& J) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < J.cols(); ++column) {
        sum[row] += J(row, column).derivatives()[0] * velocity_[column];
      }
    }
    return sum;
  }

  const dts::RobotDescription& robot_;
  DenseKinematics<double> still_;
  Eigen::VectorXd velocity_;
  std::vector<Eigen::Vector3d> angular_bias_, linear_bias_;
  Eigen::MatrixXd M_;
};

}  // namespace hookpoint::tests
