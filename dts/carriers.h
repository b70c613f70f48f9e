// Between chains and the links that carry them: motions outwards, inertias and forces inwards.
// Chains on the base have theirs from the base alone (hip_forces.h).
#pragma once

#include <span>

#include "dts/hip_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {

/// Nothing hangs on any link yet.
template <class Real>
void clear_carried(Workspace<Real>& workspace) {
  for (HipPass<Real>& carried : workspace.carried) carried = {};
}

// Not inlined: few robots branch, and the recursions of the others are to stay as they are.

/// How the links that carry a group's chains move.
template <class Real>
[[gnu::noinline]] Motion<Lanes<Real>> carrier_motion(const ChainGroup<Real>& group,
                                                     const Workspace<Real>& workspace) {
  return gather(at_carrier(group, std::span(workspace.carrier_motions)));
}

/// Sets what the chains of links `n` are handed: `a` is those links' motion.
template <class Real>
[[gnu::noinline]] void hand_outward(const ChainGroup<Real>& group, std::size_t n,
                                    const Motion<Lanes<Real>>& a, Workspace<Real>& workspace) {
  scatter(a, at_body(group, n, std::span(workspace.carrier_motions)));
}

/// Adds `x`, an inertia or a wrench that the chains of a group ask of their hips, to that part of
/// what their carriers carry.
template <class Real, template <class> class Quantity>
[[gnu::noinline]] void hand_inward(const ChainGroup<Real>& group, const Quantity<Lanes<Real>>& x,
                                   Quantity<Real> HipPass<Real>::*part,
                                   Workspace<Real>& workspace) {
  const Quantity<Lanes<Real>> on_carriers = inward(group, x);
  for (std::size_t lane = 0; lane < group.chain_count; ++lane) {
    Quantity<Real>& sum = workspace.carried[group.carriers[lane]].*part;
    sum = sum + lane_of(on_carriers, lane);
  }
}

/// Inertia and wrench that backward_dynamics found at the hips.
template <class Real>
void hand_inward(const ChainGroup<Real>& group, Workspace<Real>& workspace) {
  hand_inward(group, workspace.hips[group.index].IA, &HipPass<Real>::IA, workspace);
  hand_inward(group, wrench_on_hip(group, workspace), &HipPass<Real>::pA, workspace);
}

/// What hangs on the links `n` of a group.
template <class Real>
HipPass<Lanes<Real>> carried_by(const ChainGroup<Real>& group, std::size_t n,
                                const Workspace<Real>& workspace) {
  return gather(at_body(group, n, std::span(workspace.carried)));
}
/// Adds it to what the links carry otherwise.
template <class Real>
[[gnu::noinline]] void add_carried(const ChainGroup<Real>& group, std::size_t n,
                                   const Workspace<Real>& workspace,
                                   HipPass<Lanes<Real>>& carried) {
  const HipPass<Lanes<Real>> more = carried_by(group, n, workspace);
  carried = {carried.IA + more.IA, carried.pA + more.pA};
}

}  // namespace hookpoint::dts
