#include "reference/ode/world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/contact_limit.h"
#include "reference/experiment_checks.h"
#include "reference/external_forces.h"
#include "reference/ode/joints.h"
#include "reference/ode/loops.h"
#include "reference/ode/shapes.h"
#include "reference/pair_materials.h"
#include "reference/solids.h"
#include "reference/touching_points.h"
#include "simulation/experiment/names.h"

static_assert(std::is_same_v<dReal, double>, "the tables say that ODE runs in double precision");

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

constexpr int max_contacts =
    64;  // a geometry's; a box on a plane has 4, on a mesh a few a triangle
constexpr std::size_t no_point = static_cast<std::size_t>(-1);

struct Geometry {
  OdePointer<dxGeom> id;
  int material = simulation::no_material;
};
struct Body {
  dBodyID id = nullptr;     ///< owned by the world; null: a base that nothing moves
  Vector3d center_of_mass;  ///< in the body's frame [m]: where ODE has the body's origin
  std::vector<Geometry> geometries;
};

/// A step of stairs, or an obstacle: a body that is moved and that nothing pushes.
struct Standing {
  OdePointer<dxGeom> geometry;
  int material = 0;
  std::optional<std::size_t> obstacle;
  dBodyID body = nullptr;  ///< of an obstacle; owned by the world
};

/// A contact joint of the last step, with the place where ODE puts its force.
struct Touch {
  std::size_t body;   ///< index among the bodies
  std::size_t point;  ///< index among the touching points, or no_point: a shape's
  Vector3d position, normal;
  dJointFeedback feedback;
};

BodyState state_of(const Body& body) {
  BodyState state;
  const dReal* q = dBodyGetQuaternion(body.id);
  state.orientation = {q[0], q[1], q[2], q[3]};
  state.angular_velocity = vector(dBodyGetAngularVel(body.id));
  // ODE's origin is the centre of mass; ours is the body frame's.
  const Vector3d arm = rotate(state.orientation, -body.center_of_mass);
  state.position = vector(dBodyGetPosition(body.id)) + arm;
  state.velocity = vector(dBodyGetLinearVel(body.id)) + cross(state.angular_velocity, arm);
  return state;
}

dBodyID make_body(dWorldID world, const simulation::MassSpec& spec, const BodyState& initial) {
  const dBodyID id = dBodyCreate(world);
  dMass mass;
  const Symmetric3d& I = spec.inertia;
  dMassSetParameters(&mass, spec.mass, 0., 0., 0., I.xx, I.yy, I.zz, I.xy, I.xz, I.yz);
  dBodySetMass(id, &mass);
  const Vector3d arm = rotate(initial.orientation, spec.center_of_mass);
  const Vector3d position = initial.position + arm;
  const Vector3d velocity = initial.velocity + cross(initial.angular_velocity, arm);
  const Quaterniond& q = initial.orientation;
  const dQuaternion orientation = {q.w, q.x, q.y, q.z};
  dBodySetPosition(id, position.x, position.y, position.z);
  dBodySetQuaternion(id, orientation);
  dBodySetLinearVel(id, velocity.x, velocity.y, velocity.z);
  const Vector3d& w = initial.angular_velocity;
  dBodySetAngularVel(id, w.x, w.y, w.z);
  return id;
}

dSurfaceParameters surface_of(const contact::MaterialConstants<double>& material,
                              const OdeSettings& settings) {
  // Without dContactApprox1 mu would be a force limit in newtons. dContactFDir1 stays unset: ODE
  // takes its friction directions from the normal alone, which is why its friction box is
  // direction dependent.
  dSurfaceParameters surface{};
  surface.mode = dContactApprox1;
  surface.mu = single_friction(material);
  if (settings.soft_normal) {
    surface.mode |= dContactSoftERP | dContactSoftCFM;
    surface.soft_erp = settings.constraint.normal_error_reduction;
    surface.soft_cfm = settings.constraint.normal_mixing;
  }
  if (settings.tangential_slip) {
    surface.mode |= dContactSlip1 | dContactSlip2;
    surface.slip1 = surface.slip2 = settings.constraint.tangential_mixing;
  }
  if (settings.restitution && material.restitution > 0.) {
    surface.mode |= dContactBounce;
    surface.bounce = material.restitution;
  }
  return surface;
}

