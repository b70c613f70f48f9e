#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include "tests/support/native_contacts/native_contact.h"

namespace hookpoint::native {
namespace {

struct Surface {
  double stiffness, damping, friction;
  bool anchor;
};

void set(btCollisionObject& ground, const Surface& surface) {
  ground.setFriction(surface.friction);
  ground.setRestitution(0);
  ground.setContactStiffnessAndDamping(surface.stiffness, surface.damping);
  if (surface.anchor)
    ground.setCollisionFlags(ground.getCollisionFlags() |
                             btCollisionObject::CF_HAS_FRICTION_ANCHOR);
}

std::array<double, 3> plain(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btVector3 bullet(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// What both worlds have.
struct Parts {
  explicit Parts(const Ball& ball) : sphere(ball.radius) {}
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSphereShape sphere;
  btStaticPlaneShape plane{btVector3(0, 0, 1), 0};
};

class BulletContact final : public Contact {
 public:
  BulletContact(const Ball& ball, const Surface& surface)
      : ball_(ball),
        parts_(ball),
        world_(&parts_.dispatcher, &parts_.broadphase, &solver_, &parts_.configuration),
        ground_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &parts_.plane)),
        body_(btRigidBody::btRigidBodyConstructionInfo(
            ball.mass, nullptr, &parts_.sphere,
            btVector3(great_inertia, great_inertia, great_inertia))) {
    set(ground_, surface);
    world_.getSolverInfo().m_splitImpulse = 0;
    world_.getSolverInfo().m_numIterations = 50;
    world_.addRigidBody(&ground_);
    body_.setFriction(1);
    body_.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&body_);
  }
  ~BulletContact() override {
    world_.removeRigidBody(&body_);
    world_.removeRigidBody(&ground_);
  }

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    world_.setGravity(bullet(gravity));
    body_.setGravity(bullet(gravity));
    btTransform pose(btQuaternion::getIdentity(), btVector3(0, 0, ball_.radius - depth));
    body_.setWorldTransform(pose);
    body_.setInterpolationWorldTransform(pose);
    body_.setLinearVelocity(btVector3(0, 0, -approach));
    body_.setAngularVelocity(btVector3(0, 0, 0));
    body_.clearForces();
    // Contacts of the run before end.
    parts_.broadphase.getOverlappingPairCache()->cleanProxyFromPairs(body_.getBroadphaseHandle(),
                                                                     &parts_.dispatcher);
  }
  void step() override { world_.stepSimulation(ball_.deltat, 0); }
  std::array<double, 3> position() const override {
    return plain(body_.getWorldTransform().getOrigin());
  }
  std::array<double, 3> velocity() const override { return plain(body_.getLinearVelocity()); }

 private:
  Ball ball_;
  Parts parts_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btRigidBody ground_, body_;
};

class MultiBodyContact final : public Contact {
 public:
  MultiBodyContact(const Ball& ball, const Surface& surface)
      : ball_(ball),
        parts_(ball),
        world_(&parts_.dispatcher, &parts_.broadphase, &solver_, &parts_.configuration),
        ground_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &parts_.plane)),
        body_(0, ball.mass, btVector3(great_inertia, great_inertia, great_inertia), false, false),
        collider_(&body_, -1) {
    set(ground_, surface);
    // createEmptyDynamicsWorld of examples/SharedMemory/PhysicsServerCommandProcessor.cpp.
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_linearSlop = 1e-5;
    info.m_erp2 = 0.08;
    info.m_frictionERP = 0.2;
    info.m_numIterations = 50;
    info.m_leastSquaresResidualThreshold = 1e-7;
    info.m_warmstartingFactor = 0.1;
    world_.addRigidBody(&ground_);
    body_.setCanSleep(false);
    body_.setLinearDamping(0);
    body_.setAngularDamping(0);
    body_.finalizeMultiDof();
    world_.addMultiBody(&body_);
    collider_.setCollisionShape(&parts_.sphere);
    collider_.setFriction(1);
    body_.setBaseCollider(&collider_);
    world_.addCollisionObject(&collider_, btBroadphaseProxy::DefaultFilter,
                              btBroadphaseProxy::AllFilter);
  }
  ~MultiBodyContact() override {
    world_.removeCollisionObject(&collider_);
    world_.removeMultiBody(&body_);
    world_.removeRigidBody(&ground_);
  }

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    world_.setGravity(bullet(gravity));
    const btTransform pose(btQuaternion::getIdentity(), btVector3(0, 0, ball_.radius - depth));
    body_.setBaseWorldTransform(pose);
    collider_.setWorldTransform(pose);
    body_.setBaseVel(btVector3(0, 0, -approach));
    body_.setBaseOmega(btVector3(0, 0, 0));
    parts_.broadphase.getOverlappingPairCache()->cleanProxyFromPairs(
        collider_.getBroadphaseHandle(), &parts_.dispatcher);
  }
  void step() override { world_.stepSimulation(ball_.deltat, 0); }
  std::array<double, 3> position() const override { return plain(body_.getBasePos()); }
  std::array<double, 3> velocity() const override { return plain(body_.getBaseVel()); }

 private:
  Ball ball_;
  Parts parts_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  btRigidBody ground_;
  btMultiBody body_;
  btMultiBodyLinkCollider collider_;
};

}  // namespace

std::unique_ptr<Contact> bullet_contact(const Ball& ball, double stiffness, double damping,
                                        double friction, bool anchor) {
  return std::make_unique<BulletContact>(ball, Surface{stiffness, damping, friction, anchor});
}

std::unique_ptr<Contact> pybullet_contact(const Ball& ball, double stiffness, double damping,
                                          double friction, bool anchor) {
  return std::make_unique<MultiBodyContact>(ball, Surface{stiffness, damping, friction, anchor});
}

}  // namespace hookpoint::native
