// Flight of a robot between impacts: its dynamics under joint torques and external forces, no
// ground, from one state over as many trial durations as the search for an impact wants.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dts/spatial.h"
#include "integrators/stepper.h"
#include "simulation/dts_engine/articulated_robot.h"

namespace hookpoint::simulation {

/// One step of RK4 a flight. The accelerations at the start are computed once, so a trial costs
/// three evaluations of the dynamics.
class RobotFlight final : public integrators::System {
 public:
  /// `robot` outlives the flight. Allocates; nothing else does.
  explicit RobotFlight(ArticulatedRobot& robot);

  /// Reads the robot's state, after which `positions` and `velocities` are the robot's.
  void read();
  /// From the robot's present state, which is accepted, and in which its accelerations are computed
  /// (and left in its workspace).
  integrators::Status begin();
  /// Puts the robot where it is `duration` [s] after the start.
  integrators::Status fly(double duration);
  /// The present state again, under the present inputs.
  void refresh();
  /// Puts it back at the start.
  void go_back();
  /// Adds `change` to the generalised velocity.
  void jump(std::span<const double> change);
  /// Puts the robot in any state, with the kinematics and external forces of there.
  void go_to(std::span<const double> q, std::span<const double> v);

  std::span<const double> positions() const { return q_; }
  std::span<const double> velocities() const { return v_; }
  /// Of each body's origin at the start, world axes.
  std::span<const dts::Motion<double>> body_accelerations() const { return bodies_; }

  // integrators::System
  std::size_t position_size() const override { return robot_.position_count(); }
  std::size_t velocity_size() const override { return robot_.velocity_count(); }
  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override;
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override {
    robot_.retract(q0, u, q);
  }
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override {
    robot_.tangent_rate(u, v, du);
  }

 private:
  void settle_at(std::span<const double> q, std::span<const double> v);

  ArticulatedRobot& robot_;
  std::vector<double> q_, v_;  // of the robot now
  std::vector<double> q_start_, v_start_, a_start_;
  std::vector<dts::Motion<double>> bodies_;
  std::unique_ptr<integrators::Stepper> stepper_;
};

}  // namespace hookpoint::simulation
