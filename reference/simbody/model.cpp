// The one file that sees Simbody's headers.
#include "reference/simbody/model.h"

// Debian's library is built without NDEBUG, and its headers declare other things with it.
#ifdef NDEBUG
#error "this file must be compiled without NDEBUG, as the library is"
#endif
#include <Simbody.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

static_assert(std::is_same_v<SimTK::Real, double>,
              "the tables say that Simbody runs in double precision");

namespace hookpoint::reference::simbody {
namespace {

using SimTK::ContactGeometry;
using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::Vec3;

// Steps that the integrator may try in a step of ours: more means that it follows a motion far
// faster than any robot's, and that its steps would not end. Each evaluates every body and surface
// five times, so that a large robot has fewer: `most_visits` take some five seconds. The
// number is read after each `internal_steps`.
constexpr int most_tried_steps = 10000, least_tried_steps = 100, internal_steps = 500;
constexpr int most_visits = 340'000;

/// `parts`: bodies and surfaces.
int tried_steps_of(std::size_t parts) {
  const auto most = static_cast<std::size_t>(most_visits);
  return std::clamp(static_cast<int>(most / std::max<std::size_t>(parts, 1)), least_tried_steps,
                    most_tried_steps);
}

Vec3 simtk(const Vec& a) { return {a[0], a[1], a[2]}; }
Vec plain(const Vec3& a) { return {a[0], a[1], a[2]}; }
Transform simtk(const Frame& frame) {
  const auto& q = frame.orientation;
  return {SimTK::Rotation(SimTK::Quaternion(q[0], q[1], q[2], q[3])), simtk(frame.position)};
}

SimTK::MassProperties mass_properties(const Body& body) {
  if (body.mobility == Body::Mobility::fixed) return {0., Vec3(0.), SimTK::Inertia(0.)};
  const auto& I = body.inertia;
  const Vec3 com = simtk(body.center_of_mass);
  const SimTK::Inertia central(I[0], I[1], I[2], I[3], I[4], I[5]);
  return {body.mass, com, central.shiftFromMassCenter(com, body.mass)};
}

/// What may touch the half-space, seen from the shape's own frame: a brick's corners, or the centre
/// of a ball with its radius.
struct Feelers {
  std::vector<Vec3> points;
  double radius = 0.;
};
Feelers feelers_of(const ContactGeometry& shape) {
  if (ContactGeometry::Sphere::isInstance(shape))
    return {{Vec3(0.)}, ContactGeometry::Sphere::getAs(shape).getRadius()};
  Feelers feelers;
  const Vec3 half = ContactGeometry::Brick::getAs(shape).getHalfLengths();
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.})
        feelers.points.emplace_back(x * half[0], y * half[1], z * half[2]);
  return feelers;
}

/// The nearest that a contact of Simbody comes to the penalty law, where it leaves a generator to
/// the user: a normal spring and damper, and along the ground the tangential damper up to Coulomb's
/// limit. Surface 1 is the half-space x > 0, surface 2 a robot's.
class PenaltyGenerator final : public SimTK::ContactForceGenerator {
 public:
  /// `materials`: by the number of the robot's surface; outlives this.
  PenaltyGenerator(SimTK::ContactTypeId type, const std::vector<Material>& materials)
      : ContactForceGenerator(type), materials_(materials) {}

  void calcContactForce(const SimTK::State&, const SimTK::Contact& contact, const SpatialVec& V_12,
                        SimTK::ContactForce& force) const override {
    const auto& tracker = getCompliantContactSubsystem().getContactTrackerSubsystem();
    const Feelers feelers = feelers_of(tracker.getContactSurface(contact.getSurface2()).getShape());
    const Material& material = materials_[static_cast<std::size_t>(int{contact.getSurface2()})];
    const Transform& X_12 = contact.getTransform();
    SpatialVec sum(Vec3(0.), Vec3(0.));  // about the origin of surface 2
    for (const Vec3& point : feelers.points) {
      const Vec3 arm = X_12.R() * point + Vec3(feelers.radius, 0., 0.);
      const Vec3 f =
          point_force(material, (X_12.p() + arm)[0], V_12[1] + SimTK::cross(V_12[0], arm));
      sum += SpatialVec(SimTK::cross(arm, f), f);
    }
    force.setTo(contact.getContactId(), X_12.p(), sum, 0., 0.);
  }

