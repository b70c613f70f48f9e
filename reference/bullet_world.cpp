#include "reference/bullet_world.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "reference/bullet_shapes.h"
#include "reference/experiment_checks.h"

static_assert(std::is_same_v<btScalar, double>,
              "the tables say that Bullet runs in double precision");

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

struct Body {
  std::size_t index;  ///< of the robot
  btTransform X_PB;   ///< pose of the body's frame in Bullet's
  std::unique_ptr<BulletShape> shape;
  std::unique_ptr<btRigidBody> rigid;
};

class BulletWorld final : public PeerWorld {
 public:
  BulletWorld(const simulation::Experiment& experiment, const BulletSettings& settings)
      : settings_(settings),
        deltat_(experiment.deltat),
        forces_(experiment.forces),
        material_(ground_material(experiment)),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(bullet(experiment.gravity));
    set_solver();
    if (experiment.terrain) add_ground(ground_of(*experiment.terrain));
    for (std::size_t i = 0; i < experiment.robots.size(); ++i)
      if (experiment.robots[i].mobile) add_body(experiment.robots[i], i);
  }

  ~BulletWorld() override {
    for (const Body& body : bodies_) world_.removeRigidBody(body.rigid.get());
    if (ground_) world_.removeRigidBody(ground_.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  std::string advance(const simulation::WorldInputs& inputs) override {
    apply_forces(inputs.forces);
    // No substeps: one step of exactly deltat, as every other engine takes.
    world_.stepSimulation(deltat_, 0);
    return {};
  }

  void read(std::span<BodyState> bodies, std::span<JointState> /*joints*/) const override {
    for (const Body& body : bodies_) {
      BodyState& state = bodies[body.index];
      const btTransform& X_WP = body.rigid->getWorldTransform();
      const btTransform X_WB = X_WP * body.X_PB;
      state.position = vector(X_WB.getOrigin());
      state.orientation = quaternion(X_WB.getRotation());
      state.angular_velocity = vector(body.rigid->getAngularVelocity());
      state.velocity =
          vector(body.rigid->getVelocityInLocalPoint(X_WB.getOrigin() - X_WP.getOrigin()));
      state.contact_force = {};
      state.contacts = 0;
    }
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      read_contacts(*dispatcher_.getInternalManifoldPointer()[i], bodies);
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
  }

 private:
  void set_solver() {
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_numIterations = settings_.iterations;
    info.m_leastSquaresResidualThreshold = settings_.residual_threshold;
    info.m_linearSlop = settings_.constraint.surface_layer;
    info.m_warmstartingFactor = settings_.warmstarting;
    info.m_erp2 = settings_.constraint.normal_error_reduction;
    // Split impulses push bodies apart without velocity, and so without the spring's force.
    if (settings_.contact_stiffness) info.m_splitImpulse = 0;
    info.m_frictionERP = settings_.constraint.tangential_error_reduction;
  }

  /// Bullet multiplies the two bodies' friction and restitution, so the ground has 1 and the body
  /// the material's.
  void add_ground(const Ground& ground) {
    ground_shape_ = make_bullet_ground(ground);
    btRigidBody::btRigidBodyConstructionInfo info(0., nullptr, ground_shape_->shape.get());
    info.m_friction = 1.;
    info.m_restitution = 1.;
    info.m_startWorldTransform = ground_shape_->X_WG;
    ground_ = std::make_unique<btRigidBody>(info);
    // Dampers add up, and a body starts with 0.1 of its own; springs are in series, and it starts
    // rigid.
    if (settings_.contact_stiffness)
      ground_->setContactStiffnessAndDamping(ground_->getContactStiffness(), 0.);
    world_.addRigidBody(ground_.get());
  }

  void add_body(const simulation::RobotSpec& robot, std::size_t index) {
    const BulletFrame frame = principal_frame(robot.base.mass);
    Body body{index, frame.X_BP.inverse(), make_bullet_shape(robot.base.shapes, frame.X_BP), {}};
    btRigidBody::btRigidBodyConstructionInfo info(robot.base.mass.mass, nullptr,
                                                  body.shape->shape.get(), frame.inertia);
    const btTransform X_WB(bullet(robot.orientation), bullet(robot.location));
    info.m_startWorldTransform = X_WB * frame.X_BP;
    info.m_friction = single_friction(material_);
    info.m_restitution = settings_.restitution ? material_.restitution : 0.;
    body.rigid = std::make_unique<btRigidBody>(info);
    const Vector3d arm = rotate(robot.orientation, robot.base.mass.center_of_mass);
    body.rigid->setLinearVelocity(bullet(robot.velocity + cross(robot.angular_velocity, arm)));
    body.rigid->setAngularVelocity(bullet(robot.angular_velocity));
    body.rigid->setActivationState(DISABLE_DEACTIVATION);
    if (settings_.contact_stiffness)
      body.rigid->setContactStiffnessAndDamping(material_.normal_stiffness,
                                                material_.normal_damping);
    if (settings_.friction_anchor)
      body.rigid->setCollisionFlags(body.rigid->getCollisionFlags() |
                                    btCollisionObject::CF_HAS_FRICTION_ANCHOR);
    // Robots meet the ground only, as in every engine here.
    world_.addRigidBody(body.rigid.get(), btBroadphaseProxy::DefaultFilter,
                        btBroadphaseProxy::StaticFilter);
    bodies_.push_back(std::move(body));
  }

  void apply_forces(const std::vector<simulation::ForceInput>& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      for (const Body& body : bodies_) {
        if (body.index != static_cast<std::size_t>(forces_[i].robot)) continue;
        const simulation::ForceInput& force = forces[i];
        const btTransform& X_WP = body.rigid->getWorldTransform();
        const btVector3 point = X_WP * (body.X_PB * bullet(force.point));
        body.rigid->applyForce(bullet(force.force), point - X_WP.getOrigin());
        body.rigid->applyTorque(bullet(force.torque));
      }
  }

  void read_contacts(const btPersistentManifold& manifold, std::span<BodyState> bodies) const {
    const bool body_is_first = manifold.getBody1() == ground_.get();
    const btCollisionObject* object = body_is_first ? manifold.getBody0() : manifold.getBody1();
    // Impulses of a manifold act on its first body.
    const double scale = (body_is_first ? 1. : -1.) / deltat_;
    for (const Body& body : bodies_) {
      if (body.rigid.get() != object) continue;
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        if (!(point.m_appliedImpulse > 0.)) continue;
        const btVector3 impulse = point.m_appliedImpulse * point.m_normalWorldOnB +
                                  point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                  point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
        bodies[body.index].contact_force += scale * vector(impulse);
        ++bodies[body.index].contacts;
      }
    }
  }

  BulletSettings settings_;
  double deltat_;
  std::vector<simulation::ForceSpec> forces_;
  contact::MaterialConstants<double> material_;
  btDefaultCollisionConfiguration configuration_;
  // getNumManifolds and getInternalManifoldPointer are not const in Bullet.
  mutable btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::unique_ptr<BulletShape> ground_shape_;
  std::unique_ptr<btRigidBody> ground_;
  std::vector<Body> bodies_;
};

}  // namespace

std::unique_ptr<PeerWorld> make_bullet_world(const simulation::Experiment& experiment,
                                             const BulletSettings& settings) {
  return std::make_unique<BulletWorld>(experiment, settings);
}

}  // namespace hookpoint::reference
