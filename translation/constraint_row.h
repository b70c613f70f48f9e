// What engines with rows J v = ERP error/dt - CFM f do at rest and in an impact (reference/settings.h).
#pragma once

#include <limits>

#include "translation/situation.h"

namespace hookpoint::translation {

/// SI.
struct ConstraintRow {
  double error_reduction = 0.;    ///< ERP of the normal row [1]
  double mixing = 0.;             ///< CFM of the normal row [m/(N s)]
  double tangential_mixing = 0.;  ///< CFM of a friction row: it creeps at this times f_t
  double friction = 0.;           ///< mu
  /// The fastest at which depth is undone [m/s].
  double correction_speed = std::numeric_limits<double>::infinity();
};

/// Any step is stable: the spring is taken implicitly. `shape`: of the friction.
Behaviour behaviour_of(const ConstraintRow& row, const Situation& at, const char* shape);

}  // namespace hookpoint::translation