  /// Details of a patch are asked for by visualizers only.
  void calcContactPatch(const SimTK::State&, const SimTK::Contact&, const SpatialVec&,
                        SimTK::ContactPatch& patch) const override {
    patch.clear();
  }

 private:
  static Vec3 point_force(const Material& material, double depth, const Vec3& v) {
    if (!(depth > 0.)) return Vec3(0.);
    const double N =
        std::max(0., material.normal_stiffness * depth + material.normal_damping * v[0]);
    const double speed = std::hypot(v[1], v[2]);
    const double limit = material.kinetic_friction * N;
    const double damper = material.tangential_damping;
    const double c = damper * speed > limit ? limit / speed : damper;
    return {-N, -c * v[1], -c * v[2]};
  }

  const std::vector<Material>& materials_;
};

/// A contact surface's place among what is published.
struct SurfaceUse {
  int body = -1;  ///< -1: the ground
  int point = -1;
};

/// The impulse of the ground on each body since the start, as variables that the integrator carries
/// along: integrated by its own stages, so that the change of momentum is theirs to rounding. They
/// weigh nothing in its errors, and so change no step.
class GroundImpulse final : public SimTK::Force::Custom::Implementation {
 public:
  using Add = std::function<void(const SimTK::State&, SimTK::Vector& forces)>;
  /// `add_forces` adds the ground's force on each body, three numbers a body.
  GroundImpulse(const SimTK::GeneralForceSubsystem& subsystem, int bodies, Add add_forces)
      : subsystem_(subsystem), size_(3 * bodies), add_forces_(std::move(add_forces)) {}

  void calcForce(const SimTK::State&, SimTK::Vector_<SpatialVec>&, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {}
  double calcPotentialEnergy(const SimTK::State&) const override { return 0.; }
  void realizeTopology(SimTK::State& state) const override {
    subsystem_.allocateZ(state, SimTK::Vector(size_, 0.));
  }
  void realizeAcceleration(const SimTK::State& state) const override {
    SimTK::Vector& forces = subsystem_.updZDot(state);
    forces.setToZero();
    add_forces_(state, forces);
  }

 private:
  const SimTK::GeneralForceSubsystem& subsystem_;
  int size_;
  Add add_forces_;
};

/// Simbody's number of a body: the ground comes first.
SimTK::MobilizedBodyIndex mobod(int body) { return SimTK::MobilizedBodyIndex(body + 1); }

}  // namespace

struct Model::Parts {
  explicit Parts(const Description& description);

  void set_contact(const Material& material);
  void add_ground(const Plane& plane, const Material& material);
  void add_body(const Body& body, int number);
  void add_mobilizer(const Body& body, const SimTK::Body::Rigid& rigid);
  void start(const Description& description);
  /// A surface of that material, the next by number.
  SimTK::ContactSurface surface(const ContactGeometry& shape, const Material& material);
  const MobilizedBody& body_of(int body) const { return matter_.getMobilizedBody(mobod(body)); }
  /// Of the ground on each body since the start [N s], three numbers a body.
  SimTK::Vector impulses() const { return forces_.getZ(integrator_.getState()); }
  void add_ground_forces(const SimTK::State& state, SimTK::Vector& forces) const;
  /// Where the line along which a contact's force acts meets the ground.
  Vec3 place_of(const SimTK::ContactForce& contact) const;

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::ContactTrackerSubsystem tracker_{system_};
  SimTK::CompliantContactSubsystem contact_{system_, tracker_};
  SimTK::Force::DiscreteForces inputs_{forces_, matter_};
  // Not CPodes, which the example of stiff contact has: its N_VSpace and others are those of
  // SUNDIALS by name, and the program has SUNDIALS too.
  SimTK::RungeKuttaMersonIntegrator integrator_{system_};
  std::vector<Material> materials_;  ///< by ContactSurfaceIndex
  Vec3 normal_{0.};                  ///< of the ground
  double offset_ = 0.;               ///< of the ground along it [m]
  int tried_steps_ = most_tried_steps;
  // A clique's members do not meet: each ground shares one with what is the other's, and robots
  // share one among themselves.
  const SimTK::ContactCliqueId robots_ = SimTK::ContactSurface::createNewContactClique();
  const SimTK::ContactCliqueId shapes_ = SimTK::ContactSurface::createNewContactClique();
  const SimTK::ContactCliqueId points_ = SimTK::ContactSurface::createNewContactClique();
  std::vector<Body::Mobility> mobilities_;
  std::vector<SurfaceUse> uses_;  ///< by ContactSurfaceIndex; empty without ground
  SimTK::Vector_<SpatialVec> on_bodies_;
  SimTK::Vector on_joints_;
  SimTK::Vector in_last_step_;  ///< the part of impulses() of the last step [N s]
};

