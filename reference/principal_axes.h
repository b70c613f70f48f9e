// The principal frame of an inertia, for libraries that want diagonal ones.
#pragma once

#include "math/rotation.h"

namespace hookpoint::reference {

struct PrincipalAxes {
  Vector3d moments;         ///< [kg m^2]
  Quaterniond orientation;  ///< R_BP, body axes from principal ones; no turn where I is diagonal
};
/// Of `I`, in body axes [kg m^2]: I = R_BP diag(moments) R_PB to rounding.
PrincipalAxes principal_axes(const Symmetric3d& I);

}  // namespace hookpoint::reference
