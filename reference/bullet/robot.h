// A robot with chains as Bullet's btMultiBody, the articulated-body algorithm in joint coordinates.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>
#include <span>
#include <vector>

#include "reference/bullet/shapes.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

/// What a base meets the ground with, where it has no chains and does not touch by points.
struct BulletSurface {
  std::unique_ptr<BulletShape> shape;  ///< in the base's principal frame; null: it meets nothing
  double friction = 0., restitution = 0.;  ///< [1]
};

class BulletRobot {
 public:
  /// Robot `robot` of `tree`, added to `world`, which outlives it.
  BulletRobot(const RobotTree& tree, int robot, btMultiBodyDynamicsWorld& world,
              BulletSurface surface = {});
  ~BulletRobot();
  BulletRobot(const BulletRobot&) = delete;
  BulletRobot& operator=(const BulletRobot&) = delete;

  /// Index of its base among all bodies; its links follow.
  std::size_t first_body() const { return first_body_; }
  std::size_t body_count() const { return bodies_.size(); }

  void apply_torques(const std::vector<double>& torques);
  /// A force at a point of the body (body axes) and a torque, world axes.
  void apply_force(std::size_t body, const simulation::ForceInput& force);
  /// Writes its bodies and joints among all; no contact forces.
  void read(std::span<simulation::BodyState> bodies,
            std::span<simulation::JointState> joints) const;
  /// What contacts refer to: `body` counts from the base.
  btMultiBodyLinkCollider& collider(std::size_t body) { return *colliders_[body]; }
  btMultiBody& multibody() { return *multibody_; }

 private:
  void add_links();
  void set_initial_state();
  void add_colliders(btMultiBodyDynamicsWorld& world);

  std::size_t first_body_;
  std::vector<TreeBody> bodies_;     ///< the base and its links
  std::vector<BulletFrame> frames_;  ///< of each: where Bullet has its frame
  std::unique_ptr<btMultiBody> multibody_;
  btMultiBodyDynamicsWorld& world_;
  BulletSurface surface_;  ///< of the base
  btSphereShape marker_;   ///< of all other colliders: never collided by Bullet
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
};

}  // namespace hookpoint::reference
