#include "simulation/experiment/speed_limits.h"

#include <algorithm>
#include <cmath>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Of accelerations: what rounding leaves of a bound that is kept.
constexpr double rounding = 1e-12;
/// Sweeps over the drives at most, and the change of their parts at which they end.
constexpr int most_sweeps = 1000;
constexpr double settled = 1e-15;

}  // namespace

SpeedLimits::SpeedLimits(const RobotSpec& robot, double step)
    : step_(step), held_back_(joint_count(robot)) {
  for_each_link(robot, [&](const TreeLink& at) {
    if (at.link.velocity_limit)
      limited_.push_back({.joint = at.joint(), .limit = *at.link.velocity_limit});
  });
  columns_.resize(limited_.size() * limited_.size());
}

void SpeedLimits::begin(std::span<const double> drives, std::span<const double> rates,
                        std::span<const double> accelerations) {
  std::ranges::fill(held_back_, 0.);
  for (Limited& at : limited_) {
    at.drive = drives[at.joint];
    at.sign = at.drive > 0. ? 1. : at.drive < 0. ? -1. : 0.;
    at.room = (at.limit - at.sign * rates[at.joint]) / step_;
    at.acceleration = accelerations[at.joint];
    at.part = 0.;
    at.bound = false;
  }
}

double SpeedLimits::forward(std::size_t i) const {
  double a = limited_[i].acceleration;
  for (std::size_t j = 0; j < limited_.size(); ++j)
    if (limited_[j].bound) a -= columns_[i * limited_.size() + j] * limited_[j].part;
  return limited_[i].sign * a;
}

bool SpeedLimits::exceeds(std::size_t i) const {
  const Limited& at = limited_[i];
  if (at.bound || at.sign == 0.) return false;
  return forward(i) - at.room > rounding * (std::abs(at.acceleration) + std::abs(at.room));
}

bool SpeedLimits::exceeded() const {
  for (std::size_t i = 0; i < limited_.size(); ++i)
    if (exceeds(i)) return true;
  return false;
}

void SpeedLimits::take_all_of(std::size_t j) {
  std::ranges::fill(held_back_, 0.);
  held_back_[limited_[j].joint] = limited_[j].drive;
}

void SpeedLimits::take_parts() {
  std::ranges::fill(held_back_, 0.);
  for (const Limited& at : limited_) held_back_[at.joint] = at.part * at.drive;
}

void SpeedLimits::fill_column(std::size_t j, std::span<const double> accelerations) {
  for (std::size_t i = 0; i < limited_.size(); ++i)
    columns_[i * limited_.size() + j] = limited_[i].acceleration - accelerations[limited_[i].joint];
}

void SpeedLimits::solve() {
  double change = 1.;
  for (int sweep = 0; sweep < most_sweeps && change > settled; ++sweep) {
    change = 0.;
    for (std::size_t i = 0; i < limited_.size(); ++i) {
      Limited& at = limited_[i];
      const double own = at.sign * columns_[i * limited_.size() + i];
      if (!at.bound || !(own > 0.)) continue;
      const double part = std::clamp(at.part + (forward(i) - at.room) / own, 0., 1.);
      change = std::max(change, std::abs(part - at.part));
      at.part = part;
    }
  }
}

}  // namespace hookpoint::simulation
