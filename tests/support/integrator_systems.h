// Small systems with known motion, for integrators.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "integrators/hybrid_system.h"
#include "integrators/rotation_rate.h"
#include "integrators/stepper.h"

namespace hookpoint::integrators {

/// For GoogleTest's messages.
inline void PrintTo(const StepperDescription& stepper, std::ostream* out) { *out << stepper.name; }

}  // namespace hookpoint::integrators

namespace hookpoint::testing {

using integrators::Stage;
using integrators::Status;

/// What a suite over integrators calls its cases.
struct StepperName {
  template <class Info>
  std::string operator()(const Info& info) const {
    return std::string(info.param.name);
  }
};

/// A system of one coordinate in a vector space.
class OneCoordinate : public integrators::HybridSystem {
 public:
  std::size_t position_size() const override { return 1; }
  std::size_t velocity_size() const override { return 1; }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    q_out[0] = q0[0] + u[0];
  }
  void tangent_rate(std::span<const double>, std::span<const double> v,
                    std::span<double> du) const override {
    du[0] = v[0];
  }
};

/// q'' = -sin q.
class Pendulum final : public OneCoordinate {
 public:
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -std::sin(q[0]);
    return Status::ok;
  }
};

/// A free body with principal moments (A, A, C) about its own axes; q = orientation w,x,y,z, v =
/// w_WB.
class FreeBody : public integrators::HybridSystem {
 public:
  static constexpr double A = 1., C = 2.2;
  mutable double farthest = 0.;  ///< greatest |u| that was asked for [rad]

  static Quaterniond start() { return from_roll_pitch_yaw(0.3, -0.7, 1.9); }
  static constexpr Vector3d w_body{1.1, -0.4, 1.7};
  static std::vector<double> start_orientation() {
    return {start().w, start().x, start().y, start().z};
  }
  static std::vector<double> start_velocity() {
    const Vector3d w = rotate(start(), w_body);
    return {w.x, w.y, w.z};
  }
  /// Sine of half the angle from the exact orientation at `time`: R(t) = exp(t L/A) R(0)
  /// exp(t (1 - C/A) w3 e3), precession about L and spin about the symmetry axis.
  static double angle_from_exact(double time, std::span<const double> q) {
    const Vector3d L = rotate(start(), Vector3d{A * w_body.x, A * w_body.y, C * w_body.z});
    const Quaterniond exact = exponential((time / A) * L) * start() *
                              exponential(Vector3d{0., 0., time * (1. - C / A) * w_body.z});
    const Quaterniond error = conjugate(exact) * Quaterniond{q[0], q[1], q[2], q[3]};
    return std::hypot(error.x, error.y, error.z);
  }
  static Vector3d momentum(std::span<const double> q, std::span<const double> v) {
    const Matrix3d R = rotation_matrix(Quaterniond{q[0], q[1], q[2], q[3]});
    const Vector3d w = transpose_times(R, Vector3d{v[0], v[1], v[2]});
    return R * Vector3d{A * w.x, A * w.y, C * w.z};
  }
  static double energy(std::span<const double> q, std::span<const double> v) {
    return 0.5 * dot(momentum(q, v), Vector3d{v[0], v[1], v[2]});
  }

  std::size_t position_size() const override { return 4; }
  std::size_t velocity_size() const override { return 3; }
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    const Matrix3d R = rotation_matrix(Quaterniond{q[0], q[1], q[2], q[3]});
    const Vector3d w = transpose_times(R, Vector3d{v[0], v[1], v[2]});
    const Vector3d torque = -hookpoint::cross(w, Vector3d{A * w.x, A * w.y, C * w.z});
    const Vector3d dw = R * Vector3d{torque.x / A, torque.y / A, torque.z / C};
    a[0] = dw.x, a[1] = dw.y, a[2] = dw.z;
    return Status::ok;
  }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    const Quaterniond q = integrators::rotation_retract(Quaterniond{q0[0], q0[1], q0[2], q0[3]},
                                                        Vector3d{u[0], u[1], u[2]});
    q_out[0] = q.w, q_out[1] = q.x, q_out[2] = q.y, q_out[3] = q.z;
  }
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override {
    const Vector3d turned{u[0], u[1], u[2]};
    farthest = std::max(farthest, norm(turned));
    const Vector3d rate = integrators::rotation_tangent_rate(turned, Vector3d{v[0], v[1], v[2]});
    du[0] = rate.x, du[1] = rate.y, du[2] = rate.z;
  }
  bool chart_exhausted(std::span<const double> u) const override {
    return norm(Vector3d{u[0], u[1], u[2]}) > 2.;
  }
};

/// 1 kg dropped from `height` on an undamped spring: half waves of it between parabolas, for ever.
class Ball final : public OneCoordinate {
 public:
  static constexpr double k = 1e4, g = 9.81, height = 0.5;

  double fall_time() const { return std::sqrt(2. * height / g); }
  /// d = x0 (1 - cos wt) + (v0/w) sin wt comes back to 0 after 2 (pi - atan(v0/(w x0)))/w, x0 =
  /// g/w^2.
  double contact_time() const {
    const double w = std::sqrt(k), impact_speed = g * fall_time();
    return 2. * (std::numbers::pi - std::atan(impact_speed * w / g)) / w;
  }
  double period() const { return 2. * fall_time() + contact_time(); }
  /// Least distance in time of a commit from `time` [s].
  double nearest_commit(double time) const {
    double least = INFINITY;
    for (const double commit : commits_) least = std::min(least, std::abs(commit - time));
    return least;
  }

  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = spring(q[0]) - g;
    return Status::ok;
  }
  Status split_accelerations(double, std::span<const double> q, std::span<const double>,
                             std::span<double> a_free, std::span<double> a_contact) override {
    a_free[0] = -g;
    a_contact[0] = spring(q[0]);
    return Status::ok;
  }
  void commit(double t, std::span<const double>, std::span<const double>) override {
    commits_.push_back(t);
  }
  std::size_t event_count() const override { return 1; }
  void event_values(double, std::span<const double> q, std::span<const double>,
                    std::span<double> values) override {
    values[0] = q[0];
  }

 private:
  static double spring(double q) { return q < 0. ? -k * q : 0.; }
  std::vector<double> commits_;
};

}  // namespace hookpoint::testing
