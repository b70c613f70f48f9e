#include "dts/forward_dynamics.h"

#include "dts/backward_dynamics.h"
#include "dts/forward_accelerations.h"
#include "dts/hip_forces.h"

namespace hookpoint::dts {

template <class Real>
void forward_dynamics(const Model<Real>& model, const Vector3<Real>& gravity_W,
                      std::span<const std::type_identity_t<Real>> joint_torques,
                      Workspace<Real>& workspace) {
  backward_dynamics(model, joint_torques, workspace);
  hip_forces_to_base(model, gravity_W, workspace);
  forward_accelerations(model, workspace);
}

template void forward_dynamics(const Model<double>&, const Vector3<double>&,
                               std::span<const double>, Workspace<double>&);

}  // namespace hookpoint::dts
