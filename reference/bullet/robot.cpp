#include "reference/bullet/robot.h"

#include <limits>

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

/// A link's frame seen from its parent's, both as Bullet has them, at joint position 0.
struct BulletJoint {
  btQuaternion parent_to_link;    ///< turns components from parent's to link's axes
  btVector3 parent_com_to_pivot;  ///< parent's axes [m]
  btVector3 pivot_to_com;         ///< link's axes [m]
  btVector3 axis;                 ///< link's axes
};
BulletJoint bullet_joint(const TreeBody& link, const BulletFrame& parent, const BulletFrame& own) {
  const btTransform X_PL(bullet(link.X_PL0.orientation), bullet(link.X_PL0.position));
  const btTransform pivot = parent.X_BP.inverse() * X_PL;
  const btMatrix3x3 turn = pivot.getBasis() * own.X_BP.getBasis();
  const btMatrix3x3 to_own = own.X_BP.getBasis().transpose();
  BulletJoint joint;
  turn.transpose().getRotation(joint.parent_to_link);
  joint.parent_com_to_pivot = pivot.getOrigin();
  joint.pivot_to_com = to_own * own.X_BP.getOrigin();
  joint.axis = to_own * btVector3(0., 0., 1.);
  return joint;
}

}  // namespace

void set_bullet_surface(btCollisionObject& object, const BulletSurface& surface) {
  object.setFriction(surface.friction);
  object.setRestitution(surface.restitution);
  if (surface.spring) object.setContactStiffnessAndDamping(surface.stiffness, surface.damping);
}

BulletRobot::BulletRobot(const RobotTree& tree, int robot, btMultiBodyDynamicsWorld& world,
                         std::vector<BulletSurface> surfaces)
    : first_body_(tree.bases[static_cast<std::size_t>(robot)]),
      world_(world),
      surfaces_(std::move(surfaces)),
      marker_(1e-6) {
  for (std::size_t i = first_body_; i < tree.bodies.size() && tree.bodies[i].robot == robot; ++i) {
    bodies_.push_back(tree.bodies[i]);
    frames_.push_back(principal_frame(tree.bodies[i].body->mass));
  }
  const auto links = static_cast<int>(bodies_.size()) - 1;
  multibody_ = std::make_unique<btMultiBody>(links, bodies_[0].body->mass.mass, frames_[0].inertia,
                                             !bodies_[0].mobile, /*canSleep=*/false);
  add_links();
  // Bullet starts with dampers of 0.04 on the base's motion, and cuts joint rates off at 100 rad/s.
  multibody_->setLinearDamping(0.);
  multibody_->setAngularDamping(0.);
  multibody_->setMaxCoordinateVelocity(std::numeric_limits<double>::max());
  multibody_->setHasSelfCollision(false);
  set_initial_state();
  add_colliders(world);
}

BulletRobot::~BulletRobot() {
  for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
  world_.removeMultiBody(multibody_.get());
}

void BulletRobot::add_links() {
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const TreeBody& body = bodies_[i];
    const auto parent = static_cast<std::size_t>(body.parent) - first_body_;
    const BulletJoint joint = bullet_joint(body, frames_[parent], frames_[i]);
    const auto link = static_cast<int>(i) - 1, before = static_cast<int>(parent) - 1;
    const double mass = body.body->mass.mass;
    if (body.turns()) {
      multibody_->setupRevolute(link, mass, frames_[i].inertia, before, joint.parent_to_link,
                                joint.axis, joint.parent_com_to_pivot, joint.pivot_to_com, true);
    } else {
      multibody_->setupPrismatic(link, mass, frames_[i].inertia, before, joint.parent_to_link,
                                 joint.axis, joint.parent_com_to_pivot, joint.pivot_to_com, true);
    }
  }
  multibody_->finalizeMultiDof();
}

