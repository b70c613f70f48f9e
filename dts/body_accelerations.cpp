#include "dts/body_accelerations.h"

namespace hookpoint::dts {

template <class Real>
void body_accelerations(const Model<Real>& model, const State<Real>& state,
                        const Workspace<Real>& workspace, std::span<Motion<Real>> bodies) {
  bodies[0] = {workspace.base_angular_acceleration, workspace.base_acceleration};
  for (std::size_t body = 1; body < model.body_count(); ++body) {
    const Seat& seat = model.seat_of(body);
    const std::size_t preceding = model.carrier_of(body);
    const BodyMotion<Real>& before = workspace.bodies[preceding];
    const BodyMotion<Real>& here = workspace.bodies[body];
    const Matrix3<Real>& R = here.R_WB;
    const Vector3<Real> z{R.xz, R.yz, R.zz};
    const Vector3<Real> r = here.p_WB - before.p_WB;
    const Vector3<Real>& w = before.w_WB;
    const Vector3<Real> joint = workspace.joint_accelerations[body - 1] * z;
    const Vector3<Real> turning = state.joint_rates[body - 1] * cross(w, z);
    Motion<Real> a = bodies[preceding];
    a.linear += cross(a.angular, r) + cross(w, cross(w, r));
    if (model.groups()[seat.group].links[seat.link].joint == JointType::revolute) {
      a.angular += joint + turning;
    } else {
      a.linear += joint + 2. * turning;
    }
    bodies[body] = a;
  }
}

template void body_accelerations(const Model<double>&, const State<double>&,
                                 const Workspace<double>&, std::span<Motion<double>>);

}  // namespace hookpoint::dts
