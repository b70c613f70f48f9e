#include "reference/ode_world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/experiment_checks.h"
#include "reference/ode_shapes.h"

static_assert(std::is_same_v<dReal, double>, "the tables say that ODE runs in double precision");

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

constexpr int max_contacts =
    64;  // a geometry's; a box on a plane has 4, on a mesh a few a triangle

Vector3d vector(const dReal* a) { return {a[0], a[1], a[2]}; }

struct Body {
  std::size_t index;        ///< of the robot
  dBodyID id;               ///< owned by the world
  Vector3d center_of_mass;  ///< in the body's frame [m]: where ODE has the body's origin
  std::vector<OdePointer<dxGeom>> geometries;
};

/// A contact joint of the last step, with the place where ODE puts its force.
struct Touch {
  std::size_t body;  ///< index of the robot
  Vector3d normal;
  dJointFeedback feedback;
};

class OdeWorld final : public PeerWorld {
 public:
  OdeWorld(const simulation::Experiment& experiment, const OdeSettings& settings, OdeSolver solver,
           std::string_view engine)
      : settings_(settings),
        solver_(solver),
        deltat_(experiment.deltat),
        forces_(experiment.forces),
        random_(static_cast<unsigned long>(experiment.seed)) {
    prepare_ode_for_this_thread();
    create_world(experiment.gravity);
    set_surface(ground_material(experiment));
    if (experiment.terrain) ground_.emplace(ground_of(*experiment.terrain));
    for (std::size_t i = 0; i < experiment.robots.size(); ++i)
      if (experiment.robots[i].mobile) add_body(experiment.robots[i], i, engine);
    touches_.reserve(max_contacts);
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    prepare_ode_for_this_thread();
    const OdeMessages messages;
    try {
      apply_forces(inputs.forces);
      collide();
      const int taken = take_step();
      listen(messages);
      return taken != 0 ? std::string() : std::string("ODE is out of memory");
    } catch (const OdeFailure& failure) {
      abandon_ode_threading(std::move(threading_));
      return std::string("ODE gave up: ") + failure.what();
    }
  }

  std::string notice() override { return std::exchange(notice_, {}); }

  void read(std::span<BodyState> bodies, std::span<JointState> /*joints*/) const override {
    for (const Body& body : bodies_) {
      BodyState& state = bodies[body.index];
      const dReal* q = dBodyGetQuaternion(body.id);
      state.orientation = {q[0], q[1], q[2], q[3]};
      state.angular_velocity = vector(dBodyGetAngularVel(body.id));
      // ODE's origin is the centre of mass; ours is the body frame's.
      const Vector3d arm = rotate(state.orientation, -body.center_of_mass);
      state.position = vector(dBodyGetPosition(body.id)) + arm;
      state.velocity = vector(dBodyGetLinearVel(body.id)) + cross(state.angular_velocity, arm);
      state.contact_force = {};
      state.contacts = 0;
    }
    for (const Touch& touch : touches_) {
      const Vector3d force = vector(touch.feedback.f1);
      bodies[touch.body].contact_force += force;
      if (dot(force, touch.normal) > 0.) ++bodies[touch.body].contacts;
    }
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
  }

 private:
  void create_world(const Vector3d& gravity) {
    // The library's default threading is one object for all worlds, with locks that do nothing: a
    // world each.
    threading_.reset(dThreadingAllocateSelfThreadedImplementation());
    world_.reset(dWorldCreate());
    dWorldSetStepThreadingImplementation(
        world_.get(), dThreadingImplementationGetFunctions(threading_.get()), threading_.get());
    contact_group_.reset(dJointGroupCreate(0));
    dWorldSetGravity(world_.get(), gravity.x, gravity.y, gravity.z);
    dWorldSetQuickStepNumIterations(world_.get(), settings_.iterations);
    dWorldSetContactSurfaceLayer(world_.get(), settings_.constraint.surface_layer);
  }

  void set_surface(const contact::MaterialConstants<double>& material) {
    // Without dContactApprox1 mu would be a force limit in newtons. dContactFDir1 stays unset: ODE
    // takes its friction directions from the normal alone, which is why its friction box is
    // direction dependent.
    surface_.mode = dContactApprox1;
    surface_.mu = single_friction(material);
    if (settings_.soft_normal) {
      surface_.mode |= dContactSoftERP | dContactSoftCFM;
      surface_.soft_erp = settings_.constraint.normal_error_reduction;
      surface_.soft_cfm = settings_.constraint.normal_mixing;
    }
    if (settings_.tangential_slip) {
      surface_.mode |= dContactSlip1 | dContactSlip2;
      surface_.slip1 = surface_.slip2 = settings_.constraint.tangential_mixing;
    }
    if (settings_.restitution && material.restitution > 0.) {
      surface_.mode |= dContactBounce;
      surface_.bounce = material.restitution;
    }
  }