class OdeWorld final : public PeerWorld {
 public:
  OdeWorld(const simulation::Experiment& experiment, Settings settings, OdeSolver solver)
      : solver_(solver),
        settings_(settings),
        deltat_(experiment.deltat),
        materials_(experiment),
        random_(static_cast<unsigned long>(experiment.seed)) {
    prepare_ode_for_this_thread();
    create_world(experiment.gravity,
                 ode_settings(settings, solver, deltat_, ground_material(experiment)));
    if (experiment.constraint_mixing) dWorldSetCFM(world_.get(), *experiment.constraint_mixing);
    const RobotTree tree = robot_tree(experiment);
    trails_ = simulation::body_trails(experiment);
    add_bodies(experiment, tree);
    forced_ = forced_bodies(experiment, tree);
    for (const Solid& solid : solids_of(experiment)) add_standing(solid);
    if (!experiment.terrain) return;
    ground_.emplace(ground_of(*experiment.terrain));
    terrain_.emplace(*experiment.terrain);
    material_ = experiment.terrain->material;
    points_ = touching_points(experiment, tree);
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    prepare_ode_for_this_thread();
    const OdeMessages messages;
    try {
      apply_forces(inputs);
      joints_->apply(inputs.joint_torques);
      move_obstacles(inputs);
      belt_ = inputs.ground.belt_velocity;
      collide();
      const int taken = take_step();
      listen(messages);
      return taken != 0 ? std::string() : std::string("ODE is out of memory");
    } catch (const OdeFailure& failure) {
      abandon_ode_threading(std::move(threading_));
      return std::string("ODE gave up: ") + failure.what() + smaller_step_helps;
    } catch (const std::bad_alloc&) {
      abandon_ode_threading(std::move(threading_));
      throw;
    }
  }

