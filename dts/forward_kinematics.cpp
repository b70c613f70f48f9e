#include "dts/forward_kinematics.h"

#include <algorithm>

#include "dts/joint.h"
#include "math/sine_cosine.h"

namespace hookpoint::dts {
namespace {

/// Fills `pass` from the joint's position and rate and the angular velocity `w` of the frame ahead
/// of the link's screws, in its axes.
template <class Real>
[[gnu::always_inline]] inline void link_pass(const LinkConstants<Real>& link, const Real& q,
                                             const Real& rate, const Vector3<Real>& w,
                                             LinkPass<Real>& pass) {
  const bool revolute = link.joint == JointType::revolute;
  const auto [sine, cosine] = polynomial_sine_cosine(revolute ? link.theta + q : link.theta);
  const Real d = revolute ? link.d : link.d + q;
  pass.turn = {sine, cosine, d};

  // w x (w x r) = (w.r) w - w^2 r, in the frame between the two screws, where r = (a, 0, d).
  const Vector3<Real> w_y = rotate_x(-link.twist.sine, link.twist.cosine, w);
  const Real along_r = link.twist.shift * w_y.x + d * w_y.z;
  const Real squared = dot(w_y, w_y);
  const Vector3<Real> centripetal{along_r * w_y.x - squared * link.twist.shift, along_r * w_y.y,
                                  along_r * w_y.z - squared * d};
  pass.w = rotate_z(-sine, cosine, w_y);
  pass.c.linear = rotate_z(-sine, cosine, centripetal);
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

/// Adds what the shift of the link's placement gives its acceleration, w x (w x r), `w` as above.
template <class Real>
void add_centripetal(const LinkConstants<Real>& link, const Vector3<Real>& w,
                     LinkPass<Real>& pass) {
  const auto& [shift, sine, cosine] = link.placement;
  const Vector3<Real> centripetal = cross(w, cross(w, rotate_z(-sine, cosine, shift)));
  pass.c.linear += rotate_z(-pass.turn.sine, pass.turn.cosine,
                            rotate_x(-link.twist.sine, link.twist.cosine, centripetal));
}

/// The motion of the frame that a placement leads to, which moves with the link before it.
template <class Real>
BodyMotion<Real> placed_motion(const Placement<Real>& at, const BodyMotion<Real>& before) {
  const Vector3<Real> r = before.R_WB * at.shift;
  return {times_rotation_z(before.R_WB, at.sine, at.cosine), before.p_WB + r,
          before.v_WB + cross(before.w_WB, r), before.w_WB};
}

/// The link's world motion from that of the preceding frame.
template <class Real>
[[gnu::always_inline]] inline BodyMotion<Real> link_motion(const LinkConstants<Real>& link,
                                                           const Screw<Real>& turn,
                                                           const Real& rate,
                                                           const BodyMotion<Real>& before) {
  const Matrix3<Real> R_WY = times_rotation_x(before.R_WB, link.twist.sine, link.twist.cosine);
  const Vector3<Real> x_Y{R_WY.xx, R_WY.yx, R_WY.zx};
  const Vector3<Real> z{R_WY.xz, R_WY.yz, R_WY.zz};
  const Vector3<Real> r = link.twist.shift * x_Y + turn.shift * z;
  BodyMotion<Real> body{times_rotation_z(R_WY, turn.sine, turn.cosine), before.p_WB + r,
                        before.v_WB + cross(before.w_WB, r), before.w_WB};
  (link.joint == JointType::revolute ? body.w_WB : body.v_WB) += rate * z;
  return body;
}

/// The motion of the hip frames, which move with their carriers.
template <class Real>
BodyMotion<Real> hip_motion(const HipConstants<Real>& hip, const BodyMotion<Real>& carrier) {
  const Vector3<Real> r = carrier.R_WB * hip.p_BH;
  return {carrier.R_WB * hip.R_BH, carrier.p_WB + r, carrier.v_WB + cross(carrier.w_WB, r),
          carrier.w_WB};
}

/// From the hips out along the chains of a group: `body` is the motion of their hips, `w` its
/// angular velocity in their axes. `placed`: some link has a placement.
template <bool placed, class Real>
void group_kinematics(const ChainGroup<Real>& group, const State<Real>& state,
                      BodyMotion<Lanes<Real>> body, Vector3<Lanes<Real>> w,
                      Workspace<Real>& workspace) {
  const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
  for (std::size_t n = 0; n < group.link_count(); ++n) {
    const LinkConstants<Lanes<Real>>& link = group.links[n];
    const Lanes<Real> q = gather(at_link(group, n, std::span(state.joint_positions)));
    const Lanes<Real> rate = gather(at_link(group, n, std::span(state.joint_rates)));
    if constexpr (placed) {
      w = rotate_z(-link.placement.sine, link.placement.cosine, w);
      body = placed_motion(link.placement, body);
    }
    link_pass(link, q, rate, w, passes[n]);
    if constexpr (placed) add_centripetal(link, w, passes[n]);
    body = link_motion(link, passes[n].turn, rate, body);
    scatter(body, at_body(group, n, std::span(workspace.bodies)));
    passes[n].R_WB = body.R_WB;
    w = passes[n].w;
  }
}

/// The motion of the links that carry a group's chains. Not inlined: few robots branch.
template <class Real>
[[gnu::noinline]] BodyMotion<Lanes<Real>> carriers_of(const ChainGroup<Real>& group,
                                                      const Workspace<Real>& workspace) {
  return gather(at_carrier(group, std::span(workspace.bodies)));
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

  // Of the bodies that carry the chains: first the base, then links.
  BodyMotion<Lanes<Real>> carriers = in_all_lanes<Lanes<Real>>(base);
  Vector3<Lanes<Real>> w = in_all_lanes<Lanes<Real>>(workspace.base.w);
  for (const ChainGroup<Real>& group : model.groups()) {
    if (!group.on_base()) {
      carriers = carriers_of(group, workspace);
      w = transpose_times(carriers.R_WB, carriers.w_WB);
    }
    workspace.carrier_w[group.index] = w;
    const BodyMotion<Lanes<Real>> hips = hip_motion(group.hip, carriers);
    const Vector3<Lanes<Real>> w_hips = transpose_times(group.hip.R_BH, w);
    const bool placed = std::ranges::any_of(group.links, &LinkConstants<Lanes<Real>>::placed);
    if (placed) {
      group_kinematics<true>(group, state, hips, w_hips, workspace);
    } else {
      group_kinematics<false>(group, state, hips, w_hips, workspace);
    }
  }
}

template void forward_kinematics(const Model<double>&, const State<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
