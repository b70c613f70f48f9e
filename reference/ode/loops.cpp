#include "reference/ode/loops.h"

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::LoopSpec;

dJointID make_joint(dWorldID world, const LoopSpec& loop, const BodyState& on, dBodyID a,
                    dBodyID b) {
  const Vector3d place = on.position + rotate(on.orientation, loop.point_a);
  if (!loop.axes) {
    const dJointID ball = dJointCreateBall(world, nullptr);
    dJointAttach(ball, a, b);
    dJointSetBallAnchor(ball, place.x, place.y, place.z);
    return ball;
  }
  const Vector3d axis = rotate(on.orientation, (*loop.axes)[0]);
  const dJointID hinge = dJointCreateHinge(world, nullptr);
  dJointAttach(hinge, a, b);
  dJointSetHingeAnchor(hinge, place.x, place.y, place.z);
  dJointSetHingeAxis(hinge, axis.x, axis.y, axis.z);
  return hinge;
}

}  // namespace

OdeLoops::OdeLoops(const simulation::Experiment& experiment, const RobotTree& tree, dWorldID world,
                   const std::vector<dBodyID>& bodies) {
  for (const LoopSpec& loop : experiment.loops) {
    const std::size_t a = tree.index(loop.robot, loop.body_a);
    const std::size_t b = tree.index(loop.robot, loop.body_b);
    const dJointID joint = make_joint(world, loop, tree.bodies[a].initial, bodies[a], bodies[b]);
    dJointSetFeedback(joint, &feedback_.emplace_back());
    const bool by_a = bodies[a] != nullptr;
    loops_.push_back({joint, bodies[a], bodies[b],
                      (by_a ? loop.point_a : loop.point_b) -
                          tree.bodies[by_a ? a : b].body->mass.center_of_mass});
  }
}

// ODE writes force and torque about the centre of mass of either body: of a where it moves, else of b
// with the sign turned.
void OdeLoops::read(std::span<simulation::LoopState> loops) const {
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    const Loop& loop = loops_[i];
    const dJointFeedback& feedback = feedback_[i];
    const bool by_a = loop.a != nullptr;
    const dReal* const q = dBodyGetQuaternion(by_a ? loop.a : loop.b);
    const Vector3d lever = rotate(Quaterniond{q[0], q[1], q[2], q[3]}, loop.lever);
    const double sign = by_a ? 1. : -1.;
    const Vector3d force = vector(by_a ? feedback.f1 : feedback.f2);
    const Vector3d moment = vector(by_a ? feedback.t1 : feedback.t2) - cross(lever, force);
    loops[i].force = sign * force;
    loops[i].moment = sign * moment;
  }
}

}  // namespace hookpoint::reference
