// The principal frame of an inertia.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/rotation.h"

namespace hookpoint {

struct PrincipalAxes {
  Vector3d moments;         ///< [kg m^2]
  Quaterniond orientation;  ///< R_BP, body axes from principal ones; no turn where I is diagonal
};

/// Of `I`, in body axes [kg m^2]: I = R_BP diag(moments) R_PB to rounding.
inline PrincipalAxes principal_axes(const Symmetric3d& I) {
  // The smaller of the two turns about an axis that make the product of inertia b between the next
  // two vanish: tan 2 angle = 2 b / d, d the difference of their moments.
  const auto turn = [](double b, double d) {
    return 0.5 * std::atan2(d < 0. ? -2. * b : 2. * b, std::abs(d));
  };
  PrincipalAxes axes;
  Symmetric3d D = I;
  const double negligible = std::numeric_limits<double>::epsilon() * (I.xx + I.yy + I.zz);
  // Jacobi's method, by largest product; it converges quadratically, six turns are common.
  for (int i = 0; i < 50; ++i) {
    const double xy = std::abs(D.xy), xz = std::abs(D.xz), yz = std::abs(D.yz);
    if (std::max({xy, xz, yz}) <= 0.01 * negligible) break;
    Vector3d rotation;
    if (xy >= xz && xy >= yz)
      rotation.z = turn(D.xy, D.xx - D.yy);
    else if (yz >= xz)
      rotation.x = turn(D.yz, D.yy - D.zz);
    else
      rotation.y = turn(D.xz, D.zz - D.xx);
    axes.orientation = normalized(axes.orientation * exponential(rotation));
    D = rotate(transpose(rotation_matrix(axes.orientation)), I);
  }
  axes.moments = {D.xx, D.yy, D.zz};
  return axes;
}

}  // namespace hookpoint
