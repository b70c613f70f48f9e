#include "dts/impulse_response.h"

#include "dts/configuration.h"
#include "dts/hip_forces.h"
#include "dts/joint.h"

namespace hookpoint::dts {
namespace {

/// Carries an impulse from `point` to the base, leaving its part along each joint of the chain in
/// `links[].impulse`, and returns the velocity jump of the base, base axes.
template <class Real>
Motion<Real> jump_of_base(const Model<Real>& model, Workspace<Real>& workspace,
                          const BodyPoint<Real>& point, const Vector3<Real>& impulse_W) {
  const BodyMotion<Real>& body = workspace.bodies[point.body];
  Wrench<Real> p{-transpose_times(body.R_WB, cross(point.p_WP - body.p_WB, impulse_W)),
                 -transpose_times(body.R_WB, impulse_W)};
  if (point.body > 0) {
    const ChainConstants<Real>& chain = model.chains()[model.chain_of(point.body)];
    for (std::size_t l = point.body; l < chain.first_link + chain.link_count; ++l) {
      workspace.links[l].impulse = Real(0.);
    }
    for (std::size_t l = point.body; l-- > chain.first_link;) {
      const LinkConstants<Real>& link = model.links()[l];
      LinkPass<Real>& pass = workspace.links[l];
      pass.impulse = -along(link.joint, p);
      p = inward(link, pass, p + (pass.impulse * pass.D_inverse) * pass.U);
    }
    p = inward(chain, p);
  }
  return model.mobile() ? solve_base(workspace.base, p) : Motion<Real>{};
}

/// Carries the base's jump out along the chain of link `last`; `struck` says that the impulse acted
/// on this chain. Returns the jump of `last`, link axes; `on_joint(l, jump of its rate)` sees each
/// joint passed.
template <class Real, class OnJoint>
Motion<Real> carry_outward(const Model<Real>& model, const Workspace<Real>& workspace,
                           const ChainConstants<Real>& chain, std::size_t last, bool struck,
                           const Motion<Real>& base, const OnJoint& on_joint) {
  Motion<Real> jump = outward(chain, base);
  for (std::size_t l = chain.first_link; l <= last; ++l) {
    const LinkPass<Real>& pass = workspace.links[l];
    jump = outward(model.links()[l], pass, jump);
    const Real u = struck ? pass.impulse : Real(0.);
    const Real rate = pass.D_inverse * (u - dot(pass.U, jump));
    jump = with_joint_motion(model.links()[l].joint, jump, rate);
    on_joint(l, rate);
  }
  return jump;
}

template <class Real>
bool same_chain(const Model<Real>& model, std::size_t body, std::size_t chain) {
  return body > 0 && model.chain_of(body) == chain;
}

/// The velocity change of `b` under the impulse `impulse_W` at `a`, world axes.
template <class Real>
Vector3<Real> response(const Model<Real>& model, Workspace<Real>& workspace,
                       const BodyPoint<Real>& a, const Vector3<Real>& impulse_W,
                       const BodyPoint<Real>& b) {
  Motion<Real> jump = jump_of_base(model, workspace, a, impulse_W);
  if (b.body > 0) {
    const std::size_t k = model.chain_of(b.body);
    jump = carry_outward(model, workspace, model.chains()[k], b.body - 1,
                         same_chain(model, a.body, k), jump, [](std::size_t, const Real&) {});
  }
  const BodyMotion<Real>& body = workspace.bodies[b.body];
  return body.R_WB * jump.linear + cross(body.R_WB * jump.angular, b.p_WP - body.p_WB);
}

/// Calls `on_joint(l, jump of its rate)` for every joint of the robot; returns the base's jump,
/// base axes.
template <class Real, class OnJoint>
Motion<Real> jump_of_robot(const Model<Real>& model, Workspace<Real>& workspace,
                           const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                           const OnJoint& on_joint) {
  const Motion<Real> base = jump_of_base(model, workspace, point, impulse_W);
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    const ChainConstants<Real>& chain = model.chains()[k];
    if (chain.link_count == 0) continue;
    carry_outward(model, workspace, chain, chain.first_link + chain.link_count - 1,
                  same_chain(model, point.body, k), base, on_joint);
  }
  return base;
}

}  // namespace

template <class Real>
void articulated_inertias(const Model<Real>& model, Workspace<Real>& workspace) {
  for (std::size_t k = 0; k < model.chain_count(); ++k) {
    const ChainConstants<Real>& chain = model.chains()[k];
    ArticulatedInertia<Real> IA;
    for (std::size_t l = chain.first_link + chain.link_count; l-- > chain.first_link;) {
      LinkPass<Real>& pass = workspace.links[l];
      const LinkConstants<Real>& link = model.links()[l];
      const Elimination<Real> free =
          is_last(chain, l) ? chain.leaf : eliminate(link.joint, IA + link.inertia);
      pass.U = free.U;
      pass.D_inverse = free.D_inverse;
      IA = inward(link, pass, free.Ia);
    }
    workspace.hips[k].IA = IA;
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
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  write_base_velocity<Real>(R_WB * base.angular, R_WB * base.linear, change);
}

template <class Real>
void apply_impulse(const Model<Real>& model, Workspace<Real>& workspace,
                   const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                   State<Real>& state) {
  const Motion<Real> base =
      jump_of_robot(model, workspace, point, impulse_W,
                    [&](std::size_t l, const Real& rate) { state.joint_rates[l] += rate; });
  const Matrix3<Real>& R_WB = workspace.bodies[0].R_WB;
  state.base_angular_velocity += R_WB * base.angular;
  state.base_velocity += R_WB * base.linear;
}

template void articulated_inertias(const Model<double>&, Workspace<double>&);
template Matrix3<double> impulse_response(const Model<double>&, Workspace<double>&,
                                          const BodyPoint<double>&, const BodyPoint<double>&);
template void velocity_change(const Model<double>&, Workspace<double>&, const BodyPoint<double>&,
                              const Vector3<double>&, std::span<double>);
template void apply_impulse(const Model<double>&, Workspace<double>&, const BodyPoint<double>&,
                            const Vector3<double>&, State<double>&);

}  // namespace hookpoint::dts
