#include "dts/backward_dynamics.h"

#include "dts/body_forces.h"
#include "dts/carriers.h"

namespace hookpoint::dts {

namespace {

/// Lets the link's joint move freely under `torque` and gives what the link and all that it carries
/// ask of the preceding frame; `pA` is the wrench that they take without acceleration.
template <class Real>
[[gnu::always_inline]] inline HipPass<Real> pass_inward(const LinkConstants<Real>& link,
                                                        const Elimination<Real>& free,
                                                        const Wrench<Real>& pA, const Real& torque,
                                                        LinkPass<Real>& pass) {
  pass.U = free.U;
  pass.D_inverse = free.D_inverse;
  // u = tau - S^T pA;  pa = pA + Ia c + U u / D
  pass.u = torque - along(link.joint, pA);
  const Wrench<Real> pa = pA + free.Ia * pass.c + (pass.u * pass.D_inverse) * free.U;
  return {inward_screws(link, pass, free.Ia), inward_screws(link, pass, pa)};
}

/// Of link `n`, which carries `IA`, where zeros are none of its elimination's: it is the leaf's and
/// known, or leaves nothing 0, and is put into `full`. Not inlined: the recursions of robots
/// without rotors are a fiftieth slower with this code in their midst.
template <class Real>
[[gnu::noinline]] const Elimination<Lanes<Real>>& eliminate_apart(
    const ChainGroup<Real>& group, std::size_t n, const ArticulatedInertia<Lanes<Real>>& IA,
    Elimination<Lanes<Real>>& full) {
  if (group.ends_at(n)) return group.leaf;
  full = eliminate_fully(group.links[n], IA + group.links[n].inertia);
  return full;
}

}  // namespace

template <class Real>
void backward_dynamics(const Model<Real>& model,
                       std::span<const std::type_identity_t<Real>> joint_torques,
                       Workspace<Real>& workspace) {
  clear_carried(workspace);
  for (std::size_t g = model.groups().size(); g-- > 0;) {
    const ChainGroup<Real>& group = model.groups()[g];
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    HipPass<Lanes<Real>>& carried = workspace.hips[g];
    carried = {};
    for (std::size_t n = group.link_count(); n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      if (link.carries) add_carried(group, n, workspace, carried);
      const Wrench<Lanes<Real>> pA = carried.pA + bias_wrench(group, n, passes[n], workspace);
      const Lanes<Real> torque = gather(at_link(group, n, joint_torques));
      carried = group.ends_at(n) || link.full
                    ? pass_inward(link, eliminate_apart(group, n, carried.IA, workspace.full), pA,
                                  torque, passes[n])
                    : pass_inward(link, eliminate(link.joint, carried.IA + link.inertia), pA,
                                  torque, passes[n]);
      if (link.placed) {
        carried = {inward(link.placement, carried.IA), inward(link.placement, carried.pA)};
      }
    }
    if (!group.on_base()) hand_inward(group, workspace);
  }
}

template void backward_dynamics(const Model<double>&, std::span<const double>, Workspace<double>&);

}  // namespace hookpoint::dts
