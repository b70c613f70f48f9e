#include "dts/energy.h"

#include "dts/composite_bodies.h"

namespace hookpoint::dts {
namespace {

/// A body's momentum, world axes: angular about its own origin (the moment) and linear (the force).
template <class Real>
Wrench<Real> momentum_of(const RigidInertia<Real>& inertia, const BodyMotion<Real>& body) {
  const Vector3<Real> h = body.R_WB * inertia.mass_moment;
  const Vector3<Real> spin = body.R_WB * (inertia.inertia * transpose_times(body.R_WB, body.w_WB));
  return {spin + cross(h, body.v_WB), inertia.mass * body.v_WB + cross(body.w_WB, h)};
}

/// I_r q'^2 / 2 of the joint that carries `body` >= 1; q' is what its motion has along z beyond
/// that of its carrier.
template <class Real>
Real rotor_energy(const Model<Real>& model, const Workspace<Real>& workspace, std::size_t body) {
  const Seat& seat = model.seat_of(body);
  const LinkConstants<Lanes<Real>>& link = model.groups()[seat.group].links[seat.link];
  const BodyMotion<Real>& own = workspace.bodies[body];
  const BodyMotion<Real>& carrier = workspace.bodies[model.carrier_of(body)];
  const Vector3<Real> beyond =
      link.joint == JointType::prismatic
          ? own.v_WB - carrier.v_WB - cross(carrier.w_WB, own.p_WB - carrier.p_WB)
          : own.w_WB - carrier.w_WB;
  const Real rate = transpose_times(own.R_WB, beyond).z;
  return 0.5 * link.rotor_inertia.lanes[seat.lane] * rate * rate;
}

}  // namespace

template <class Real>
Real kinetic_energy(const Model<Real>& model, const Workspace<Real>& workspace) {
  Real energy{};
  for (std::size_t body = 0; body < model.body_count(); ++body) {
    const BodyMotion<Real>& motion = workspace.bodies[body];
    const Wrench<Real> momentum = momentum_of(model.inertia(body), motion);
    energy += 0.5 * (dot(momentum.moment, motion.w_WB) + dot(momentum.force, motion.v_WB));
    if (body > 0) energy += rotor_energy(model, workspace, body);
  }
  return energy;
}

template <class Real>
Real potential_energy(const Model<Real>& model, const Vector3<Real>& gravity_W,
                      const Workspace<Real>& workspace) {
  Vector3<Real> mass_moment;
  for (std::size_t body = 0; body < model.body_count(); ++body) {
    const RigidInertia<Real>& inertia = model.inertia(body);
    const BodyMotion<Real>& motion = workspace.bodies[body];
    mass_moment += inertia.mass * motion.p_WB + motion.R_WB * inertia.mass_moment;
  }
  return -dot(gravity_W, mass_moment);
}

template <class Real>
Vector3<Real> linear_momentum(const Model<Real>& model, const Workspace<Real>& workspace) {
  Vector3<Real> sum;
  for (std::size_t body = 0; body < model.body_count(); ++body) {
    sum += momentum_of(model.inertia(body), workspace.bodies[body]).force;
  }
  return sum;
}

template <class Real>
Vector3<Real> angular_momentum(const Model<Real>& model, const Workspace<Real>& workspace) {
  Vector3<Real> sum;
  for (std::size_t body = 0; body < model.body_count(); ++body) {
    const BodyMotion<Real>& motion = workspace.bodies[body];
    const Wrench<Real> momentum = momentum_of(model.inertia(body), motion);
    sum += momentum.moment + cross(motion.p_WB, momentum.force);
  }
  return sum;
}

template double kinetic_energy(const Model<double>&, const Workspace<double>&);
template double potential_energy(const Model<double>&, const Vector3<double>&,
                                 const Workspace<double>&);
template Vector3<double> linear_momentum(const Model<double>&, const Workspace<double>&);
template Vector3<double> angular_momentum(const Model<double>&, const Workspace<double>&);

}  // namespace hookpoint::dts