Model::Parts::Parts(const Description& description) {
  forces_.setNumberOfThreads(1);
  const SimTK::Force::UniformGravity gravity(forces_, matter_, simtk(description.gravity));
  set_contact(description.material);
  if (description.ground) add_ground(*description.ground, description.material);
  for (const Body& body : description.bodies) add_body(body, static_cast<int>(mobilities_.size()));
  const auto bodies = static_cast<int>(description.bodies.size());
  const SimTK::Force::Custom ground(
      forces_,
      new GroundImpulse(forces_, bodies, [this](const SimTK::State& state, SimTK::Vector& forces) {
        add_ground_forces(state, forces);
      }));
  start(description);
}

void Model::Parts::set_contact(const Material& material) {
  contact_.setTransitionVelocity(material.transition_velocity);
  if (!material.penalty) return;
  for (const SimTK::ContactTypeId type :
       {SimTK::CircularPointContact::classTypeId(), SimTK::BrickHalfSpaceContact::classTypeId()})
    contact_.adoptForceGenerator(new PenaltyGenerator(type, materials_));
}

SimTK::ContactSurface Model::Parts::surface(const ContactGeometry& shape,
                                            const Material& material) {
  materials_.push_back(material);
  return {shape, SimTK::ContactMaterial(material.stiffness, material.dissipation,
                                        material.static_friction, material.kinetic_friction)};
}

void Model::Parts::add_ground(const Plane& plane, const Material& material) {
  normal_ = simtk(plane.normal);
  offset_ = plane.offset;
  const SimTK::Rotation into(SimTK::UnitVec3(-normal_), SimTK::XAxis);
  const auto add = [&](double offset, SimTK::ContactCliqueId clique) {
    matter_.Ground().updBody().addContactSurface(
        Transform(into, offset * normal_),
        surface(ContactGeometry::HalfSpace(), material).joinClique(clique));
    uses_.push_back({});
  };
  add(plane.offset, points_);
  add(plane.offset - plane.lowered, shapes_);
}

void Model::Parts::add_body(const Body& body, int number) {
  SimTK::Body::Rigid rigid(mass_properties(body));
  if (!uses_.empty())
    for (const Surface& part : body.surfaces) {
      const ContactGeometry shape = part.kind == Surface::Kind::brick
                                        ? static_cast<const ContactGeometry&>(
                                              ContactGeometry::Brick(simtk(part.half_lengths)))
                                        : ContactGeometry::Sphere(part.radius);
      const auto clique = part.kind == Surface::Kind::point ? points_ : shapes_;
      rigid.addContactSurface(simtk(part.X_BS),
                              surface(shape, part.material).joinClique(clique).joinClique(robots_));
      uses_.push_back({number, part.point});
    }
  mobilities_.push_back(body.mobility);
  add_mobilizer(body, rigid);
}

void Model::Parts::add_mobilizer(const Body& body, const SimTK::Body::Rigid& rigid) {
  MobilizedBody& parent =
      body.parent < 0 ? matter_.updGround() : matter_.updMobilizedBody(mobod(body.parent));
  const Transform X_PL0 = simtk(body.X_PL0);
  // A Slider goes along x.
  const Transform z_for_x(SimTK::Rotation(-0.5 * SimTK::Pi, SimTK::YAxis));
  switch (body.mobility) {
    case Body::Mobility::fixed:
      MobilizedBody::Weld(parent, X_PL0, rigid, Transform());
      break;
    case Body::Mobility::free:
      MobilizedBody::Free(parent, rigid);
      break;
    case Body::Mobility::planar: {
      const Transform X_WF = simtk(body.X_WF);
      const MobilizedBody::Planar planar(parent, X_WF, rigid, ~X_PL0 * X_WF);
      break;
    }
    case Body::Mobility::turning:
      MobilizedBody::Pin(parent, X_PL0, rigid, Transform());
      break;
    case Body::Mobility::sliding:
      MobilizedBody::Slider(parent, X_PL0 * z_for_x, rigid, z_for_x);
      break;
  }
}

