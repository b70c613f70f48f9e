#include "dts/backward_dynamics.h"

#include "dts/body_forces.h"
#include "dts/joint.h"

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
  return {inward(link, pass, free.Ia), inward(link, pass, pa)};
}

}  // namespace

template <class Real>
void backward_dynamics(const Model<Real>& model,
                       std::span<const std::type_identity_t<Real>> joint_torques,
                       Workspace<Real>& workspace) {
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    const ChainConstants<Real>& chain = model.chains()[k];
    HipPass<Real> carried;
    for (std::size_t l = chain.first_link + chain.link_count; l-- > chain.first_link;) {
      const LinkConstants<Real>& link = model.links()[l];
      LinkPass<Real>& pass = workspace.links[l];
      const Wrench<Real> pA = carried.pA + bias_wrench(link.inertia, pass.w, l + 1, workspace);
      carried = is_last(chain, l)
                    ? pass_inward(link, chain.leaf, pA, joint_torques[l], pass)
                    : pass_inward(link, eliminate(link.joint, carried.IA + link.inertia), pA,
                                  joint_torques[l], pass);
    }
    workspace.hips[k] = carried;
  }
}

template void backward_dynamics(const Model<double>&, std::span<const double>, Workspace<double>&);

}  // namespace hookpoint::dts
