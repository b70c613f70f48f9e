#include "dts/forward_kinematics.h"

#include "dts/joint.h"
#include "math/sine_cosine.h"

namespace hookpoint::dts {
namespace {

/// Fills `pass` from the joint's position and rate and the preceding frame's angular velocity `w`,
/// in its axes.
template <class Real>
void link_pass(const LinkConstants<Real>& link, const Real& q, const Real& rate,
               const Vector3<Real>& w, LinkPass<Real>& pass) {
  const bool revolute = link.joint == JointType::revolute;
  const SineCosine<Real> theta = polynomial_sine_cosine(revolute ? link.theta + q : link.theta);
  pass.sine = theta.sine;
  pass.cosine = theta.cosine;
  pass.d = revolute ? link.d : link.d + q;

  // w x (w x r) = (w.r) w - w^2 r, in the frame between the two screws, where r = (a, 0, d).
  const Vector3<Real> w_y = rotate_x(-link.sin_alpha, link.cos_alpha, w);
  const Real along_r = link.a * w_y.x + pass.d * w_y.z;
  const Real squared = dot(w_y, w_y);
  const Vector3<Real> centripetal{along_r * w_y.x - squared * link.a, along_r * w_y.y,
                                  along_r * w_y.z - squared * pass.d};
  pass.w = rotate_z(-pass.sine, pass.cosine, w_y);
  pass.c.linear = rotate_z(-pass.sine, pass.cosine, centripetal);
  // w x z rate, of which a sliding joint feels twice (Coriolis) as a linear acceleration.
  const Vector3<Real> turning{rate * pass.w.y, -rate * pass.w.x, 0.};
  if (revolute) {
    pass.w.z += rate;
    pass.c.angular = turning;
  } else {
    pass.c.linear += 2. * turning;
    pass.c.angular = {};
  }
}

/// The link's world motion from that of the preceding frame.
template <class Real>
void link_motion(const LinkConstants<Real>& link, const LinkPass<Real>& pass, const Real& rate,
                 const BodyMotion<Real>& before, BodyMotion<Real>& body) {
  const Matrix3<Real> R_WY = times_rotation_x(before.R_WB, link.sin_alpha, link.cos_alpha);
  const Vector3<Real> x_Y{R_WY.xx, R_WY.yx, R_WY.zx};
  const Vector3<Real> z{R_WY.xz, R_WY.yz, R_WY.zz};
  const Vector3<Real> r = link.a * x_Y + pass.d * z;
  body.R_WB = times_rotation_z(R_WY, pass.sine, pass.cosine);
  body.p_WB = before.p_WB + r;
  body.v_WB = before.v_WB + cross(before.w_WB, r);
  body.w_WB = before.w_WB;
  (link.joint == JointType::revolute ? body.w_WB : body.v_WB) += rate * z;
}

/// The motion of a chain's hip frame, which moves with the base.
template <class Real>
BodyMotion<Real> hip_motion(const ChainConstants<Real>& chain, const BodyMotion<Real>& base) {
  const Vector3<Real> r = base.R_WB * chain.p_BH;
  return {base.R_WB * chain.R_BH, base.p_WB + r, base.v_WB + cross(base.w_WB, r), base.w_WB};
}

}  // namespace

template <class Real>
void forward_kinematics(const Model<Real>& model, const State<Real>& state,
                        Workspace<Real>& workspace) {
  BodyMotion<Real>& base = workspace.bodies[0];
  base = {rotation_matrix(state.base_orientation), state.base_position, {}, {}};
  if (model.mobile()) {
    base.v_WB = state.base_velocity;
    base.w_WB = state.base_angular_velocity;
  }
  workspace.base.w = transpose_times(base.R_WB, base.w_WB);

  for (const ChainConstants<Real>& chain : model.chains()) {
    const BodyMotion<Real> hip = hip_motion(chain, base);
    const BodyMotion<Real>* before = &hip;
    Vector3<Real> w = transpose_times(chain.R_BH, workspace.base.w);
    for (std::size_t l = chain.first_link; l < chain.first_link + chain.link_count; ++l) {
      const LinkConstants<Real>& link = model.links()[l];
      LinkPass<Real>& pass = workspace.links[l];
      link_pass(link, state.joint_positions[l], state.joint_rates[l], w, pass);
      BodyMotion<Real>& body = workspace.bodies[l + 1];
      link_motion(link, pass, state.joint_rates[l], *before, body);
      before = &body;
      w = pass.w;
    }
  }
}

template void forward_kinematics(const Model<double>&, const State<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
