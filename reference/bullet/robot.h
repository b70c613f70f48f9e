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

/// What a body meets others with.
struct BulletSurface {
  std::unique_ptr<BulletShape> shape;  ///< in the body's principal frame; null: it meets nothing
  double friction = 0., restitution = 0.;  ///< [1]
  bool spring = false;                     ///< the next two are set
  double stiffness = 0., damping = 0.;     ///< [N/m], [N s/m]
};
/// What the surface says beside its shape.
void set_bullet_surface(btCollisionObject& object, const BulletSurface& surface);

class BulletRobot {
 public:
  /// Robot `robot` of `tree`, added to `world`, which outlives it. `surfaces`: one a body of it.
  BulletRobot(const RobotTree& tree, int robot, btMultiBodyDynamicsWorld& world,
              std::vector<BulletSurface> surfaces);
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
  /// A place of body `body`, which counts from the base, seen from where Bullet has its frame.
  btVector3 in_bullet_frame(std::size_t body, const Vector3d& place) const {
    return frames_[body].X_BP.inverse() * bullet(place);
  }

 private:
  void add_links();
  void set_initial_state();
  void add_colliders(btMultiBodyDynamicsWorld& world);

  std::size_t first_body_;
  std::vector<TreeBody> bodies_;     ///< the base and its links
  std::vector<BulletFrame> frames_;  ///< of each: where Bullet has its frame
  std::unique_ptr<btMultiBody> multibody_;
  btMultiBodyDynamicsWorld& world_;
  std::vector<BulletSurface> surfaces_;  ///< of each body
  btSphereShape marker_;  ///< of colliders without a surface: never collided by Bullet
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
};

}  // namespace hookpoint::reference
