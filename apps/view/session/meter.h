// What is measured of a subject that is watched, beside what closed forms say.
#pragma once

#include <functional>
#include <memory>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::view {

/// NaN where there is none.
struct Reading {
  double displacement, displacement_predicted;  ///< of the feet since the start, downhill [m]
  double slip, slip_predicted;                  ///< way of the boundary points on the ground [m]
  double penetration, penetration_predicted;    ///< mean of the points that touch [m]
  double load, load_predicted;                  ///< of the ground, along its normal [N]
};

/// What a run has added up, with which one meter continues where another ended.
struct Tally {
  double displacement = 0., slip = 0.;  ///< measured so far [m]
  /// Since when the closed forms are those of the present constants, what they had said by then,
  /// and what of it is the law's giving in at once, which the present constants have instead.
  struct Predicted {
    double since = 0.;                                  // [s]
    double displacement = 0., slip = 0., give_in = 0.;  // [m]
  } predicted;
};

/// Measures a run; the same code for every engine.
class Meter {
 public:
  virtual ~Meter() = default;
  /// Called once for the first instant and once after each step.
  virtual void observe(const simulation::WorldState& state) = 0;
  virtual Reading read() const = 0;
  /// For a meter of the same constants.
  virtual Tally tally() const = 0;
  /// For a meter of others.
  virtual Tally tally_before_change() const = 0;
};
/// Of an experiment whose run has this behind it.
using MakeMeter =
    std::function<std::unique_ptr<Meter>(const simulation::Experiment&, const Tally&)>;

}  // namespace hookpoint::view