void BulletRobot::set_initial_state() {
  const BodyState& base = bodies_[0].initial;
  const btTransform X_WP =
      btTransform(bullet(base.orientation), bullet(base.position)) * frames_[0].X_BP;
  multibody_->setBasePos(X_WP.getOrigin());
  multibody_->setWorldToBaseRot(X_WP.getRotation().inverse());
  const btVector3 omega = bullet(base.angular_velocity);
  const btVector3 arm = X_WP.getOrigin() - bullet(base.position);
  multibody_->setBaseOmega(omega);
  multibody_->setBaseVel(bullet(base.velocity) + omega.cross(arm));
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    multibody_->setJointPos(static_cast<int>(i) - 1, bodies_[i].link->angle);
    multibody_->setJointVel(static_cast<int>(i) - 1, bodies_[i].link->rate);
  }
}

/// Without a surface in no group: the broad phase pairs them with nothing, neither the ground nor
/// each other. They are there for the contacts that points.h adds.
void BulletRobot::add_colliders(btMultiBodyDynamicsWorld& world) {
  world.addMultiBody(multibody_.get());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto link = static_cast<int>(i) - 1;
    auto collider = std::make_unique<btMultiBodyLinkCollider>(multibody_.get(), link);
    if (surfaces_[i].shape) {
      collider->setCollisionShape(surfaces_[i].shape->shape.get());
      set_bullet_surface(*collider, surfaces_[i]);
      world.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter,
                               btBroadphaseProxy::StaticFilter);
    } else {
      collider->setCollisionShape(&marker_);
      world.addCollisionObject(collider.get(), 0, 0);
    }
    if (i == 0) {
      multibody_->setBaseCollider(collider.get());
    } else {
      multibody_->getLink(link).m_collider = collider.get();
    }
    colliders_.push_back(std::move(collider));
  }
  btAlignedObjectArray<btQuaternion> world_to_local;
  btAlignedObjectArray<btVector3> local_origin;
  multibody_->forwardKinematics(world_to_local, local_origin);
  multibody_->updateCollisionObjectWorldTransforms(world_to_local, local_origin);
}

void BulletRobot::apply_torques(const std::vector<double>& torques) {
  for (std::size_t i = 1; i < bodies_.size(); ++i)
    multibody_->addJointTorque(static_cast<int>(i) - 1,
                               torques[static_cast<std::size_t>(bodies_[i].joint)]);
}

void BulletRobot::apply_force(std::size_t body, const simulation::ForceInput& force) {
  const btTransform& X_WP = colliders_[body]->getWorldTransform();
  const btVector3 arm = X_WP.getBasis() * (frames_[body].X_BP.inverse() * bullet(force.point));
  const btVector3 push = bullet(force.force);
  const btVector3 torque = bullet(force.torque) + arm.cross(push);
  if (body == 0) {
    multibody_->addBaseForce(push);
    multibody_->addBaseTorque(torque);
    return;
  }
  multibody_->addLinkForce(static_cast<int>(body) - 1, push);
  multibody_->addLinkTorque(static_cast<int>(body) - 1, torque);
}

void BulletRobot::read(std::span<BodyState> bodies, std::span<JointState> joints) const {
  if (bodies_[0].mobile) {
    const btTransform X_WP(multibody_->getWorldToBaseRot().inverse(), multibody_->getBasePos());
    const btTransform X_WB = X_WP * frames_[0].X_BP.inverse();
    const btVector3 omega = multibody_->getBaseOmega();
    BodyState& base = bodies[first_body_];
    base = {};
    base.position = vector(X_WB.getOrigin());
    base.orientation = quaternion(X_WB.getRotation());
    base.angular_velocity = vector(omega);
    base.velocity =
        vector(multibody_->getBaseVel() + omega.cross(X_WB.getOrigin() - X_WP.getOrigin()));
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    JointState& joint = joints[static_cast<std::size_t>(bodies_[i].joint)];
    joint.angle = multibody_->getJointPos(static_cast<int>(i) - 1);
    joint.rate = multibody_->getJointVel(static_cast<int>(i) - 1);
    const BodyState& parent = bodies[static_cast<std::size_t>(bodies_[i].parent)];
    bodies[first_body_ + i] = link_state(parent, bodies_[i], joint.angle, joint.rate);
  }
}

}  // namespace hookpoint::reference
