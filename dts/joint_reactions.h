// What each joint transmits: the wrench of the body that carries a link on that link.
#pragma once

#include <span>

#include "dts/workspace.h"

namespace hookpoint::dts {

/// Writes to `reactions`, one a body: for a link the force [N] and the moment about the link's origin
/// [N m] by the body that carries it, drive and springs of the joint included; for the base what holds
/// it beside `workspace.external`, about its origin: the support of a fixed base, 0 of one that moves
/// freely. World axes. From the bodies' motion and external forces in the workspace and their
/// `accelerations` (body_accelerations.h), from the tips inwards (Featherstone 2008, section 5.3):
///   f = m (a - g) + alpha x h + w x (w x h) - f_external + sum of the links it carries
/// with h = m c, moments alike. What speeds up a geared rotor is not in it. O(links).
template <class Real>
void joint_reactions(const Model<Real>& model, const Vector3<Real>& gravity_W,
                     const Workspace<Real>& workspace, std::span<const Motion<Real>> accelerations,
                     std::span<Wrench<Real>> reactions);

extern template void joint_reactions(const Model<double>&, const Vector3<double>&,
                                     const Workspace<double>&, std::span<const Motion<double>>,
                                     std::span<Wrench<double>>);

}  // namespace hookpoint::dts
