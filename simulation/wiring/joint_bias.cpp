#include "simulation/wiring/joint_bias.h"

#include <algorithm>

#include "simulation/experiment/joint_type.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

JointBias::JointBias(const Experiment& experiment) : experiment_(experiment) {
  std::size_t joints = 0, most_bodies = 0;
  for (const RobotSpec& robot : experiment.robots) {
    joints += joint_count(robot);
    most_bodies = std::max(most_bodies, body_count(robot));
  }
  values_.resize(joints);
  bodies_.resize(most_bodies);
}

void JointBias::compute(const WorldState& state) {
  std::size_t body = 0, joint = 0;
  for (const RobotSpec& robot : experiment_.robots) {
    compute_robot(robot, body, joint, state);
    body += body_count(robot);
    joint += joint_count(robot);
  }
}

void JointBias::compute_robot(const RobotSpec& robot, std::size_t first_body,
                              std::size_t first_joint, const WorldState& state) {
  const BodyState* const at = &state.bodies[first_body];
  const Vector3d& g = experiment_.gravity;
  bodies_[0] = {};
  for_each_link(robot, [&](const TreeLink& link) {
    const BodyState &here = at[link.body], &before = at[link.parent];
    const Body& carrier = bodies_[link.parent];
    const Vector3d z = rotate(here.orientation, Vector3d{0., 0., 1.});
    const Vector3d r = here.position - before.position, &w = before.angular_velocity;
    const Vector3d turning = state.joints[first_joint + link.joint()].rate * cross(w, z);
    Body& body = bodies_[link.body];
    body = {carrier.acceleration + cross(carrier.angular_acceleration, r) + cross(w, cross(w, r)),
            carrier.angular_acceleration,
            {},
            {},
            z,
            link.parent,
            joint_type(link.link.joint).turns};
    if (body.turns)
      body.angular_acceleration += turning;
    else
      body.acceleration += 2. * turning;

    // F = m (a_c - g), N = I alpha + w x I w about the centre of mass c.
    const MassSpec& mass = link.link.body.mass;
    const Vector3d arm = rotate(here.orientation, mass.center_of_mass);
    const Vector3d center = here.position + arm, &spin = here.angular_velocity;
    const auto times_inertia = [&](const Vector3d& a) {
      return rotate(here.orientation, mass.inertia * rotate(conjugate(here.orientation), a));
    };
    const Vector3d& alpha = body.angular_acceleration;
    const Vector3d a_c = body.acceleration + cross(alpha, arm) + cross(spin, cross(spin, arm));
    body.gravity.force = -mass.mass * g;
    body.gravity.moment = cross(center, body.gravity.force);
    body.all.force = mass.mass * (a_c - g);
    body.all.moment =
        cross(center, body.all.force) + times_inertia(alpha) + cross(spin, times_inertia(spin));
  });
  // From the tips to the base, each to what carries it.
  for (std::size_t i = body_count(robot); --i > 0;) {
    const Body& body = bodies_[i];
    const auto along = [&](const Load& load) {
      return dot(body.axis,
                 body.turns ? load.moment - cross(at[i].position, load.force) : load.force);
    };
    values_[first_joint + i - 1] = {along(body.gravity), along(body.all)};
    Body& carrier = bodies_[body.carrier];
    for (const auto part : {&Body::gravity, &Body::all}) {
      (carrier.*part).force += (body.*part).force;
      (carrier.*part).moment += (body.*part).moment;
    }
  }
}

}  // namespace hookpoint::simulation
