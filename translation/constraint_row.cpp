#include "translation/constraint_row.h"

#include <algorithm>

#include "translation/impact.h"

namespace hookpoint::translation {

Behaviour behaviour_of(const ConstraintRow& row, const Situation& at, const char* shape) {
  Behaviour result;
  result.friction_shape = shape;
  if (row.mixing * at.load < row.correction_speed) {
    // At rest ERP depth/dt = CFM f.
    result.static_depth = row.mixing * at.load * at.deltat / row.error_reduction;
  } else {
    result.add_unknown(
        "the load needs a correction speed above the limit: the penetration grows without end");
  }
  result.damping = (1. - row.error_reduction) / row.mixing;
  result.set_creep(row.friction, row.tangential_mixing * tangential_on_slope(at));
  predict_rebound(result, at, [&](double depth, double approach) {
    if (depth <= 0.) return 0.;
    const double correction =
        std::min(row.error_reduction * depth / at.deltat, row.correction_speed);
    return (approach + correction) / (row.mixing + at.deltat / at.mass);
  });
  return result;
}

}  // namespace hookpoint::translation
