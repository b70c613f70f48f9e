// Gaits whose legs each have a clock that runs through stance and swing, one a period.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "control/components/legged_gait.h"

namespace hookpoint::control {

class ClockedGait : public LeggedGait {
  const std::size_t most_;

 public:
  Parameter period =
      Parameter{*this, "period", "s", 0.6, "of a whole step, stance and swing"}.range(1e-3, 1e3);
  Parameter duty_factor;

  State clock{*this, "clock", "",
              "0 at touch-down, duty_factor at lift-off, 1 at the next touch-down", most_};
  State in_air{*this, "in_air", "", "1 while the clock is in the swing", most_};

 protected:
  /// `least_duty`: the least `duty_factor` that it may have. The rest as LeggedGait.
  ClockedGait(std::size_t most, double least_duty, std::string counter = "")
      : LeggedGait(most, std::move(counter)),
        most_(most),
        duty_factor(Parameter{*this, "duty_factor", "", 0.55, "part of the period in stance"}.range(
            least_duty, 0.99)) {}
  /// The clocks at the start, from 0 to below 1. A leg whose clock is in the swing stands it out.
  void set_clock(std::size_t leg, double time) {
    clock.set(leg, time);
    in_air.set(leg, 0.);
  }

 private:
  void step(double dt) final;
  double phase_of(std::size_t leg) const final;
  /// How far through the swing a clock is.
  double swing_share(double now) const;
  /// The leg's clock runs on by `left`, from 0 at touch-down through `duty_factor` at lift-off
  /// to 1.
  void advance(std::size_t leg, double left, const PlanarTwist& twist);
  void swing(std::size_t leg, double done, const PlanarTwist& twist);
  void change_phase(std::size_t leg, const PlanarTwist& twist);
};

}  // namespace hookpoint::control
