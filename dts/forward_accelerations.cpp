#include "dts/forward_accelerations.h"

#include "dts/carriers.h"

namespace hookpoint::dts {
namespace {

/// R_WB of the links that carry a group's chains.
template <class Real>
[[gnu::noinline]] Matrix3<Lanes<Real>> carrier_axes(const ChainGroup<Real>& group,
                                                    const Workspace<Real>& workspace) {
  return gather(at_carrier(group, std::span(workspace.bodies))).R_WB;
}

}  // namespace

template <class Real>
void forward_accelerations(const Model<Real>& model, Workspace<Real>& workspace) {
  const Matrix3<Lanes<Real>> R_base = in_all_lanes<Lanes<Real>>(workspace.bodies[0].R_WB);
  for (const ChainGroup<Real>& group : model.groups()) {
    Motion<Lanes<Real>> a = outward(group, carrier_motion(group, workspace.base_motion, workspace));
    a.linear += hip_centripetal(group, workspace);

    const HipPass<Lanes<Real>>& hip = workspace.hips[group.index];
    const Wrench<Lanes<Real>> on_chain = hip.IA * a + hip.pA;
    const Matrix3<Lanes<Real>> R_WB = group.on_base() ? R_base : carrier_axes(group, workspace);
    const Vector3<Lanes<Real>> force = group.hip.R_BH * on_chain.force;
    const Vector3<Lanes<Real>> moment =
        group.hip.R_BH * on_chain.moment + cross(group.hip.hip_to_H, force);
    scatter(Wrench<Lanes<Real>>{-(R_WB * moment), -(R_WB * force)},
            at_chain(group, std::span(workspace.hip_wrenches)));

    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    for (std::size_t n = 0; n < group.link_count(); ++n) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      const LinkPass<Lanes<Real>>& pass = passes[n];
      // a' = X a + c;  ddq = (u - U^T a') / D;  a = a' + S ddq
      if (link.placed) a = outward(link.placement, a);
      a = outward_screws(link, pass, a) + pass.c;
      const Lanes<Real> acceleration = pass.D_inverse * (pass.u - dot(pass.U, a));
      scatter(acceleration, at_link(group, n, std::span(workspace.joint_accelerations)));
      a = with_joint_motion(link.joint, a, acceleration);
      hand_outward(group, n, a, workspace);
    }
  }
}

template void forward_accelerations(const Model<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
