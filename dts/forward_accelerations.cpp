#include "dts/forward_accelerations.h"

#include "dts/carriers.h"

namespace hookpoint::dts {
namespace {

/// R_WB of the links that carry a group's chains. Not inlined: few robots branch.
template <class Real>
[[gnu::noinline]] Matrix3<Lanes<Real>> carrier_axes(const ChainGroup<Real>& group,
                                                    const Workspace<Real>& workspace) {
  return gather(at_carrier(group, std::span(workspace.bodies))).R_WB;
}

}  // namespace

template <class Real>
void forward_accelerations(const Model<Real>& model, Workspace<Real>& workspace) {
  // Of the bodies that carry the chains: first the base, then links.
  Motion<Lanes<Real>> carriers = in_all_lanes<Lanes<Real>>(workspace.base_motion);
  Matrix3<Lanes<Real>> R_WB = in_all_lanes<Lanes<Real>>(workspace.bodies[0].R_WB);
  for (const ChainGroup<Real>& group : model.groups()) {
    if (!group.on_base()) {
      carriers = carrier_motion(group, workspace);
      R_WB = carrier_axes(group, workspace);
    }
    Motion<Lanes<Real>> a = outward(group, carriers);
    a.linear += hip_centripetal(group, workspace);

    const HipPass<Lanes<Real>>& hip = workspace.hips[group.index];
    const Wrench<Lanes<Real>> on_chain = hip.IA * a + hip.pA;
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
      if (link.carries) hand_outward(group, n, a, workspace);
    }
  }
}

template void forward_accelerations(const Model<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
