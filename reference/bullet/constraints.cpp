#include "reference/bullet/constraints.h"

#include <BulletDynamics/Featherstone/btMultiBodyGearConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>

#include <algorithm>
#include <limits>

#include "simulation/experiment/loop_places.h"

namespace hookpoint::reference {
namespace {

/// Part of what has come apart that a step takes back: Bullet's own for joints.
constexpr double error_reduction = 0.2;

BulletRobot& robot_of(const std::vector<std::unique_ptr<BulletRobot>>& robots,
                      const RobotTree& tree, int robot) {
  return **std::ranges::find(robots, tree.bases[static_cast<std::size_t>(robot)],
                             &BulletRobot::first_body);
}

}  // namespace

BulletConstraints::BulletConstraints(const simulation::Experiment& experiment,
                                     const RobotTree& tree,
                                     const std::vector<std::unique_ptr<BulletRobot>>& robots,
                                     btMultiBodyDynamicsWorld& world)
    : world_(world), deltat_(experiment.deltat) {
  for (std::size_t i = 0; i < experiment.loops.size(); ++i) {
    const simulation::LoopSpec& loop = experiment.loops[i];
    BulletRobot& robot = robot_of(robots, tree, loop.robot);
    const auto a = static_cast<std::size_t>(loop.body_a), b = static_cast<std::size_t>(loop.body_b);
    for (const simulation::LoopPlace& place : simulation::loop_places(loop)) {
      add(std::make_unique<btMultiBodyPoint2Point>(
          &robot.multibody(), loop.body_a - 1, &robot.multibody(), loop.body_b - 1,
          robot.in_bullet_frame(a, place[0]), robot.in_bullet_frame(b, place[1])));
      places_.push_back(
          {i, constraints_.back().get(), &robot.collider(a),
           robot.in_bullet_frame(a, place[0]) - robot.in_bullet_frame(a, loop.point_a)});
    }
  }
  for (const simulation::CouplingSpec& coupling : experiment.couplings) {
    btMultiBody& body = robot_of(robots, tree, coupling.robot).multibody();
    auto gear = std::make_unique<btMultiBodyGearConstraint>(
        &body, static_cast<int>(coupling.follower), &body, static_cast<int>(coupling.leader),
        btVector3(0., 0., 0.), btVector3(0., 0., 0.), btMatrix3x3::getIdentity(),
        btMatrix3x3::getIdentity());
    // q_follower + gear ratio q_leader = target
    gear->setGearRatio(-coupling.ratio);
    gear->setRelativePositionTarget(coupling.offset);
    gear->setErp(error_reduction);
    add(std::move(gear));
  }
}

BulletConstraints::~BulletConstraints() {
  for (const auto& constraint : constraints_) world_.removeMultiBodyConstraint(constraint.get());
}

/// Bullet's constraints are as strong as 100 N s by themselves.
void BulletConstraints::add(std::unique_ptr<btMultiBodyConstraint> constraint) {
  constraint->setMaxAppliedImpulse(std::numeric_limits<double>::max());
  constraint->finalizeMultiDof();
  world_.addMultiBodyConstraint(constraint.get());
  constraints_.push_back(std::move(constraint));
}

// Its rows push body b along the world's axes.
void BulletConstraints::read(std::span<simulation::LoopState> loops) const {
  for (simulation::LoopState& loop : loops) loop = {};
  for (const Place& place : places_) {
    btMultiBodyConstraint& rows = *place.constraint;  // getAppliedImpulse is not const
    const Vector3d force =
        (-1. / deltat_) *
        Vector3d{rows.getAppliedImpulse(0), rows.getAppliedImpulse(1), rows.getAppliedImpulse(2)};
    simulation::LoopState& loop = loops[place.loop];
    loop.force += force;
    loop.moment += cross(vector(place.body->getWorldTransform().getBasis() * place.lever), force);
  }
}

}  // namespace hookpoint::reference
