#include "dts/hip_forces.h"

#include "dts/body_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {

template <class Real>
void factor_base(const Model<Real>& model, Workspace<Real>& workspace) {
  if (!model.mobile()) return;
  ArticulatedInertia<Real> IA = articulated(model.base());
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    IA = IA + inward(model.chains()[k], workspace.hips[k].IA);
  }
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
  Wrench<Real> pA = bias_wrench(model.base(), workspace.base.w, 0, workspace);
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    const ChainConstants<Real>& chain = model.chains()[k];
    const auto& [IA, pA_hip] = workspace.hips[k];
    const Vector3<Real> c = transpose_times(chain.R_BH, hip_centripetal(chain, workspace.base));
    pA = pA + inward(chain, pA_hip + IA * Motion<Real>{{}, c});
  }
  workspace.base_motion = solve_base(workspace.base, pA);
  workspace.base_acceleration = R_WB * workspace.base_motion.linear + gravity_W;
  workspace.base_angular_acceleration = R_WB * workspace.base_motion.angular;
}

template void factor_base(const Model<double>&, Workspace<double>&);
template void hip_forces_to_base(const Model<double>&, const Vector3<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