void Model::Parts::start(const Description& description) {
  SimTK::State state = system_.realizeTopology();
  system_.realizeModel(state);
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    const Body& body = description.bodies[i];
    const MobilizedBody& mobilized = body_of(static_cast<int>(i));
    if (body.mobility == Body::Mobility::free) {
      mobilized.setQToFitTransform(state, simtk(body.X_PL0));
      mobilized.setUToFitVelocity(state,
                                  SpatialVec(simtk(body.angular_velocity), simtk(body.velocity)));
    } else if (body.mobility == Body::Mobility::planar) {
      // About z of the plane's frame, then along its x and y.
      const SimTK::Rotation R_WF = simtk(body.X_WF).R();
      const Vec3 v = ~R_WF * simtk(body.velocity);
      mobilized.setOneU(state, 0, (~R_WF * simtk(body.angular_velocity))[2]);
      mobilized.setOneU(state, 1, v[0]);
      mobilized.setOneU(state, 2, v[1]);
    } else if (body.mobility != Body::Mobility::fixed) {
      mobilized.setOneQ(state, 0, body.angle);
      mobilized.setOneU(state, 0, body.rate);
    }
  }
  state.updZWeights() = 0.;
  on_bodies_ = SimTK::Vector_<SpatialVec>(matter_.getNumBodies(), SpatialVec(Vec3(0.), Vec3(0.)));
  on_joints_ = SimTK::Vector(matter_.getNumMobilities(), 0.);
  integrator_.setAccuracy(description.accuracy);
  integrator_.setAllowInterpolation(false);
  tried_steps_ = tried_steps_of(description.bodies.size() + uses_.size());
  integrator_.setInternalStepLimit(std::min(internal_steps, tried_steps_));
  integrator_.initialize(state);
  in_last_step_ = SimTK::Vector(impulses().size(), 0.);
  system_.realize(integrator_.getState(), SimTK::Stage::Dynamics);
}

Model::Model(const Description& description) : parts_(std::make_unique<Parts>(description)) {}
Model::~Model() = default;

void Model::apply(const std::vector<Load>& on_bodies, const std::vector<double>& on_joints) {
  Parts& p = *parts_;
  const SimTK::State& now = p.integrator_.getState();
  SimTK::Vector_<SpatialVec> bodies(p.matter_.getNumBodies(), SpatialVec(Vec3(0.), Vec3(0.)));
  SimTK::Vector joints(p.matter_.getNumMobilities(), 0.);
  bool changed = false;
  for (int i = 0; i < static_cast<int>(on_bodies.size()); ++i) {
    const Load& load = on_bodies[static_cast<std::size_t>(i)];
    const auto mobility = p.mobilities_[static_cast<std::size_t>(i)];
    bodies[mobod(i)] = SpatialVec(simtk(load.torque), simtk(load.force));
    changed = changed || bodies[mobod(i)] != p.on_bodies_[mobod(i)];
    if (mobility != Body::Mobility::turning && mobility != Body::Mobility::sliding) continue;
    const SimTK::UIndex u = p.body_of(i).getFirstUIndex(now);
    joints[u] = on_joints[static_cast<std::size_t>(i)];
    changed = changed || joints[u] != p.on_joints_[u];
  }
  if (!changed) return;
  p.on_bodies_ = bodies;
  p.on_joints_ = joints;
  SimTK::State& state = p.integrator_.updAdvancedState();
  p.inputs_.setAllBodyForces(state, bodies);
  p.inputs_.setAllMobilityForces(state, joints);
  p.integrator_.reinitialize(SimTK::Stage::Dynamics, false);
}

