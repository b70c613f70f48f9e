#include "dts/impulse_response.h"

#include "dts/configuration.h"
#include "dts/hip_forces.h"
#include "dts/joint.h"
#include "dts/planar_base.h"

namespace hookpoint::dts {
namespace {

/// Carries an impulse from `point` to the base, leaving its part along each joint of the chain in
/// the chain's lane of `links[].impulse` and zero in the others, and returns the velocity jump of
/// the base, base axes.
template <class Real>
Motion<Real> jump_of_base(const Model<Real>& model, Workspace<Real>& workspace,
                          const BodyPoint<Real>& point, const Vector3<Real>& impulse_W) {
  const BodyMotion<Real>& body = workspace.bodies[point.body];
  Wrench<Real> p{-transpose_times(body.R_WB, cross(point.p_WP - body.p_WB, impulse_W)),
                 -transpose_times(body.R_WB, impulse_W)};
  if (point.body > 0) {
    const Seat& seat = model.seat_of(point.body);
    const ChainGroup<Real>& group = model.groups()[seat.group];
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    for (LinkPass<Lanes<Real>>& beyond : passes.subspan(seat.link + 1)) beyond.impulse = 0.;
    Wrench<Lanes<Real>> struck;
    set_lane(struck, seat.lane, p);
    for (std::size_t n = seat.link + 1; n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      LinkPass<Lanes<Real>>& pass = passes[n];
      pass.impulse = -along(link.joint, struck);
      struck = inward(link, pass, struck + (pass.impulse * pass.D_inverse) * pass.U);
    }
    p = lane_of(inward(group, struck), seat.lane);
  }
  return model.mobile() ? solve_base(workspace.base, p) : Motion<Real>{};
}

/// Carries the base's jump out along a group's chains to their links `last`; `struck` says that the
/// impulse acted on one of them. Returns the jumps of those links, link axes; `on_joint(n, jump of
/// its rate)` sees each joint passed.
template <class Real, class OnJoint>
Motion<Lanes<Real>> carry_outward(const ChainGroup<Real>& group, std::size_t last, bool struck,
                                  const Motion<Real>& base, Workspace<Real>& workspace,
                                  const OnJoint& on_joint) {
  Motion<Lanes<Real>> jump = outward(group, base);
  const std::span<const LinkPass<Lanes<Real>>> passes = workspace.passes(group);
  for (std::size_t n = 0; n <= last; ++n) {
    const LinkPass<Lanes<Real>>& pass = passes[n];
    jump = outward(group.links[n], pass, jump);
    const Lanes<Real> u = struck ? pass.impulse : Lanes<Real>(0.);
    const Lanes<Real> rate = pass.D_inverse * (u - dot(pass.U, jump));
    jump = with_joint_motion(group.links[n].joint, jump, rate);
    on_joint(n, rate);
  }
  return jump;
}

template <class Real>
bool in_group(const Model<Real>& model, std::size_t body, std::size_t group) {
  return body > 0 && model.seat_of(body).group == group;
}

/// The velocity change of `b` under the impulse `impulse_W` at `a`, world axes.
template <class Real>
Vector3<Real> response(const Model<Real>& model, Workspace<Real>& workspace,
                       const BodyPoint<Real>& a, const Vector3<Real>& impulse_W,
                       const BodyPoint<Real>& b) {
  Motion<Real> jump = jump_of_base(model, workspace, a, impulse_W);
  if (b.body > 0) {
    const Seat& seat = model.seat_of(b.body);
    const Motion<Lanes<Real>> jumps =
        carry_outward(model.groups()[seat.group], seat.link, in_group(model, a.body, seat.group),
                      jump, workspace, [](std::size_t, const Lanes<Real>&) {});
    jump = lane_of(jumps, seat.lane);
  }
  const BodyMotion<Real>& body = workspace.bodies[b.body];
  return body.R_WB * jump.linear + cross(body.R_WB * jump.angular, b.p_WP - body.p_WB);
}

/// A jump of the base's velocity, from base axes.
template <class Real>
Motion<Real> in_world(const Model<Real>& model, const Workspace<Real>& workspace,
                      const Motion<Real>& base) {
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  Motion<Real> jump{R_WB * base.angular, R_WB * base.linear};
  hold_in_plane(model, jump.angular, jump.linear);
  return jump;
}

/// Calls `on_joint(l, jump of its rate)` for every joint of the robot; returns the base's jump,
/// base axes.
template <class Real, class OnJoint>
Motion<Real> jump_of_robot(const Model<Real>& model, Workspace<Real>& workspace,
                           const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                           const OnJoint& on_joint) {
  const Motion<Real> base = jump_of_base(model, workspace, point, impulse_W);
  for (std::size_t g = 0; g < model.groups().size(); ++g) {
    const ChainGroup<Real>& group = model.groups()[g];
    if (group.link_count() == 0) continue;
    carry_outward(group, group.link_count() - 1, in_group(model, point.body, g), base, workspace,
                  [&](std::size_t n, const Lanes<Real>& rates) {
                    for (std::size_t lane = 0; lane < group.chain_count; ++lane) {
                      on_joint(group.first_links[lane] + n, rates[lane]);
                    }
                  });
  }
  return base;
}

}  // namespace

template <class Real>
void articulated_inertias(const Model<Real>& model, Workspace<Real>& workspace) {
  for (std::size_t g = 0; g < model.groups().size(); ++g) {
    const ChainGroup<Real>& group = model.groups()[g];
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    ArticulatedInertia<Lanes<Real>> IA;
    for (std::size_t n = group.link_count(); n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      LinkPass<Lanes<Real>>& pass = passes[n];
      const Elimination<Lanes<Real>> free =
          n + 1 == group.link_count() ? group.leaf : eliminate(link.joint, IA + link.inertia);
      pass.U = free.U;
      pass.D_inverse = free.D_inverse;
      IA = inward(link, pass, free.Ia);
    }
    workspace.hips[g].IA = IA;
  }
  factor_base(model, workspace);
}

template <class Real>
Matrix3<Real> impulse_response(const Model<Real>& model, Workspace<Real>& workspace,
                               const BodyPoint<Real>& a, const BodyPoint<Real>& b) {
  const Vector3<Real> x = response(model, workspace, a, {1., 0., 0.}, b);
  const Vector3<Real> y = response(model, workspace, a, {0., 1., 0.}, b);
  const Vector3<Real> z = response(model, workspace, a, {0., 0., 1.}, b);
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

template <class Real>
void velocity_change(const Model<Real>& model, Workspace<Real>& workspace,
                     const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                     std::span<Real> change) {
  const std::size_t offset = velocity_count(model) - model.link_count();
  const Motion<Real> base =
      jump_of_robot(model, workspace, point, impulse_W,
                    [&](std::size_t l, const Real& rate) { change[offset + l] = rate; });
  if (!model.mobile()) return;
  const Motion<Real> jump = in_world(model, workspace, base);
  write_base_velocity<Real>(jump.angular, jump.linear, change);
}

template <class Real>
void apply_impulse(const Model<Real>& model, Workspace<Real>& workspace,
                   const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                   State<Real>& state) {
  const Motion<Real> base =
      jump_of_robot(model, workspace, point, impulse_W,
                    [&](std::size_t l, const Real& rate) { state.joint_rates[l] += rate; });
  const Motion<Real> jump = in_world(model, workspace, base);
  state.base_angular_velocity += jump.angular;
  state.base_velocity += jump.linear;
}

template void articulated_inertias(const Model<double>&, Workspace<double>&);
template Matrix3<double> impulse_response(const Model<double>&, Workspace<double>&,
                                          const BodyPoint<double>&, const BodyPoint<double>&);
template void velocity_change(const Model<double>&, Workspace<double>&, const BodyPoint<double>&,
                              const Vector3<double>&, std::span<double>);
template void apply_impulse(const Model<double>&, Workspace<double>&, const BodyPoint<double>&,
                            const Vector3<double>&, State<double>&);

}  // namespace hookpoint::dts
