#include "simulation/dts_engine/robot_flight.h"

#include <algorithm>
#include <functional>

#include "dts/body_accelerations.h"
#include "integrators/rk4.h"

namespace hookpoint::simulation {

using integrators::Status;

RobotFlight::RobotFlight(ArticulatedRobot& robot)
    : robot_(robot),
      q_(robot.position_count()),
      v_(robot.velocity_count()),
      q_start_(q_),
      v_start_(v_),
      a_start_(v_),
      bodies_(robot.model().body_count()),
      stepper_(integrators::rk4.make(*this, {})) {
  read();
}

void RobotFlight::read() {
  robot_.write_positions(q_);
  robot_.write_velocities(v_);
}

Status RobotFlight::begin() {
  q_start_ = q_;
  v_start_ = v_;
  robot_.commit_joints();
  robot_.accelerate();
  robot_.write_accelerations(a_start_);
  dts::body_accelerations<double>(robot_.model(), robot_.state(), robot_.workspace(), bodies_);
  return integrators::all_finite(a_start_) ? Status::ok : Status::not_finite;
}

Status RobotFlight::fly(double duration) {
  q_ = q_start_;
  v_ = v_start_;
  const Status status = stepper_->step(*this, 0., duration, q_, v_);
  settle_at(q_, v_);
  return status;
}

void RobotFlight::go_back() { go_to(q_start_, v_start_); }

void RobotFlight::jump(std::span<const double> change) {
  std::transform(v_.begin(), v_.end(), change.begin(), v_.begin(), std::plus<>());
  settle_at(q_, v_);
}

void RobotFlight::go_to(std::span<const double> q, std::span<const double> v) {
  std::copy(q.begin(), q.end(), q_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  settle_at(q_, v_);
}

void RobotFlight::settle_at(std::span<const double> q, std::span<const double> v) {
  robot_.read(q, v);
  refresh();
}

void RobotFlight::refresh() {
  robot_.update_kinematics();
  robot_.apply_external_forces();
}

Status RobotFlight::accelerations(integrators::Stage stage, double /*time*/,
                                  std::span<const double> q, std::span<const double> v,
                                  std::span<double> a) {
  if (stage == integrators::Stage::first) {
    std::copy(a_start_.begin(), a_start_.end(), a.begin());
    return Status::ok;
  }
  settle_at(q, v);
  robot_.accelerate();
  robot_.write_accelerations(a);
  return integrators::all_finite(a) ? Status::ok : Status::not_finite;
}

}  // namespace hookpoint::simulation
