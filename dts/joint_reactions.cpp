#include "dts/joint_reactions.h"

#include <algorithm>

#include "dts/rigid_body.h"

namespace hookpoint::dts {
namespace {

/// What the body's motion takes, about its origin, world axes.
template <class Real>
Wrench<Real> needed(const RigidInertia<Real>& body, const BodyMotion<Real>& motion,
                    const Motion<Real>& less_gravity) {
  const Matrix3<Real>& R = motion.R_WB;
  const Motion<Real> a{transpose_times(R, less_gravity.angular),
                       transpose_times(R, less_gravity.linear)};
  const Wrench<Real> in_body = body * a + velocity_wrench(body, transpose_times(R, motion.w_WB));
  return {R * in_body.moment, R * in_body.force};
}

}  // namespace

template <class Real>
void joint_reactions(const Model<Real>& model, const Vector3<Real>& gravity_W,
                     const Workspace<Real>& workspace, std::span<const Motion<Real>> accelerations,
                     std::span<Wrench<Real>> reactions) {
  std::ranges::fill(reactions, Wrench<Real>{});
  // A body stands behind the one that carries it.
  for (std::size_t body = model.body_count(); body-- > 0;) {
    const Motion<Real>& a = accelerations[body];
    const BodyMotion<Real>& motion = workspace.bodies[body];
    reactions[body] =
        reactions[body] +
        needed(model.inertia(body), motion, Motion<Real>{a.angular, a.linear - gravity_W}) -
        workspace.external[body];
    if (body == 0) continue;
    const std::size_t carrier = model.carrier_of(body);
    const Wrench<Real>& on_link = reactions[body];
    const Vector3<Real> arm = motion.p_WB - workspace.bodies[carrier].p_WB;
    reactions[carrier] = reactions[carrier] +
                         Wrench<Real>{on_link.moment + cross(arm, on_link.force), on_link.force};
  }
}

template void joint_reactions(const Model<double>&, const Vector3<double>&,
                              const Workspace<double>&, std::span<const Motion<double>>,
                              std::span<Wrench<double>>);

}  // namespace hookpoint::dts