  std::string notice() override {
    std::string notice = std::exchange(notice_, {});
    return notice.empty() ? limit_.take_notice() : notice;
  }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (bodies_[i].id != nullptr) bodies[i] = state_of(bodies_[i]);
    for (const Touch& touch : touches_) {
      const Vector3d force = vector(touch.feedback.f1);
      bodies[touch.body].contact_force += force;
      if (dot(force, touch.normal) > 0.) ++bodies[touch.body].contacts;
    }
    joints_->read(bodies, joints);
  }

  void read_loops(std::span<simulation::LoopState> loops) const override { loops_->read(loops); }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
    for (const Touch& touch : touches_)
      if (touch.point != no_point) forces[touch.point] = vector(touch.feedback.f1);
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    for (const Touch& touch : touches_)
      if (touch.point == no_point)
        forces.push_back({touch.body, touch.position, vector(touch.feedback.f1)});
  }

 private:
  void create_world(const Vector3d& gravity, const OdeSettings& settings) {
    // The library's default threading is one object for all worlds, with locks that do nothing: a
    // world each.
    threading_.reset(dThreadingAllocateSelfThreadedImplementation());
    world_.reset(dWorldCreate());
    dWorldSetStepThreadingImplementation(
        world_.get(), dThreadingImplementationGetFunctions(threading_.get()), threading_.get());
    contact_group_.reset(dJointGroupCreate(0));
    dWorldSetGravity(world_.get(), gravity.x, gravity.y, gravity.z);
    dWorldSetQuickStepNumIterations(world_.get(), settings.iterations);
    dWorldSetContactSurfaceLayer(world_.get(), settings.constraint.surface_layer);
  }

  void add_bodies(const simulation::Experiment& experiment, const RobotTree& tree) {
    std::vector<dBodyID> ids;
    for (const TreeBody& spec : tree.bodies) {
      Body& body = bodies_.emplace_back();
      body.center_of_mass = spec.body->mass.center_of_mass;
      if (spec.mobile) {
        body.id = make_body(world_.get(), spec.body->mass, spec.initial);
        for (const simulation::ShapeSpec* shape : touching_shapes(experiment, *spec.body))
          body.geometries.push_back(
              {make_ode_geometry(*shape, body.center_of_mass, body.id), shape->material});
        if (spec.plane_normal) keep_in_plane(body.id, plane_axes(*spec.plane_normal));
      }
      ids.push_back(body.id);
    }
    joints_.emplace(tree, world_.get(), ids);
    loops_.emplace(experiment, tree, world_.get(), ids);
  }

  /// Motors of any strength that hold what a plane holds at rest. (ODE's own joint Plane2D knows
  /// the plane z = 0 alone.)
  void keep_in_plane(dBodyID body, const PlaneAxes& axes) {
    const dJointID across = dJointCreateLMotor(world_.get(), nullptr);
    dJointAttach(across, body, nullptr);
    dJointSetLMotorNumAxes(across, 1);
    dJointSetLMotorAxis(across, 0, 0, axes.normal.x, axes.normal.y, axes.normal.z);
    dJointSetLMotorParam(across, dParamFMax, dInfinity);
    dJointSetLMotorParam(across, dParamCFM, 0.);
    const dJointID tilt = dJointCreateAMotor(world_.get(), nullptr);
    dJointAttach(tilt, body, nullptr);
    dJointSetAMotorMode(tilt, dAMotorUser);
    dJointSetAMotorNumAxes(tilt, 2);
    dJointSetAMotorAxis(tilt, 0, 0, axes.first.x, axes.first.y, axes.first.z);
    dJointSetAMotorAxis(tilt, 1, 0, axes.second.x, axes.second.y, axes.second.z);
    for (const int fmax : {dParamFMax, dParamFMax2}) dJointSetAMotorParam(tilt, fmax, dInfinity);
    for (const int cfm : {dParamCFM, dParamCFM2}) dJointSetAMotorParam(tilt, cfm, 0.);
  }

  void apply_forces(const simulation::WorldInputs& inputs) {
    for_each_force(forced_, inputs, [&](std::size_t index, const simulation::ForceInput& force) {
      const Body& body = bodies_[index];
      if (body.id == nullptr) return;
      const Vector3d point = force.point - body.center_of_mass;
      dBodyAddForceAtRelPos(body.id, force.force.x, force.force.y, force.force.z, point.x, point.y,
                            point.z);
      dBodyAddTorque(body.id, force.torque.x, force.torque.y, force.torque.z);
    });
  }

  void add_standing(const Solid& solid) {
    Standing& standing = standing_.emplace_back();
    standing.geometry = make_ode_geometry(solid.geometry);
    standing.material = solid.material;
    standing.obstacle = solid.obstacle;
    if (solid.obstacle) {
      standing.body = dBodyCreate(world_.get());
      dBodySetKinematic(standing.body);
      dGeomSetBody(standing.geometry.get(), standing.body);
    }
    place(standing, solid.pose.position, solid.pose.orientation);
  }

  static void place(const Standing& standing, const Vector3d& p, const Quaterniond& q) {
    const dQuaternion orientation = {q.w, q.x, q.y, q.z};
    dGeomSetPosition(standing.geometry.get(), p.x, p.y, p.z);
    dGeomSetQuaternion(standing.geometry.get(), orientation);
  }

  void move_obstacles(const simulation::WorldInputs& inputs) {
    for (const Standing& standing : standing_) {
      if (!standing.obstacle) continue;
      const simulation::SurfaceMotion& motion = inputs.obstacles[*standing.obstacle];
      const Vector3d &v = motion.velocity, &w = motion.angular_velocity;
      place(standing, motion.position, motion.orientation);
      dBodySetLinearVel(standing.body, v.x, v.y, v.z);
      dBodySetAngularVel(standing.body, w.x, w.y, w.z);
    }
  }

  void collide() {
    dJointGroupEmpty(contact_group_.get());
    touches_.clear();
    contact_joints_.clear();
    for (std::size_t body = 0; body < bodies_.size(); ++body)
      for (const Geometry& geometry : bodies_[body].geometries) {
        if (ground_) collide_ground(body, geometry);
        for (const Standing& standing : standing_) collide_standing(body, geometry, standing);
      }
    for (std::size_t i = 0; i < points_.size(); ++i) collide_point(i);
    // After the last push_back: ODE keeps the addresses for the step.
    for (std::size_t i = 0; i < touches_.size(); ++i)
      dJointSetFeedback(contact_joints_[i], &touches_[i].feedback);
  }

  void collide_ground(std::size_t body, const Geometry& geometry) {
    const int count = ground_->collide(geometry.id.get(), contacts_.data(), max_contacts);
    limit_.check(static_cast<std::size_t>(count), trails_[body]);
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts_[static_cast<std::size_t>(i)];
      add_touch({body, no_point, geometry.material, tile_material(contact)}, contact);
    }
  }

  void collide_standing(std::size_t body, const Geometry& geometry, const Standing& standing) {
    const int count = dCollide(geometry.id.get(), standing.geometry.get(), max_contacts,
                               &contacts_.front().geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts_[static_cast<std::size_t>(i)];
      const int material = standing.obstacle ? standing.material : tile_material(contact);
      add_touch({body, no_point, geometry.material, material, standing.body}, contact);
    }
  }

  int tile_material(const dContact& contact) const {
    if (terrain_->description().patches.empty()) return material_;
    return terrain_->query(vector(contact.geom.pos)).material;
  }

  /// A contact where our own terrain has one; ODE makes the force of it.
  void collide_point(std::size_t index) {
    const TouchingPoint& point = points_[index];
    const Meeting meeting = meet(*terrain_, point, state_of(bodies_[point.body]));
    if (!(meeting.depth > 0.)) return;
    dContact contact{};
    const auto& [position, normal, depth, material] = meeting;
    const std::array<double, 3> at{position.x, position.y, position.z};
    const std::array<double, 3> out{normal.x, normal.y, normal.z};
    std::ranges::copy(at, contact.geom.pos);
    std::ranges::copy(out, contact.geom.normal);
    contact.geom.depth = depth;
    add_touch({point.body, index, point.material, material}, contact);
  }

  /// Who touches what.
  struct Sides {
    std::size_t body, point;      ///< as those of a Touch
    int foot_material, material;  ///< of either side
    dBodyID other = nullptr;      ///< null: the world
  };

  void add_touch(const Sides& sides, dContact& contact) {
    const auto& material = materials_.of(sides.foot_material, sides.material);
    contact.surface = surface_of(material, ode_settings(settings_, solver_, deltat_, material));
    if (sides.other == nullptr && belt_ != Vector3d{}) set_belt(contact);
    const dJointID joint = dJointCreateContact(world_.get(), contact_group_.get(), &contact);
    dJointAttach(joint, bodies_[sides.body].id, sides.other);
    contact_joints_.push_back(joint);
    touches_.push_back(
        {sides.body, sides.point, vector(contact.geom.pos), vector(contact.geom.normal), {}});
  }

  /// The velocity of the ground's material along ODE's own two directions of friction.
  void set_belt(dContact& contact) const {
    dVector3 first, second;
    dPlaneSpace(contact.geom.normal, first, second);
    contact.surface.mode |= dContactMotion1 | dContactMotion2;
    contact.surface.motion1 = dot(belt_, vector(first));
    contact.surface.motion2 = dot(belt_, vector(second));
  }

  int take_step() {
    if (solver_ == OdeSolver::step) return dWorldStep(world_.get(), deltat_);
    const OdeRandomStream::Turn turn(random_);
    return dWorldQuickStep(world_.get(), deltat_);
  }

  void listen(const OdeMessages& messages) {
    if (messages.count() == 0) return;
    if (messages_ == 0)
      notice_ = std::string("ODE's solver reported \"") + messages.first() +
                "\"; it continued with what it had, so forces of this step may be wrong; later "
                "reports are not repeated (docs/reference_engines.md)";
    messages_ += messages.count();
  }

  std::string notice_;
  ContactLimit limit_{"ODE", max_contacts};
  std::vector<std::string> trails_;  ///< of the bodies
  std::int64_t messages_ = 0;        ///< of the library so far
  OdeSolver solver_;
  Settings settings_;
  double deltat_;
  PairMaterials materials_;
  OdeRandomStream random_;
  OdePointer<dxThreadingImplementation> threading_;
  OdePointer<dxWorld> world_;
  OdePointer<dxJointGroup> contact_group_;
  std::optional<OdeGround> ground_;          ///< for shapes
  std::optional<contact::Terrain> terrain_;  ///< for points, and for the material of tiles
  int material_ = 0;                         ///< where no patch lies
  Vector3d belt_;                            ///< velocity of the ground's material [m/s]
  std::vector<Standing> standing_;
  std::vector<Body> bodies_;  ///< as published
  std::optional<OdeJoints> joints_;
  std::optional<OdeLoops> loops_;
  std::vector<std::size_t> forced_;  ///< body of each force
  std::vector<TouchingPoint> points_;
  std::array<dContact, max_contacts> contacts_{};
  std::vector<Touch> touches_;
  std::vector<dJointID> contact_joints_;  ///< of `touches_`
};

}  // namespace

std::unique_ptr<PeerWorld> make_ode_world(const simulation::Experiment& experiment,
                                          Settings settings, OdeSolver solver) {
  return std::make_unique<OdeWorld>(experiment, settings, solver);
}

}  // namespace hookpoint::reference
