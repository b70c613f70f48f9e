#include "simulation/engine/robot_flight.h"

#include <algorithm>

#include "dts/body_accelerations.h"
#include "dts/configuration.h"

namespace hookpoint::simulation {

using integrators::Status;

RobotFlight::RobotFlight(DtsRobot& robot)
    : robot_(robot),
      q_(robot.position_size()),
      v_(robot.velocity_size()),
      q_start_(q_),
      v_start_(v_),
      a_start_(v_),
      bodies_(robot.model().body_count()),
      stepper_(integrators::make_stepper("rk4", robot)) {
  read();
}

void RobotFlight::read() {
  robot_.write_positions(q_);
  dts::get_velocity<double>(robot_.model(), robot_.state(), v_);
}

Status RobotFlight::begin() {
  q_start_ = q_;
  v_start_ = v_;
  robot_.commit_anchors();
  robot_.accelerate();
  dts::get_acceleration<double>(robot_.model(), robot_.workspace(), a_start_);
  dts::body_accelerations<double>(robot_.model(), robot_.state(), robot_.workspace(), bodies_);
  return integrators::all_finite(a_start_) ? Status::ok : Status::not_finite;
}

Status RobotFlight::fly(double duration) {
  q_ = q_start_;
  v_ = v_start_;
  const Status status = stepper_->step(*this, 0., duration, q_, v_);
  robot_.settle_at(q_, v_);
  return status;
}

void RobotFlight::go_back() { go_to(q_start_, v_start_); }

void RobotFlight::jump(std::span<const double> change) {
  std::transform(v_.begin(), v_.end(), change.begin(), v_.begin(), std::plus<>());
  robot_.settle_at(q_, v_);
}

void RobotFlight::go_to(std::span<const double> q, std::span<const double> v) {
  std::copy(q.begin(), q.end(), q_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  robot_.settle_at(q_, v_);
}

Status RobotFlight::accelerations(integrators::Stage stage, double time, std::span<const double> q,
                                  std::span<const double> v, std::span<double> a) {
  if (stage == integrators::Stage::trial) return robot_.accelerations(stage, time, q, v, a);
  std::copy(a_start_.begin(), a_start_.end(), a.begin());
  return Status::ok;
}

void RobotFlight::retract(std::span<const double> q0, std::span<const double> u,
                          std::span<double> q) const {
  robot_.retract(q0, u, q);
}

void RobotFlight::tangent_rate(std::span<const double> u, std::span<const double> v,
                               std::span<double> du) const {
  robot_.tangent_rate(u, v, du);
}

}  // namespace hookpoint::simulation
