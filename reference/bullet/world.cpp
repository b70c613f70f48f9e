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

#include "reference/bullet/constraints.h"
#include "reference/bullet/points.h"
#include "reference/bullet/robot.h"
#include "reference/experiment_checks.h"
#include "reference/external_forces.h"
#include "reference/solids.h"

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

/// A body that meets others by its shapes.
struct Shaped {
  std::size_t index;  ///< as published
  const btCollisionObject* object;
  std::vector<int> materials;  ///< of its shapes
};

/// A step of stairs, or an obstacle.
struct Standing {
  std::unique_ptr<BulletShape> shape;
  std::unique_ptr<btRigidBody> body;
  int material = 0;
  std::optional<std::size_t> obstacle;
};

/// Makes a body stand at the motion's pose and have its velocities, which Bullet works out from where
/// the body was a step before.
void move(btRigidBody& body, const btTransform& X_WS, const Vector3d& velocity,
          const Vector3d& angular_velocity, double deltat) {
  const btQuaternion back = bullet(exponential(-deltat * angular_velocity)) * X_WS.getRotation();
  body.setWorldTransform(X_WS);
  body.setInterpolationWorldTransform(
      btTransform(back, X_WS.getOrigin() - bullet(deltat * velocity)));
}

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
        materials_(experiment),
        painted_(!experiment.obstacles.empty()),
        material_(ground_material(experiment)),
        dispatcher_(&configuration_) {
    const RobotTree tree = robot_tree(experiment);
    make_world(experiment);
    world_->setGravity(bullet(experiment.gravity));
    set_solver();
    if (experiment.terrain) add_ground(experiment);
    for (const Solid& solid : solids_of(experiment)) add_standing(solid);
    for (const TreeBody& body : tree.bodies) now_.push_back(body.initial);
    joints_now_.resize(tree.joints);
    for (std::size_t i = 0; i < experiment.robots.size(); ++i) add_robot(experiment, tree, i);
    if (!experiment.loops.empty() || !experiment.couplings.empty())
      constraints_.emplace(experiment, tree, robots_, *multibody_world_);
    forced_ = forced_bodies(experiment, tree);
    if (experiment.terrain) attach_points(experiment, tree);
  }

  ~BulletWorld() override {
    points_.reset();
    for (const Body& body : bodies_) world_->removeRigidBody(body.rigid.get());
    constraints_.reset();
    robots_.clear();
    for (const Standing& standing : standing_) world_->removeRigidBody(standing.body.get());
    if (ground_) world_->removeRigidBody(ground_.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  std::string advance(const simulation::WorldInputs& inputs) override {
    apply_forces(inputs);
    move_surfaces(inputs);
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

  void read_loops(std::span<simulation::LoopState> loops) const override {
    if (constraints_) constraints_->read(loops);
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
    make_rigid(*ground_);
    if (simulation::ground_moves(experiment)) make_kinematic(*ground_);
    world_->addRigidBody(ground_.get());
  }

  void add_standing(const Solid& solid) {
    Standing standing{make_bullet_shape(solid.geometry), {}, solid.material, solid.obstacle};
    btRigidBody::btRigidBodyConstructionInfo info(0., nullptr, standing.shape->shape.get());
    info.m_friction = 1.;
    info.m_restitution = 1.;
    info.m_startWorldTransform =
        btTransform(bullet(solid.pose.orientation), bullet(solid.pose.position));
    standing.body = std::make_unique<btRigidBody>(info);
    make_rigid(*standing.body);
    if (solid.obstacle) make_kinematic(*standing.body);
    world_->addRigidBody(standing.body.get());
    standing_.push_back(std::move(standing));
  }

  /// Dampers add up, and a body starts with 0.1 of its own; springs are in series, and it starts
  /// rigid.
  void make_rigid(btRigidBody& body) const {
    if (settings_.contact_stiffness)
      body.setContactStiffnessAndDamping(body.getContactStiffness(), 0.);
  }
  static void make_kinematic(btRigidBody& body) {
    body.setCollisionFlags((body.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
                           btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
  }

  void move_surfaces(const simulation::WorldInputs& inputs) {
    if (ground_ && ground_->isKinematicObject())
      move(*ground_, ground_->getWorldTransform(), inputs.ground.belt_velocity, {}, deltat_);
    for (const Standing& standing : standing_) {
      if (!standing.obstacle) continue;
      const simulation::SurfaceMotion& motion = inputs.obstacles[*standing.obstacle];
      move(*standing.body, btTransform(bullet(motion.orientation), bullet(motion.position)),
           motion.velocity, motion.angular_velocity, deltat_);
    }
  }

  void add_robot(const simulation::Experiment& experiment, const RobotTree& tree, std::size_t i) {
    const simulation::RobotSpec& robot = experiment.robots[i];
    if (!robot.chains.empty() || (robot.mobile && settings_.multibodies)) {
      add_multibody(experiment, tree, i);
    } else if (robot.mobile) {
      add_body(experiment, robot, tree.bases[i]);
    }
  }

  void add_multibody(const simulation::Experiment& experiment, const RobotTree& tree,
                     std::size_t number) {
    const auto robot = static_cast<int>(number);
    const std::size_t first = tree.bases[number];
    std::vector<BulletSurface> surfaces;
    for (std::size_t i = first; i < tree.bodies.size() && tree.bodies[i].robot == robot; ++i)
      surfaces.push_back(surface_of(experiment, tree.bodies[i]));
    robots_.push_back(
        std::make_unique<BulletRobot>(tree, robot, *multibody_world_, std::move(surfaces)));
    for (std::size_t i = 0; i < robots_.back()->body_count(); ++i)
      add_shaped(experiment, *tree.bodies[first + i].body, first + i, robots_.back()->collider(i));
  }

  void add_shaped(const simulation::Experiment& experiment, const simulation::BodySpec& spec,
                  std::size_t index, btCollisionObject& object) {
    const auto shapes = touching_shapes(experiment, spec);
    if (shapes.empty()) return;
    std::vector<int> materials;
    for (const simulation::ShapeSpec* shape : shapes) {
      materials.push_back(shape->material);
      painted_ |= shape->material != simulation::no_material;
    }
    if (settings_.friction_anchor)
      object.setCollisionFlags(object.getCollisionFlags() |
                               btCollisionObject::CF_HAS_FRICTION_ANCHOR);
    shaped_.push_back({index, &object, std::move(materials)});
  }

  BulletSurface surface_of(const simulation::Experiment& experiment, const TreeBody& body) const {
    const auto shapes = touching_shapes(experiment, *body.body);
    BulletSurface surface = surface_of_ground();
    if (body.mobile && !shapes.empty())
      surface.shape = make_bullet_shape(shapes, principal_frame(body.body->mass).X_BP);
    return surface;
  }
  BulletSurface surface_of_ground() const {
    BulletSurface surface;
    surface.friction = single_friction(material_);
    surface.restitution = settings_.restitution ? material_.restitution : 0.;
    surface.spring = settings_.contact_stiffness;
    surface.stiffness = material_.normal_stiffness;
    surface.damping = material_.normal_damping;
    return surface;
  }

  void add_body(const simulation::Experiment& experiment, const simulation::RobotSpec& robot,
                std::size_t index) {
    const BulletFrame frame = principal_frame(robot.base.mass);
    const auto shapes = touching_shapes(experiment, robot.base);
    Body body{index, frame.X_BP.inverse(), make_bullet_shape(shapes, frame.X_BP), {}};
    btRigidBody::btRigidBodyConstructionInfo info(robot.base.mass.mass, nullptr,
                                                  body.shape->shape.get(), frame.inertia);
    const btTransform X_WB(bullet(robot.orientation), bullet(robot.location));
    info.m_startWorldTransform = X_WB * frame.X_BP;
    body.rigid = std::make_unique<btRigidBody>(info);
    const Vector3d arm = rotate(robot.orientation, robot.base.mass.center_of_mass);
    body.rigid->setLinearVelocity(bullet(robot.velocity + cross(robot.angular_velocity, arm)));
    body.rigid->setAngularVelocity(bullet(robot.angular_velocity));
    body.rigid->setActivationState(DISABLE_DEACTIVATION);
    set_bullet_surface(*body.rigid, surface_of_ground());
    add_shaped(experiment, robot.base, index, *body.rigid);
    // Robots meet what stands, never each other; one without shapes meets not even that.
    world_->addRigidBody(body.rigid.get(), btBroadphaseProxy::DefaultFilter,
                         shapes.empty() ? 0 : btBroadphaseProxy::StaticFilter);
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

  /// Contacts of shapes get the constants of their two sides, and those of points are made.
  void after_collision() {
    const bool tiles = terrain_ && !terrain_->description().patches.empty();
    if (tiles || painted_) paint_contacts();
    if (!points_) return;
    read_motion(now_, joints_now_);
    points_->collide(now_);
  }

  void paint_contacts() {
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher_.getInternalManifoldPointer()[i];
      const Sides sides = sides_of(manifold);
      if (sides.body == nullptr || (points_ && points_->has(manifold))) continue;
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        btManifoldPoint& point = manifold.getContactPoint(k);
        const int shape = sides.body_is_first ? point.m_index0 : point.m_index1;
        const std::size_t part =
            sides.body->materials.size() > 1 && shape >= 0 ? static_cast<std::size_t>(shape) : 0;
        set_bullet_material(
            point, materials_.of(sides.body->materials[part], material_of(sides.other, point)),
            settings_);
      }
    }
  }

  /// Of what a robot meets: an obstacle's, or that of the tile under the contact.
  int material_of(const btCollisionObject* other, const btManifoldPoint& point) const {
    const auto at = std::ranges::find_if(
        standing_, [&](const Standing& standing) { return standing.body.get() == other; });
    if (at != standing_.end() && at->obstacle) return at->material;
    return terrain_->query(vector(point.getPositionWorldOnB())).material;
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

  /// The robot's body of a manifold, null where there is none, and what it meets.
  struct Sides {
    const Shaped* body = nullptr;
    const btCollisionObject* other = nullptr;
    bool body_is_first = true;
  };
  Sides sides_of(const btPersistentManifold& manifold) const {
    for (const Shaped& body : shaped_) {
      if (body.object == manifold.getBody0()) return {&body, manifold.getBody1(), true};
      if (body.object == manifold.getBody1()) return {&body, manifold.getBody0(), false};
    }
    return {};
  }

  template <class Visit>
  void visit_manifold(const btPersistentManifold& manifold, Visit visit) const {
    const Sides sides = sides_of(manifold);
    if (sides.body == nullptr || (points_ && points_->has(manifold))) return;
    // Impulses of a manifold act on its first body.
    const double scale = (sides.body_is_first ? 1. : -1.) / deltat_;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      const Vector3d impulse = vector(bullet_impulse(point));
      if (dot(impulse, impulse) == 0.) continue;
      visit(sides.body->index, point,
            sides.body_is_first ? point.getPositionWorldOnA() : point.getPositionWorldOnB(),
            scale * impulse);
    }
  }

  BulletSettings settings_;
  double deltat_;
  PairMaterials materials_;
  bool painted_ = false;  ///< contacts of shapes have other constants than the ground's
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
  std::vector<Standing> standing_;
  std::vector<Body> bodies_;
  std::vector<std::unique_ptr<BulletRobot>> robots_;  ///< multibodies
  std::optional<BulletConstraints> constraints_;
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
