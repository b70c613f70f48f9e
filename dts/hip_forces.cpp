#include "dts/hip_forces.h"

#include "dts/body_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {

template <class Real>
void factor_base(const Model<Real>& model, Workspace<Real>& workspace) {
  if (!model.mobile()) return;
  ArticulatedInertia<Lanes<Real>> carried;
  for (const ChainGroup<Real>& group : model.base_groups()) {
    carried = carried + only(group.in_use, inward(group, workspace.hips[group.index].IA));
  }
  const ArticulatedInertia<Real> IA = lane_sum(carried) + model.base();
  BasePass<Real>& base = workspace.base;
  base.H = IA.H;
  base.M_inverse = inverse(IA.M);
  base.rotational_inverse = inverse(IA.I - congruent(IA.H, base.M_inverse));
}

template <class Real>
void hip_forces_to_base(const Model<Real>& model, const Vector3<Real>& gravity_W,
                        Workspace<Real>& workspace) {
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  if (!model.mobile()) {
    workspace.base_motion = {{}, -transpose_times(R_WB, gravity_W)};
    workspace.base_acceleration = {};
    workspace.base_angular_acceleration = {};
    return;
  }
  factor_base(model, workspace);
  Wrench<Lanes<Real>> carried;
  for (const ChainGroup<Real>& group : model.base_groups()) {
    carried = carried + only(group.in_use, inward(group, wrench_on_hip(group, workspace)));
  }
  const Wrench<Real> pA =
      lane_sum(carried) + bias_wrench(model.base(), workspace.base.w, R_WB, workspace.external[0]);
  workspace.base_motion = solve_base(workspace.base, pA);
  workspace.base_acceleration = R_WB * workspace.base_motion.linear + gravity_W;
  workspace.base_angular_acceleration = R_WB * workspace.base_motion.angular;
}

template void factor_base(const Model<double>&, Workspace<double>&);
template void hip_forces_to_base(const Model<double>&, const Vector3<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
