#include "dts/composite_bodies.h"

namespace hookpoint::dts {
namespace {

/// `body`, about the origin of its frame in its axes, about the point that lies `r` before that
/// origin, world axes: h' = h + m r, I' = I + 2 (r.h) 1 - r h^T - h r^T + m (r.r 1 - r r^T).
RigidInertia<double> moved(const RigidInertia<double>& body, const Matrix3d& R_WB,
                           const Vector3d& r) {
  const Vector3d h = R_WB * body.mass_moment;
  const Symmetric3d I = rotate(R_WB, body.inertia);
  const double m = body.mass;
  // Both terms of r together: -r g^T - g r^T with g = h + m r / 2.
  const Vector3d g = h + 0.5 * m * r;
  const double twice = 2. * dot(r, g);
  return {
      m,
      h + m * r,
      {I.xx + twice - 2. * r.x * g.x, I.yy + twice - 2. * r.y * g.y, I.zz + twice - 2. * r.z * g.z,
       I.xy - r.x * g.y - g.x * r.y, I.xz - r.x * g.z - g.x * r.z, I.yz - r.y * g.z - g.y * r.z}};
}

}  // namespace

CompositeBodies composite_bodies(const Model<double>& model, const Workspace<double>& workspace) {
  CompositeBodies composite;
  const Vector3d& O = workspace.bodies[0].p_WB;
  for (std::size_t body = 0; body < model.body_count(); ++body) {
    const BodyMotion<double>& at = workspace.bodies[body];
    const Vector3d r = at.p_WB - O;
    composite.carried.push_back(moved(model.inertia(body), at.R_WB, r));
    if (body == 0) continue;
    const Seat& seat = model.seat_of(body);
    const Vector3d z = at.R_WB * Vector3d{0., 0., 1.};
    const LinkConstants<Lanes<double>>& link = model.groups()[seat.group].links[seat.link];
    const bool turns = link.joint == JointType::revolute;
    composite.rotor_inertias.push_back(link.rotor_inertia.lanes[seat.lane]);
    composite.freedoms.push_back(turns ? Motion<double>{z, cross(r, z)} : Motion<double>{{}, z});
  }
  for (std::size_t body = model.body_count() - 1; body > 0; --body) {
    const RigidInertia<double>& outer = composite.carried[body];
    RigidInertia<double>& inner = composite.carried[model.carrier_of(body)];
    inner.mass += outer.mass;
    inner.mass_moment += outer.mass_moment;
    inner.inertia += outer.inertia;
  }
  return composite;
}

}  // namespace hookpoint::dts
