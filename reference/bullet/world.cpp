#include "reference/bullet/world.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <LinearMath/btAlignedAllocator.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "reference/bullet/points.h"
#include "reference/bullet/robot.h"
#include "reference/experiment_checks.h"
#include "reference/external_forces.h"

static_assert(std::is_same_v<btScalar, double>,
              "the tables say that Bullet runs in double precision");

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

/// Bullet does not check what its allocations return.
void* allocate_for_bullet(std::size_t bytes) {
  if (void* const memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}

/// Before any other use of the library, once a process. Its own way of freeing is std::free.
void prepare_bullet() {
  static const bool prepared = [] {
    btAlignedAllocSetCustom(allocate_for_bullet, std::free);
    return true;
  }();
  static_cast<void>(prepared);
}

/// A single rigid body, with its shapes or, where it touches by points, with none.
struct Body {
  std::size_t index;  ///< as published
  btTransform X_PB;   ///< pose of the body's frame in Bullet's
  std::unique_ptr<BulletShape> shape;
  std::unique_ptr<btRigidBody> rigid;
};

/// A body that meets the ground by its shapes.
struct Shaped {
  std::size_t index;  ///< as published
  const btCollisionObject* object;
};

BodyState state_of(const Body& body) {
  BodyState state;
  const btTransform& X_WP = body.rigid->getWorldTransform();
  const btTransform X_WB = X_WP * body.X_PB;
  state.position = vector(X_WB.getOrigin());
  state.orientation = quaternion(X_WB.getRotation());
  state.angular_velocity = vector(body.rigid->getAngularVelocity());
  state.velocity = vector(body.rigid->getVelocityInLocalPoint(X_WB.getOrigin() - X_WP.getOrigin()));
  return state;
}

/// A world of the library that calls `collided` when it has made its contacts.
template <class Library>
class TouchingWorld final : public Library {
 public:
  using Library::Library;
  void performDiscreteCollisionDetection() override {
    Library::performDiscreteCollisionDetection();
    collided();
  }
  std::function<void()> collided;
};

class BulletWorld final : public PeerWorld {
 public:
  BulletWorld(const simulation::Experiment& experiment, const BulletSettings& settings)
      : settings_(settings),
        deltat_(experiment.deltat),
        materials_(experiment.materials),
        material_(ground_material(experiment)),
        dispatcher_(&configuration_) {
    const RobotTree tree = robot_tree(experiment);
    make_world(experiment);
    world_->setGravity(bullet(experiment.gravity));
    set_solver();
    if (experiment.terrain) add_ground(experiment);
    for (const TreeBody& body : tree.bodies) now_.push_back(body.initial);
    joints_now_.resize(tree.joints);
    for (std::size_t i = 0; i < experiment.robots.size(); ++i) add_robot(experiment, tree, i);
    forced_ = forced_bodies(experiment, tree);
    if (experiment.terrain) attach_points(experiment, tree);
  }

  ~BulletWorld() override {
    points_.reset();
    for (const Body& body : bodies_) world_->removeRigidBody(body.rigid.get());
    robots_.clear();
    if (ground_) world_->removeRigidBody(ground_.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  std::string advance(const simulation::WorldInputs& inputs) override {
    apply_forces(inputs);
    for (const auto& robot : robots_) robot->apply_torques(inputs.joint_torques);
    // No substeps: one step of exactly deltat, as every other engine takes.
    world_->stepSimulation(deltat_, 0);
    return {};
  }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    read_motion(bodies, joints);
    for_each_shape_force([&](std::size_t body, const btManifoldPoint& contact, const btVector3&,
                             const Vector3d& force) {
      bodies[body].contact_force += force;
      if (contact.m_appliedImpulse > 0.) ++bodies[body].contacts;
    });
    if (points_) points_->read(deltat_, bodies);
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
    if (points_) points_->read_forces(deltat_, forces);
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    for_each_shape_force([&](std::size_t body, const btManifoldPoint&, const btVector3& position,
                             const Vector3d& force) {
      forces.push_back({body, vector(position), force});
    });
  }

 private:
  /// A world of single bodies is the library's first example; robots with chains need its world of
  /// multibodies, which differs (docs/reference_engines.md) and is what its maintainers' server
  /// has.
  void make_world(const simulation::Experiment& experiment) {
    const auto collided = [this] { after_collision(); };
    const bool chains = std::ranges::any_of(
        experiment.robots, [](const auto& robot) { return !robot.chains.empty(); });
    if (!settings_.multibodies && !chains) {
      solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
      auto world = std::make_unique<TouchingWorld<btDiscreteDynamicsWorld>>(
          &dispatcher_, &broadphase_, solver_.get(), &configuration_);
      world->collided = collided;
      world_ = std::move(world);
      return;
    }
    auto solver = std::make_unique<btMultiBodyConstraintSolver>();
    auto world = std::make_unique<TouchingWorld<btMultiBodyDynamicsWorld>>(
        &dispatcher_, &broadphase_, solver.get(), &configuration_);
    world->collided = collided;
    multibody_world_ = world.get();
    solver_ = std::move(solver);
    world_ = std::move(world);
  }

  void set_solver() {
    btContactSolverInfo& info = world_->getSolverInfo();
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
  void add_ground(const simulation::Experiment& experiment) {
    terrain_.emplace(*experiment.terrain);
    ground_shape_ = make_bullet_ground(ground_of(*experiment.terrain));
    btRigidBody::btRigidBodyConstructionInfo info(0., nullptr, ground_shape_->shape.get());
    info.m_friction = 1.;
    info.m_restitution = 1.;
    info.m_startWorldTransform = ground_shape_->X_WG;
    ground_ = std::make_unique<btRigidBody>(info);
    // Dampers add up, and a body starts with 0.1 of its own; springs are in series, and it starts
    // rigid.
    if (settings_.contact_stiffness)
      ground_->setContactStiffnessAndDamping(ground_->getContactStiffness(), 0.);
    world_->addRigidBody(ground_.get());
  }

  void add_robot(const simulation::Experiment& experiment, const RobotTree& tree, std::size_t i) {
    const simulation::RobotSpec& robot = experiment.robots[i];
    const auto number = static_cast<int>(i);
    const bool by_points = touches_by_points(experiment, number);
    if (!robot.chains.empty() || (robot.mobile && settings_.multibodies)) {
      robots_.push_back(std::make_unique<BulletRobot>(
          tree, number, *multibody_world_, by_points ? BulletSurface{} : surface_of(robot)));
      if (!by_points) shaped_.push_back({tree.bases[i], &robots_.back()->collider(0)});
    } else if (robot.mobile) {
      add_body(robot, tree.bases[i], by_points);
      if (!by_points) shaped_.push_back({tree.bases[i], bodies_.back().rigid.get()});
    }
  }

  BulletSurface surface_of(const simulation::RobotSpec& robot) const {
    return {make_bullet_shape(robot.base.shapes, principal_frame(robot.base.mass).X_BP),
            single_friction(material_), settings_.restitution ? material_.restitution : 0.};
  }

  void add_body(const simulation::RobotSpec& robot, std::size_t index, bool by_points) {
    const BulletFrame frame = principal_frame(robot.base.mass);
    const std::vector<simulation::ShapeSpec> none;
    Body body{index,
              frame.X_BP.inverse(),
              make_bullet_shape(by_points ? none : robot.base.shapes, frame.X_BP),
              {}};
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
    // Robots meet the ground only, as in every engine here; one that touches by points meets not
    // even that by its shape.
    world_->addRigidBody(body.rigid.get(), btBroadphaseProxy::DefaultFilter,
                         by_points ? 0 : btBroadphaseProxy::StaticFilter);
    bodies_.push_back(std::move(body));
  }

  void attach_points(const simulation::Experiment& experiment, const RobotTree& tree) {
    std::vector<const btCollisionObject*> objects(tree.bodies.size(), nullptr);
    for (const Body& body : bodies_) objects[body.index] = body.rigid.get();
    for (const auto& robot : robots_)
      for (std::size_t i = 0; i < robot->body_count(); ++i)
        objects[robot->first_body() + i] = &robot->collider(i);
    points_.emplace(experiment, tree, settings_, dispatcher_, *ground_);
    points_->attach(objects);
  }

  /// Contacts of shapes get the material of their tile, and those of points are made.
  void after_collision() {
    if (!points_) return;
    if (!terrain_->description().patches.empty()) paint_contacts();
    read_motion(now_, joints_now_);
    points_->collide(now_);
  }

  void paint_contacts() {
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher_.getInternalManifoldPointer()[i];
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        btManifoldPoint& point = manifold.getContactPoint(k);
        const int tile = terrain_->query(vector(point.getPositionWorldOnB())).material;
        set_bullet_material(point, materials_[static_cast<std::size_t>(tile)].constants, settings_);
      }
    }
  }

  void apply_forces(const simulation::WorldInputs& inputs) {
    for_each_force(forced_, inputs, [&](std::size_t index, const simulation::ForceInput& force) {
      for (const auto& robot : robots_) {
        const std::size_t body = index - robot->first_body();  // wraps for those before it
        if (body < robot->body_count()) robot->apply_force(body, force);
      }
      for (const Body& body : bodies_) {
        if (body.index != index) continue;
        const btTransform& X_WP = body.rigid->getWorldTransform();
        const btVector3 point = X_WP * (body.X_PB * bullet(force.point));
        body.rigid->applyForce(bullet(force.force), point - X_WP.getOrigin());
        body.rigid->applyTorque(bullet(force.torque));
      }
    });
  }

  void read_motion(std::span<BodyState> bodies, std::span<JointState> joints) const {
    for (const Body& body : bodies_) bodies[body.index] = state_of(body);
    for (const auto& robot : robots_) robot->read(bodies, joints);
  }

  /// Calls `visit(body, contact, position, force)` for each contact of a shape that has a force.
  /// One that does not push may have one along the ground: that with which the solver started from
  /// the last step's, and which it leaves alone where the normal row ends at 0.
  template <class Visit>
  void for_each_shape_force(Visit visit) const {
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      visit_manifold(*dispatcher_.getInternalManifoldPointer()[i], visit);
  }

  template <class Visit>
  void visit_manifold(const btPersistentManifold& manifold, Visit visit) const {
    const bool body_is_first = manifold.getBody1() == ground_.get();
    const btCollisionObject* object = body_is_first ? manifold.getBody0() : manifold.getBody1();
    // Impulses of a manifold act on its first body.
    const double scale = (body_is_first ? 1. : -1.) / deltat_;
    for (const Shaped& body : shaped_) {
      if (body.object != object) continue;
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        const Vector3d impulse = vector(bullet_impulse(point));
        if (dot(impulse, impulse) == 0.) continue;
        visit(body.index, point,
              body_is_first ? point.getPositionWorldOnA() : point.getPositionWorldOnB(),
              scale * impulse);
      }
    }
  }

  BulletSettings settings_;
  double deltat_;
  std::vector<simulation::MaterialSpec> materials_;
  contact::MaterialConstants<double> material_;  ///< where no patch lies
  btDefaultCollisionConfiguration configuration_;
  // getNumManifolds and getInternalManifoldPointer are not const in Bullet.
  mutable btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  btMultiBodyDynamicsWorld* multibody_world_ = nullptr;  ///< the same, where there are multibodies
  std::optional<contact::Terrain> terrain_;
  std::unique_ptr<BulletShape> ground_shape_;
  std::unique_ptr<btRigidBody> ground_;
  std::vector<Body> bodies_;
  std::vector<std::unique_ptr<BulletRobot>> robots_;  ///< multibodies
  std::vector<Shaped> shaped_;
  std::optional<BulletPoints> points_;
  std::vector<std::size_t> forced_;  ///< body of each force
  std::vector<BodyState> now_;       ///< while contacts are made
  std::vector<JointState> joints_now_;
};

}  // namespace

std::unique_ptr<PeerWorld> make_bullet_world(const simulation::Experiment& experiment,
                                             Settings settings) {
  prepare_bullet();
  return std::make_unique<BulletWorld>(
      experiment, bullet_settings(settings, experiment.deltat, ground_material(experiment)));
}

}  // namespace hookpoint::reference
