// A gait on the bench with the measures of configs/robots/hexapod_legs.hook, its feet seen through
// the forward kinematics of its goals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "control/leg_kinematics.h"
#include "control/registry.h"

namespace hookpoint::testing {

inline constexpr std::size_t legs = 6;

class HexapodGaitBench {
 public:
  explicit HexapodGaitBench(const std::string& class_name) {
    const control::ComponentClass* type = control::Registry::instance().find(class_name);
    if (type == nullptr) throw std::runtime_error("no class " + class_name);
    gait_ = type->make();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      const double side = leg < 3 ? -1. : 1., row = double(leg % 3) - 1.;
      heading_[leg] = side * std::numbers::pi / 2.;
      hip_[leg] = {0.12 * row, 0.1 * side, 0.};
      const double outwards = heading_[leg] - side * row * std::numbers::pi / 6.;
      neutral_[leg] =
          hip_[leg] + Vector3d{reach * std::cos(outwards), reach * std::sin(outwards), 0.};
      set("hip_x", leg, hip_[leg].x);
      set("hip_y", leg, hip_[leg].y);
      set("hip_heading", leg, heading_[leg]);
      set("foot_x", leg, neutral_[leg].x);
      set("foot_y", leg, neutral_[leg].y);
    }
  }

  void set(const std::string& name, double value) { values()[index(name)] = value; }
  void set(const std::string& name, std::size_t i, double value) {
    values()[index(name) + i] = value;
  }
  double get(const std::string& name, std::size_t i = 0) const {
    return gait_->values()[index(name) + i];
  }
  void drive(const std::string& name, std::size_t i) { gait_->set_driven(index(name) + i, true); }
  bool stance(std::size_t leg) const { return get("stance", leg) > 0.5; }

  void start(double period) {
    period_ = period;
    count_ = 0;
    gait_->start(period);
  }
  void update() {
    gait_->update({double(count_) * period_, period_, count_});
    ++count_;
  }
  double time() const { return double(count_) * period_; }

  /// p_BF of the leg's goals, body axes.
  Vector3d foot(std::size_t leg) const {
    const control::LegAngles angles{get("goal", 3 * leg), get("goal", 3 * leg + 1),
                                    get("goal", 3 * leg + 2)};
    const Vector3d p = control::foot_position(
        {get("coxa_length"), get("femur_length"), get("tibia_length")}, angles);
    const double c = std::cos(heading_[leg]), s = std::sin(heading_[leg]);
    return hip_[leg] + Vector3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  }
  const Vector3d& neutral(std::size_t leg) const { return neutral_[leg]; }
  control::Component& component() { return *gait_; }

  /// From hip to neutral foot; with the lengths and body_height 0.1 the joint angles are then 0
  /// (+-spread), 30 deg, -120 deg.
  static constexpr double reach = 0.05 + 0.1 * 0.86602540378443865;

 private:
  std::span<double> values() { return gait_->values(); }
  std::size_t index(const std::string& name) const {
    for (const control::PortDescription& port : gait_->ports()) {
      if (port.name == name) return port.first;
    }
    throw std::runtime_error("no port " + name);
  }

  std::unique_ptr<control::Component> gait_;
  std::array<Vector3d, legs> hip_, neutral_;
  std::array<double, legs> heading_{};
  double period_ = 1e-3;
  std::int64_t count_ = 0;
};

/// Whether a gait of the same class that gets the values of `bench` goes on as `bench` does, 1000
/// updates bit for bit: all that a resumed run has.
inline bool resumes_from_its_values(HexapodGaitBench& bench, const std::string& class_name,
                                    double period) {
  HexapodGaitBench other{class_name};
  std::ranges::copy(bench.component().values(), other.component().values().begin());
  for (std::int64_t k = 0; k < 1000; ++k) {
    bench.component().update({0., period, 5000 + k});
    other.component().update({0., period, 5000 + k});
  }
  return std::ranges::equal(bench.component().values(), other.component().values());
}

}  // namespace hookpoint::testing