  void add_body(const simulation::RobotSpec& robot, std::size_t index, std::string_view engine) {
    const simulation::MassSpec& spec = robot.base.mass;
    const dBodyID id = dBodyCreate(world_.get());
    dMass mass;
    const Symmetric3d& I = spec.inertia;
    dMassSetParameters(&mass, spec.mass, 0., 0., 0., I.xx, I.yy, I.zz, I.xy, I.xz, I.yz);
    dBodySetMass(id, &mass);

    const Vector3d arm = rotate(robot.orientation, spec.center_of_mass);
    const Vector3d position = robot.location + arm;
    const Vector3d velocity = robot.velocity + cross(robot.angular_velocity, arm);
    const Quaterniond& q = robot.orientation;
    const dQuaternion orientation = {q.w, q.x, q.y, q.z};
    dBodySetPosition(id, position.x, position.y, position.z);
    dBodySetQuaternion(id, orientation);
    dBodySetLinearVel(id, velocity.x, velocity.y, velocity.z);
    const Vector3d& w = robot.angular_velocity;
    dBodySetAngularVel(id, w.x, w.y, w.z);

    Body body{index, id, spec.center_of_mass, {}};
    if (ground_)
      for (const auto& shape : robot.base.shapes)
        body.geometries.push_back(make_ode_geometry(shape, spec.center_of_mass, id, engine));
    bodies_.push_back(std::move(body));
  }

  void apply_forces(const std::vector<simulation::ForceInput>& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      for (const Body& body : bodies_) {
        if (body.index != static_cast<std::size_t>(forces_[i].robot)) continue;
        const simulation::ForceInput& force = forces[i];
        const Vector3d point = force.point - body.center_of_mass;
        dBodyAddForceAtRelPos(body.id, force.force.x, force.force.y, force.force.z, point.x,
                              point.y, point.z);
        dBodyAddTorque(body.id, force.torque.x, force.torque.y, force.torque.z);
      }
  }

  void collide() {
    dJointGroupEmpty(contact_group_.get());
    touches_.clear();
    if (!ground_) return;
    for (const Body& body : bodies_)
      for (const auto& geometry : body.geometries) {
        const int count = ground_->collide(geometry.get(), contacts_.data(), max_contacts);
        for (int i = 0; i < count; ++i) add_touch(body, contacts_[static_cast<std::size_t>(i)]);
      }
    attach_feedback();
  }

  void add_touch(const Body& body, dContact& contact) {
    contact.surface = surface_;
    const dJointID joint = dJointCreateContact(world_.get(), contact_group_.get(), &contact);
    dJointAttach(joint, body.id, nullptr);
    joints_.resize(touches_.size());
    joints_.push_back(joint);
    touches_.push_back({body.index, vector(contact.geom.normal), {}});
  }

  /// After the last push_back: ODE keeps the addresses for the step.
  void attach_feedback() {
    for (std::size_t i = 0; i < touches_.size(); ++i)
      dJointSetFeedback(joints_[i], &touches_[i].feedback);
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
                "\"; it went on with what it had, so forces of this step may be wrong; later "
                "reports are not repeated (docs/reference_engines.md)";
    messages_ += messages.count();
  }

  std::string notice_;
  std::int64_t messages_ = 0;  ///< of the library so far
  OdeSettings settings_;
  OdeSolver solver_;
  double deltat_;
  std::vector<simulation::ForceSpec> forces_;
  OdeRandomStream random_;
  OdePointer<dxThreadingImplementation> threading_;
  OdePointer<dxWorld> world_;
  OdePointer<dxJointGroup> contact_group_;
  std::optional<OdeGround> ground_;
  std::vector<Body> bodies_;
  dSurfaceParameters surface_{};
  std::array<dContact, max_contacts> contacts_{};
  std::vector<Touch> touches_;
  std::vector<dJointID> joints_;
};

}  // namespace

std::unique_ptr<PeerWorld> make_ode_world(const simulation::Experiment& experiment,
                                          const OdeSettings& settings, OdeSolver solver,
                                          std::string_view engine) {
  return std::make_unique<OdeWorld>(experiment, settings, solver, engine);
}

}  // namespace hookpoint::reference
