#include "dts/inverse_dynamics.h"

#include "dts/body_forces.h"
#include "dts/hip_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {

template <class Real>
Wrench<Real> inverse_dynamics(const Model<Real>& model, const Vector3<Real>& gravity_W,
                              const Accelerations<Real>& accelerations,
                              std::span<Real> joint_torques, Workspace<Real>& workspace) {
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  const Motion<Real> a_base{transpose_times(R_WB, accelerations.base_angular),
                            transpose_times(R_WB, accelerations.base_linear - gravity_W)};
  Wrench<Real> f_base =
      model.base() * a_base + bias_wrench(model.base(), workspace.base.w, 0, workspace);

  for (const ChainConstants<Real>& chain : model.chains()) {
    Motion<Real> a = outward(chain, a_base);
    a.linear += transpose_times(chain.R_BH, hip_centripetal(chain, workspace.base));
    for (std::size_t l = chain.first_link; l < chain.first_link + chain.link_count; ++l) {
      const LinkConstants<Real>& link = model.links()[l];
      const LinkPass<Real>& pass = workspace.links[l];
      a = with_joint_motion(link.joint, outward(link, pass, a) + pass.c, accelerations.joints[l]);
      workspace.link_wrenches[l] =
          link.inertia * a + bias_wrench(link.inertia, pass.w, l + 1, workspace);
    }
    Wrench<Real> carried;
    for (std::size_t l = chain.first_link + chain.link_count; l-- > chain.first_link;) {
      const LinkConstants<Real>& link = model.links()[l];
      const Wrench<Real> f = workspace.link_wrenches[l] + carried;
      joint_torques[l] = along(link.joint, f);
      carried = inward(link, workspace.links[l], f);
    }
    f_base = f_base + inward(chain, carried);
  }
  return {R_WB * f_base.moment, R_WB * f_base.force};
}

template Wrench<double> inverse_dynamics(const Model<double>&, const Vector3<double>&,
                                         const Accelerations<double>&, std::span<double>,
                                         Workspace<double>&);

}  // namespace hookpoint::dts
