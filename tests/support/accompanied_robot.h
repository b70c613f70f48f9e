// The engine's robot and beside its velocities some numbers of a test's own, which the integrator
// takes along: work, heat.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "simulation/dts_engine/robot_system.h"
#include "simulation/experiment/ground.h"

namespace hookpoint::test_support {

/// What it leaves to a test: accelerations, whose last `more` numbers are the rates of its own.
template <std::size_t more>
class AccompaniedRobot : public integrators::HybridSystem {
 public:
  explicit AccompaniedRobot(const simulation::Experiment& experiment)
      : experiment_(experiment),
        inputs_(simulation::initial_inputs(experiment_)),
        ground_(simulation::make_ground(experiment_)),
        robot_(experiment_, 0, &*ground_, inputs_) {}

  std::size_t position_size() const final { return robot_.position_size(); }
  std::size_t velocity_size() const final { return robot_.velocity_size() + more; }
  std::size_t dof_count() const final { return robot_.dof_count(); }
  bool is_active_state(std::size_t i) const final {
    return i >= robot_.velocity_size() || robot_.is_active_state(i);
  }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const final {
    robot_.retract(q0, own(u), q);
  }
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const final {
    robot_.tangent_rate(own(u), own(v), own(du));
    std::ranges::fill(du.last(more), 0.);
  }
  bool chart_exhausted(std::span<const double> u) const final {
    return robot_.chart_exhausted(own(u));
  }
  void commit(double t, std::span<const double> q, std::span<const double> v) override {
    robot_.commit(t, q, own(v));
  }
  void cross_events(std::span<const int> directions) final { robot_.cross_events(directions); }
  void reinitialize(std::span<double> v) override { robot_.reinitialize(own(v)); }
  std::size_t event_count() const final { return robot_.event_count(); }
  void event_values(double t, std::span<const double> q, std::span<const double> v,
                    std::span<double> values) final {
    robot_.event_values(t, q, own(v), values);
  }

 protected:
  /// The robot's part.
  template <class Number>
  static std::span<Number> own(std::span<Number> numbers) {
    return numbers.first(numbers.size() - more);
  }
  static std::span<double> own(std::vector<double>& numbers) {
    return own(std::span<double>(numbers));
  }

  const simulation::Experiment experiment_;
  simulation::WorldInputs inputs_;
  const std::optional<contact::Terrain> ground_;
  simulation::RobotSystem robot_;
};

}  // namespace hookpoint::test_support
