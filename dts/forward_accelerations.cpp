#include "dts/forward_accelerations.h"

#include "dts/hip_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {

template <class Real>
void forward_accelerations(const Model<Real>& model, Workspace<Real>& workspace) {
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    const ChainConstants<Real>& chain = model.chains()[k];
    Motion<Real> a = outward(chain, workspace.base_motion);
    a.linear += transpose_times(chain.R_BH, hip_centripetal(chain, workspace.base));

    const Wrench<Real> on_chain = workspace.hips[k].IA * a + workspace.hips[k].pA;
    const Vector3<Real> force = chain.R_BH * on_chain.force;
    const Vector3<Real> moment = chain.R_BH * on_chain.moment + cross(chain.hip_to_H, force);
    workspace.hip_wrenches[k] = {-(R_WB * moment), -(R_WB * force)};

    for (std::size_t l = chain.first_link; l < chain.first_link + chain.link_count; ++l) {
      const LinkConstants<Real>& link = model.links()[l];
      const LinkPass<Real>& pass = workspace.links[l];
      // a' = X a + c;  ddq = (u - U^T a') / D;  a = a' + S ddq
      a = outward(link, pass, a) + pass.c;
      const Real acceleration = pass.D_inverse * (pass.u - dot(pass.U, a));
      workspace.joint_accelerations[l] = acceleration;
      a = with_joint_motion(link.joint, a, acceleration);
    }
  }
}

template void forward_accelerations(const Model<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
