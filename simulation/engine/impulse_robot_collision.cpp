// What the collisions ask of an articulated robot, answered by the recursion of forward dynamics
// with impulses in place of forces.
#include <algorithm>

#include "dts/impulse_response.h"
#include "simulation/engine/impulse_robot.h"

namespace hookpoint::simulation {
namespace {

// Share of tr K added to K: a point of a robot with a fixed base may have directions in which
// nothing can move it, and the collision is to find that they play no part.
constexpr double kYielding = 1e-13;

}  // namespace

// After forward_kinematics of a new configuration the workspace has articulated inertias of an
// older one.
void ImpulseRobot::ready_inertias() {
  if (inertias_ready_) return;
  dts::articulated_inertias(robot_.model(), robot_.workspace());
  inertias_ready_ = true;
}

dts::BodyPoint<double> ImpulseRobot::body_point(std::size_t point) const {
  const Point& at = points_[point];
  return {at.body, robot_.workspace().bodies[at.body].p_WB + at.arm};
}

Vector3d ImpulseRobot::velocity(std::size_t point) const {
  const dts::BodyMotion<double>& body = robot_.workspace().bodies[points_[point].body];
  return body.v_WB + cross(body.w_WB, points_[point].arm);
}

Vector3d ImpulseRobot::flight_acceleration(std::size_t point) const {
  const Point& at = points_[point];
  const dts::Motion<double>& a = flight_.body_accelerations()[at.body];
  const Vector3d& w = robot_.workspace().bodies[at.body].w_WB;
  // Of a ball's place of contact only the material turns; the place stays under the centre.
  return a.linear + cross(a.angular, at.arm) + cross(w, cross(w, at.center));
}

Symmetric3d ImpulseRobot::collision_matrix(std::size_t point) {
  ready_inertias();
  Symmetric3d K =
      symmetric_part(dts::collision_matrix(robot_.model(), robot_.workspace(), body_point(point)));
  const double yielding = kYielding * (K.xx + K.yy + K.zz);
  K.xx += yielding;
  K.yy += yielding;
  K.zz += yielding;
  return K;
}

void ImpulseRobot::strike(std::size_t point, const Vector3d& impulse) {
  ready_inertias();
  dts::velocity_change<double>(robot_.model(), robot_.workspace(), body_point(point), impulse,
                               change_);
  flight_.jump(change_);
  impulses_[points_[point].body] += impulse;
}

double ImpulseRobot::begin_reversal(std::size_t struck) {
  flight_.begin();
  inertias_ready_ = true;
  return -dot(flight_acceleration(struck), points_[struck].ground.normal);
}

bool ImpulseRobot::find_reversal(std::span<contact::ReversalPoint> points,
                                 std::span<const std::size_t> index, double tolerance) {
  const std::size_t count = points.size();
  if (count > work_.size()) return false;
  ready_inertias();
  for (std::size_t i = 0; i < count; ++i) {
    velocities_[i] = velocity(index[i]);
    for (std::size_t j = i; j < count; ++j) {
      const Matrix3d K = dts::impulse_response(robot_.model(), robot_.workspace(),
                                               body_point(index[j]), body_point(index[i]));
      couplings_[i * count + j] = K;
      couplings_[j * count + i] = transpose(K);
    }
  }
  return contact::reverse_together(points, std::span(couplings_).first(count * count),
                                   std::span(velocities_).first(count),
                                   std::span(work_).first(count), tolerance);
}

}  // namespace hookpoint::simulation
