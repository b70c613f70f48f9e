// Energy and momentum of a robot at the state that forward_kinematics saw last. A fixed base counts
// for nothing.
#pragma once

#include "dts/workspace.h"

namespace hookpoint::dts {

/// T = sum (m v_c^2 + w.I w + I_r q'^2) / 2 [J].
template <class Real>
Real kinetic_energy(const Model<Real>& model, const Workspace<Real>& workspace);

/// V = -sum m g.c [J], `gravity_W` in world axes [m/s^2], c from the world's origin.
template <class Real>
Real potential_energy(const Model<Real>& model, const Vector3<Real>& gravity_W,
                      const Workspace<Real>& workspace);

/// p = sum m v_c [kg m/s], world axes.
template <class Real>
Vector3<Real> linear_momentum(const Model<Real>& model, const Workspace<Real>& workspace);

/// L = sum (c x m v_c + I w) [kg m^2/s], about the world's origin, world axes.
template <class Real>
Vector3<Real> angular_momentum(const Model<Real>& model, const Workspace<Real>& workspace);

extern template double kinetic_energy(const Model<double>&, const Workspace<double>&);
extern template double potential_energy(const Model<double>&, const Vector3<double>&,
                                        const Workspace<double>&);
extern template Vector3<double> linear_momentum(const Model<double>&, const Workspace<double>&);
extern template Vector3<double> angular_momentum(const Model<double>&, const Workspace<double>&);

}  // namespace hookpoint::dts