void Model::step_to(double time) {
  SimTK::Integrator& integrator = parts_->integrator_;
  const int tried = integrator.getNumStepsAttempted();
  const SimTK::Vector before = parts_->impulses();
  // The first call after a change of the forces returns at once, with a report.
  while (integrator.getTime() < time) {
    if (integrator.getNumStepsAttempted() - tried > parts_->tried_steps_)
      throw std::runtime_error("it tried more than " + std::to_string(parts_->tried_steps_) +
                               " steps of its own within deltat; what starts deep inside the "
                               "ground, stiff materials and links that turn fast make them short");
    integrator.stepTo(time, time);
  }
  parts_->system_.realize(integrator.getState(), SimTK::Stage::Dynamics);
  parts_->in_last_step_ = parts_->impulses() - before;
}

Motion Model::motion(int body) const {
  const SimTK::State& state = parts_->integrator_.getState();
  const MobilizedBody& mobilized = parts_->body_of(body);
  const SimTK::Quaternion q = mobilized.getBodyRotation(state).convertRotationToQuaternion();
  Motion motion{{plain(mobilized.getBodyOriginLocation(state)), {q[0], q[1], q[2], q[3]}},
                plain(mobilized.getBodyOriginVelocity(state)),
                plain(mobilized.getBodyAngularVelocity(state))};
  const auto mobility = parts_->mobilities_[static_cast<std::size_t>(body)];
  if (mobility == Body::Mobility::turning || mobility == Body::Mobility::sliding) {
    motion.angle = mobilized.getOneQ(state, 0);
    motion.rate = mobilized.getOneU(state, 0);
  }
  return motion;
}

void Model::Parts::add_ground_forces(const SimTK::State& state, SimTK::Vector& forces) const {
  if (uses_.empty()) return;
  const SimTK::ContactSnapshot& active = tracker_.getActiveContacts(state);
  for (int i = 0; i < contact_.getNumContactForces(state); ++i) {
    const SimTK::ContactForce& force = contact_.getContactForce(state, i);
    const auto robots = active.getContactById(force.getContactId()).getSurface2();
    const int first = 3 * uses_[static_cast<std::size_t>(int{robots})].body;
    for (int k = 0; k < 3; ++k) forces[first + k] += force.getForceOnSurface2()[1][k];
  }
}

Vec3 Model::Parts::place_of(const SimTK::ContactForce& contact) const {
  const SpatialVec& wrench = contact.getForceOnSurface2();
  const Vec3& f = wrench[1];
  const double along = SimTK::dot(f, normal_);
  if (!(along > 0.)) return contact.getContactPoint();
  const Vec3 on_line = contact.getContactPoint() + SimTK::cross(f, wrench[0]) / f.normSqr();
  return on_line + (offset_ - SimTK::dot(on_line, normal_)) / along * f;
}

Vec Model::ground_impulse(int body) const {
  const SimTK::Vector& all = parts_->in_last_step_;
  return {all[3 * body], all[3 * body + 1], all[3 * body + 2]};
}

std::vector<Touch> Model::touches() const {
  std::vector<Touch> touches;
  if (parts_->uses_.empty()) return touches;
  const SimTK::State& state = parts_->integrator_.getState();
  const SimTK::ContactSnapshot& active = parts_->tracker_.getActiveContacts(state);
  for (int i = 0; i < parts_->contact_.getNumContactForces(state); ++i) {
    const SimTK::ContactForce& force = parts_->contact_.getContactForce(state, i);
    const SimTK::Contact& contact = active.getContactById(force.getContactId());
    const SimTK::ContactSurfaceIndex robots = contact.getSurface2();
    const Feelers feelers = feelers_of(parts_->tracker_.getContactSurface(robots).getShape());
    const Transform& X_12 = contact.getTransform();
    const auto inside =
        std::count_if(feelers.points.begin(), feelers.points.end(),
                      [&](const Vec3& point) { return (X_12 * point)[0] + feelers.radius > 0.; });
    const SurfaceUse& use = parts_->uses_[static_cast<std::size_t>(int{robots})];
    touches.push_back({use.body, use.point, plain(parts_->place_of(force)),
                       plain(force.getForceOnSurface2()[1]), static_cast<int>(inside)});
  }
  return touches;
}

}  // namespace hookpoint::reference::simbody
