// How much work an analysis of a robot may take before a run: bounded, whatever the robot.
#pragma once

#include <stdexcept>

namespace hookpoint::simulation {

/// Thrown where an analysis would take more.
struct OverBudget : std::length_error {
  OverBudget() : std::length_error("the analysis takes too long") {}
};

class AnalysisBudget {
 public:
  /// Multiplications; some two seconds of one processor.
  static constexpr double most = 4e9;

  /// Called before the work is done. Throws OverBudget.
  void spend(double multiplications) {
    spent_ += multiplications;
    if (spent_ > most) throw OverBudget();
  }
  /// Whether so much more would leave half of it to what follows: for a search that may be given
  /// up.
  bool leaves_half(double multiplications) const { return spent_ + multiplications < 0.5 * most; }

 private:
  double spent_ = 0.;
};

}  // namespace hookpoint::simulation
