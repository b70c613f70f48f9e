#include "dts/hip_forces.h"

#include "dts/body_forces.h"
#include "dts/joint.h"
#include "dts/planar_base.h"

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
  base.M = IA.M;
  base.M_inverse = inverse(IA.M);
  if (model.plane_normal()) {
    const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
    return restrict_to_plane(world_axis_in(R_WB, *model.plane_normal()), IA.I, base);
  }
  base.rotational_inverse = inverse(IA.I - congruent(IA.H, base.M_inverse));
}

namespace {

/// The base's acceleration less gravity, base axes, under -pA. A plane holds its base against
/// gravity: less that, the base rises across the plane.
template <class Real>
Motion<Real> motion_of_base(const Model<Real>& model, const Vector3<Real>& gravity_W,
                            const Wrench<Real>& pA, const Workspace<Real>& workspace) {
  const BasePass<Real>& base = workspace.base;
  if (!model.plane_normal()) return solve_base(base, pA);
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  const Vector3<Real> n = world_axis_in(R_WB, *model.plane_normal());
  const Vector3<Real> held = -dot(n, transpose_times(R_WB, gravity_W)) * n;
  Motion<Real> a = solve_base(base, pA + Wrench<Real>{base.H * held, base.M * held});
  a.linear += held;
  return a;
}

}  // namespace

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
  workspace.base_motion = motion_of_base(model, gravity_W, pA, workspace);
  workspace.base_acceleration = R_WB * workspace.base_motion.linear + gravity_W;
  workspace.base_angular_acceleration = R_WB * workspace.base_motion.angular;
  hold_in_plane(model, workspace.base_angular_acceleration, workspace.base_acceleration);
}

template void factor_base(const Model<double>&, Workspace<double>&);
template void hip_forces_to_base(const Model<double>&, const Vector3<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
