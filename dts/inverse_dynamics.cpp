#include "dts/inverse_dynamics.h"

#include "dts/body_forces.h"
#include "dts/carriers.h"

namespace hookpoint::dts {

template <class Real>
Wrench<Real> inverse_dynamics(const Model<Real>& model, const Vector3<Real>& gravity_W,
                              const Accelerations<Real>& accelerations,
                              std::span<Real> joint_torques, Workspace<Real>& workspace) {
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  const Motion<Real> a_base{transpose_times(R_WB, accelerations.base_angular),
                            transpose_times(R_WB, accelerations.base_linear - gravity_W)};
  const auto wrenches_of = [&](const ChainGroup<Real>& group) {
    return std::span(workspace.link_wrenches).subspan(group.first_pass, group.link_count());
  };
  Motion<Lanes<Real>> carriers = in_all_lanes<Lanes<Real>>(a_base);
  for (const ChainGroup<Real>& group : model.groups()) {
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    const std::span<Wrench<Lanes<Real>>> wrenches = wrenches_of(group);
    if (!group.on_base()) carriers = carrier_motion(group, workspace);
    Motion<Lanes<Real>> a = outward(group, carriers);
    a.linear += hip_centripetal(group, workspace);
    for (std::size_t n = 0; n < group.link_count(); ++n) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      a = with_joint_motion(link.joint, outward(link, passes[n], a) + passes[n].c,
                            gather(at_link(group, n, accelerations.joints)));
      if (link.carries) hand_outward(group, n, a, workspace);
      wrenches[n] = link.inertia * a + bias_wrench(group, n, passes[n], workspace);
    }
  }
  clear_carried(workspace);
  Wrench<Lanes<Real>> on_base;
  for_each_inward(model, [&](const ChainGroup<Real>& group) {
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    const std::span<Wrench<Lanes<Real>>> wrenches = wrenches_of(group);
    Wrench<Lanes<Real>> carried;
    for (std::size_t n = group.link_count(); n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      Wrench<Lanes<Real>> f = wrenches[n] + carried;
      if (link.carries) f = f + carried_by(group, n, workspace).pA;
      // tau = S^T f + I_r q''
      const Lanes<Real> rotor =
          link.rotor_inertia * gather(at_link(group, n, accelerations.joints));
      scatter(along(link.joint, f) + rotor, at_link(group, n, joint_torques));
      carried = inward(link, passes[n], f);
    }
    if (group.on_base()) {
      on_base = on_base + only(group.in_use, inward(group, carried));
    } else {
      hand_inward(group, carried, &HipPass<Real>::pA, workspace);
    }
  });
  const Wrench<Real> f_base =
      lane_sum(on_base) + model.base() * a_base +
      bias_wrench(model.base(), workspace.base.w, R_WB, workspace.external[0]);
  return {R_WB * f_base.moment, R_WB * f_base.force};
}

template Wrench<double> inverse_dynamics(const Model<double>&, const Vector3<double>&,
                                         const Accelerations<double>&, std::span<double>,
                                         Workspace<double>&);

}  // namespace hookpoint::dts
