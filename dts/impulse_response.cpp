#include "dts/impulse_response.h"

#include <utility>

#include "dts/carriers.h"
#include "dts/configuration.h"
#include "dts/planar_base.h"

namespace hookpoint::dts {
namespace {

/// Calls `visit(group, seat)` for the chains from `body` to the base, each with the seat of the
/// last of its links on the way.
template <class Real, class Visit>
void for_each_on_path(const Model<Real>& model, std::size_t body, const Visit& visit) {
  while (body > 0) {
    const Seat& seat = model.seat_of(body);
    const ChainGroup<Real>& group = model.groups()[seat.group];
    visit(group, seat);
    body = group.carriers[seat.lane];
  }
}

/// What strikes a body: an impulse [N m s, N s] about its origin, its axes, and one along the joint
/// that carries it.
template <class Real>
struct Blow {
  std::size_t body = 0;
  Wrench<Real> impulse;
  Real along_joint{};
};

template <class Real>
Blow<Real> blow_at(const Workspace<Real>& workspace, const BodyPoint<Real>& point,
                   const Vector3<Real>& impulse_W) {
  const BodyMotion<Real>& body = workspace.bodies[point.body];
  return {point.body,
          {transpose_times(body.R_WB, cross(point.p_WP - body.p_WB, impulse_W)),
           transpose_times(body.R_WB, impulse_W)},
          {}};
}

/// Carries an impulse from the body that it strikes to the base, leaving its part along each joint on
/// the way in the chain's lane of `links[].impulse`, and returns the velocity jump of the base, base
/// axes.
template <class Real>
Motion<Real> jump_of_base(const Model<Real>& model, Workspace<Real>& workspace,
                          const Blow<Real>& blow) {
  Wrench<Real> p{-blow.impulse.moment, -blow.impulse.force};
  Real along_joint = blow.along_joint;
  for_each_on_path(model, blow.body, [&](const ChainGroup<Real>& group, const Seat& seat) {
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    Wrench<Lanes<Real>> struck;
    set_lane(struck, seat.lane, p);
    Lanes<Real> driven = 0.;
    driven.lanes[seat.lane] = std::exchange(along_joint, Real{});
    for (std::size_t n = seat.link + 1; n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      LinkPass<Lanes<Real>>& pass = passes[n];
      pass.impulse = std::exchange(driven, 0.) - along(link.joint, struck);
      struck = inward(link, pass, struck + (pass.impulse * pass.D_inverse) * pass.U);
    }
    p = lane_of(inward(group, struck), seat.lane);
  });
  return model.mobile() ? solve_base(workspace.base, p) : Motion<Real>{};
}

/// Takes back what jump_of_base left.
template <class Real>
void clear_impulses(const Model<Real>& model, Workspace<Real>& workspace, std::size_t body) {
  for_each_on_path(model, body, [&](const ChainGroup<Real>& group, const Seat& seat) {
    for (LinkPass<Lanes<Real>>& pass : workspace.passes(group).first(seat.link + 1))
      pass.impulse = 0.;
  });
}

/// Carries the jumps of the bodies that carry a group's chains out along these to their links
/// `last`, and returns the jumps of those, link axes; `on_joint(n, jump of its rate, jump of its
/// link)` sees each joint passed.
template <class Real, class OnJoint>
Motion<Lanes<Real>> carry_outward(const ChainGroup<Real>& group, std::size_t last,
                                  const Motion<Lanes<Real>>& carriers, Workspace<Real>& workspace,
                                  const OnJoint& on_joint) {
  Motion<Lanes<Real>> jump = outward(group, carriers);
  const std::span<const LinkPass<Lanes<Real>>> passes = workspace.passes(group);
  for (std::size_t n = 0; n <= last; ++n) {
    const LinkPass<Lanes<Real>>& pass = passes[n];
    jump = outward(group.links[n], pass, jump);
    const Lanes<Real> rate = pass.D_inverse * (pass.impulse - dot(pass.U, jump));
    jump = with_joint_motion(group.links[n].joint, jump, rate);
    on_joint(n, rate, jump);
  }
  return jump;
}

/// The jump of `body`, in its axes, from the base's.
template <class Real>
Motion<Real> jump_of_body(const Model<Real>& model, Workspace<Real>& workspace,
                          const Motion<Real>& base, std::size_t body) {
  if (body == 0) return base;
  const Seat& seat = model.seat_of(body);
  const ChainGroup<Real>& group = model.groups()[seat.group];
  const Motion<Real> carrier = jump_of_body(model, workspace, base, group.carriers[seat.lane]);
  const Motion<Lanes<Real>> jumps =
      carry_outward(group, seat.link, in_all_lanes<Lanes<Real>>(carrier), workspace,
                    [](std::size_t, const Lanes<Real>&, const Motion<Lanes<Real>>&) {});
  return lane_of(jumps, seat.lane);
}

/// The velocity change of `b` under the impulse `impulse_W` at `a`, world axes.
template <class Real>
Vector3<Real> response(const Model<Real>& model, Workspace<Real>& workspace,
                       const BodyPoint<Real>& a, const Vector3<Real>& impulse_W,
                       const BodyPoint<Real>& b) {
  const Motion<Real> base = jump_of_base(model, workspace, blow_at(workspace, a, impulse_W));
  const Motion<Real> jump = jump_of_body(model, workspace, base, b.body);
  clear_impulses(model, workspace, a.body);
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
                           const Blow<Real>& blow, const OnJoint& on_joint) {
  const Motion<Real> base = jump_of_base(model, workspace, blow);
  Motion<Lanes<Real>> carriers = in_all_lanes<Lanes<Real>>(base);
  for (const ChainGroup<Real>& group : model.groups()) {
    if (group.link_count() == 0) continue;
    if (!group.on_base()) carriers = carrier_motion(group, workspace);
    carry_outward(group, group.link_count() - 1, carriers, workspace,
                  [&](std::size_t n, const Lanes<Real>& rates, const Motion<Lanes<Real>>& jumps) {
                    for (std::size_t lane = 0; lane < group.chain_count; ++lane) {
                      const std::size_t l = group.first_links[lane] + n;
                      on_joint(l, rates[lane]);
                      if (group.links[n].carries)
                        workspace.carrier_motions[l + 1] = lane_of(jumps, lane);
                    }
                  });
  }
  clear_impulses(model, workspace, blow.body);
  return base;
}

/// M^-1 J^T of a blow.
template <class Real>
void change_of_velocity(const Model<Real>& model, Workspace<Real>& workspace,
                        const Blow<Real>& blow, std::span<Real> change) {
  const std::size_t offset = velocity_count(model) - model.link_count();
  const Motion<Real> base = jump_of_robot(
      model, workspace, blow, [&](std::size_t l, const Real& rate) { change[offset + l] = rate; });
  if (!model.mobile()) return;
  const Motion<Real> jump = in_world(model, workspace, base);
  write_base_velocity<Real>(jump.angular, jump.linear, change);
}

}  // namespace

template <class Real>
void articulated_inertias(const Model<Real>& model, Workspace<Real>& workspace) {
  clear_carried(workspace);
  for_each_inward(model, [&](const ChainGroup<Real>& group) {
    const std::span<LinkPass<Lanes<Real>>> passes = workspace.passes(group);
    ArticulatedInertia<Lanes<Real>> IA;
    for (std::size_t n = group.link_count(); n-- > 0;) {
      const LinkConstants<Lanes<Real>>& link = group.links[n];
      LinkPass<Lanes<Real>>& pass = passes[n];
      if (link.carries) IA = IA + carried_by(group, n, workspace).IA;
      const Elimination<Lanes<Real>> free = group.ends_at(n) ? group.leaf
                                            : link.full ? eliminate_fully(link, IA + link.inertia)
                                                        : eliminate(link.joint, IA + link.inertia);
      pass.U = free.U;
      pass.D_inverse = free.D_inverse;
      IA = inward(link, pass, free.Ia);
    }
    workspace.hips[group.index].IA = IA;
    if (!group.on_base()) hand_inward(group, IA, &HipPass<Real>::IA, workspace);
  });
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
  change_of_velocity(model, workspace, blow_at(workspace, point, impulse_W), change);
}

template <class Real>
void velocity_change_by_joint(const Model<Real>& model, Workspace<Real>& workspace,
                              std::size_t link, const Real& impulse, std::span<Real> change) {
  change_of_velocity(model, workspace, Blow<Real>{link + 1, {}, impulse}, change);
}

template <class Real>
void apply_impulse(const Model<Real>& model, Workspace<Real>& workspace,
                   const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                   State<Real>& state) {
  const Motion<Real> base =
      jump_of_robot(model, workspace, blow_at(workspace, point, impulse_W),
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
template void velocity_change_by_joint(const Model<double>&, Workspace<double>&, std::size_t,
                                       const double&, std::span<double>);
template void apply_impulse(const Model<double>&, Workspace<double>&, const BodyPoint<double>&,
                            const Vector3<double>&, State<double>&);

}  // namespace hookpoint::dts
