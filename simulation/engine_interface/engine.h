// The one interface of every engine, ours and the peers: a world built from an Experiment, stepped,
// and read through plain published values. Whoever measures (studies), records (output) or controls
// sees only these.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "simulation/engine_interface/resumable.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A body's motion. World axes, of the body frame's origin.
struct BodyState {
  Vector3d position;          ///< p_WB [m]
  Quaterniond orientation;    ///< R_WB
  Vector3d velocity;          ///< v_WB [m/s]
  Vector3d angular_velocity;  ///< w_WB [rad/s]
  /// Impulse of the ground on the body over the last step by the step's length, so that the sum of
  /// contact_force * dt is what the ground has given to momentum; 0 before the first step [N].
  Vector3d contact_force;
  int contacts = 0;  ///< boundary points that carried ground force in the last step
};

struct JointState {
  double angle = 0., rate = 0., acceleration = 0., torque = 0.;
};

/// A ContactPoint as the law left it, world axes.
struct PointState {
  Vector3d position;    ///< p_WP [m]
  Vector3d force;       ///< on the robot [N]
  Vector3d hook;        ///< anchor on the ground; the point itself while it is free [m]
  double depth = 0.;    ///< along the ground's normal, > 0 inside [m]
  double sliding = 0.;  ///< 1 while it slips, else 0
  double normal_load = 0., tangential_load = 0.;  ///< parts of the force [N]
};

/// What the contacts of a body come to, at the state whose forces are shown at its points.
struct BodyContact {
  Vector3d moment;              ///< on the body, about its origin, world axes [N m]
  Vector3d center_of_pressure;  ///< mean of the places, by normal load; the origin without load [m]
  double normal_load = 0.;      ///< sum over the contacts, each along its normal [N]
  double tangential_load = 0.;  ///< size of the rest of the force [N]
};

/// What bodies do to the terrain or an obstacle. The sums are about the origin of its frame.
struct SurfaceContact {
  Vector3d force;     ///< impulse on it over the last step by the step's length, world axes [N]
  double count = 0.;  ///< places that carry force
  BodyContact sums;
};

/// What a chain does to the body that carries it, at its hip, world axes, in the step just taken.
struct ChainState {
  Vector3d hip_force;   ///< [N]
  Vector3d hip_moment;  ///< [N m]
};

/// What the body that carries a link does to it at their joint, about the link's origin, world axes, at
/// the published state. The moment about the joint's axis is its torque.
struct JointReaction {
  Vector3d force;   ///< [N]
  Vector3d moment;  ///< [N m]
};

/// Steady velocity in the ground's plane of a body's origin, of a body that creeps on a plane that
/// should hold it: closed forms of engines give it, and studies set it beside the measurement.
struct CreepVelocity {
  double downhill = 0.;  ///< along the fall [m/s]
  double sideways = 0.;  ///< along normal x downhill [m/s]
};

/// A loop of a robot (LoopSpec), world axes.
struct LoopState {
  Vector3d force;     ///< on body a at its point [N]
  Vector3d moment;    ///< on body a about that point, of a hinge [N m]
  double error = 0.;  ///< distance between the two points [m]
};

/// A force of the ground on a body where it acts: at a boundary point, or where shapes meet.
struct GroundForce {
  std::size_t body = 0;  ///< index in WorldState::bodies
  Vector3d point;        ///< p_BC, body axes [m]
  Vector3d force;        ///< on the body, world axes [N]
};

/// A boundary point, or a place of a shape, that touches the ground, world axes: for
/// displays.
struct ContactView {
  std::size_t body = 0;  ///< index in WorldState::bodies
  Vector3d point;        ///< [m]
  Vector3d force;        ///< on the robot [N]
  Vector3d hook;         ///< anchor on the ground; the point itself where there is none [m]
  double depth = 0.;     ///< along the ground's normal, > 0 inside [m]
  double sliding = -1.;  ///< 1 while it slips, else 0; -1 where the engine does not say
};

/// Of when an engine tells its ground forces.
enum class GroundForceTime {
  unknown,   ///< it does not tell them one by one
  now,       ///< they act at the published instant, as its state makes them
  last_step  ///< their mean over the step that led there
};

/// What the integration has cost so far, all robots together (integrators/stepper.h); zeros for an
/// engine that does not say.
struct IntegratorState {
  double steps = 0., rejected = 0., evaluations = 0., jacobians = 0., events = 0.;
};

/// What an engine publishes after each step. Bodies of all robots in order: base, then links chain
/// by chain.
struct WorldState {
  std::int64_t step = 0;
  double time = 0.;  ///< step * deltat [s]
  std::vector<BodyState> bodies;
  std::vector<JointState> joints;
  // Once Engine::publish_details was called; empty where the engine has none.
  std::vector<PointState> points;                ///< one a PointSpec
  std::vector<ChainState> chains;                ///< robots in order
  std::vector<BodyContact> body_contacts;        ///< one a body
  std::vector<SurfaceContact> surface_contacts;  ///< of the terrain, if there is one, and obstacles
  // Once Engine::publish_reactions was called; empty where the engine has none.
  std::vector<JointReaction> reactions;  ///< one a joint
  std::vector<LoopState> loops;          ///< one a LoopSpec; empty where the engine has none
  // Once Engine::publish_ground_forces was called.
  std::vector<GroundForce> ground_forces;
  GroundForceTime ground_force_time = GroundForceTime::unknown;
  /// Once Engine::publish_works was called; empty where the engine does not tell. One a robot: work
  /// over the last step of its external forces, contacts among them, and of its joints' torques [J].
  /// What is left of the change of its kinetic and gravitational energy is numerical.
  std::vector<double> works;
  std::uint64_t impacts = 0;  ///< impulses applied so far (event-driven laws)
  /// Work that the terrain's motion, if there is a terrain, and that of each obstacle has done on
  /// bodies since the start [J]; empty where the engine does not tell.
  std::vector<double> surface_works;
  IntegratorState integrator;
  std::vector<std::string>
      notices;  ///< what the user should know, each said once: a robot has left the terrain
};

/// An external force on a body, as it acts now.
struct ForceInput {
  Vector3d point;   ///< where it acts, body axes [m]
  Vector3d force;   ///< world axes [N]
  Vector3d torque;  ///< world axes [N m]
};

/// A force on any body, which a person exerts (wiring/pull.h).
struct PullInput {
  int robot = -1;         ///< -1: nobody pulls
  int body = 0;           ///< of it: 0 is the base, then the links, chain by chain
  std::size_t index = 0;  ///< of that body in WorldState::bodies
  ForceInput force;
};

/// How the terrain or an obstacle moves over the next step: with constant velocities, so that its
/// frame S, at X_WS now, comes to the end of the step. World axes.
struct SurfaceMotion {
  Vector3d position;          ///< p_WS at the step's start [m]
  Quaterniond orientation;    ///< R_WS at the step's start
  Vector3d velocity;          ///< v_WS of the frame's origin [m/s]
  Vector3d angular_velocity;  ///< w_WS [rad/s]
  Vector3d belt_velocity;     ///< of the material over the surface, beside the frame's [m/s]
};

/// Whether the ground moves, by itself or because a wire drives it.
bool ground_moves(const Experiment& experiment);
/// The same of obstacles.
bool obstacles_move(const Experiment& experiment);
/// Whether the ground or an obstacle moves, by itself or because a wire drives it.
bool surfaces_move(const Experiment& experiment);
/// Takes its frame to the end of a step of `dt` [s].
void advance(SurfaceMotion& surface, double dt);

/// What acts on a world from outside, held over the next step.
struct WorldInputs {
  /// One a joint, robots and chains in order: the drive's force beside what the joint does by
  /// itself (springs, damping, friction) [N m, N for a prismatic joint]. At first the Link's
  /// constant torque.
  std::vector<double> joint_torques;
  /// One a ForceSpec, in order. At first as written; a force over a window starts at zero.
  std::vector<ForceInput> forces;
  PullInput pull;                        ///< beside them
  Vector3d gravity;                      ///< [m/s^2]
  SurfaceMotion ground;                  ///< of the terrain
  std::vector<SurfaceMotion> obstacles;  ///< one an ObstacleSpec, in order
  // Of each robot, where its own are among them:
  std::vector<std::size_t> first_joints;
  std::vector<std::vector<std::size_t>> forces_of;
};

/// O(joints + forces).
WorldInputs initial_inputs(const Experiment& experiment);

/// Why a step was not taken. Nothing is repaired silently: a run that fails stops and says this.
struct StepStatus {
  /// `engine_lost`: it has ended or does not answer, which says nothing of the experiment.
  enum class Kind { ok, not_finite, step_too_large, solver_failed, engine_lost };
  Kind kind = Kind::ok;
  double time = 0.;    ///< [s]
  std::string body;    ///< trail of the body concerned, "block.base"
  std::string advice;  ///< what to change
  /// Another step might have passed: what the stability of the experiment says is worth telling
  /// (analysis/failure.h).
  bool depends_on_step = false;
  bool ok() const { return kind == Kind::ok; }
};

class Engine {
 public:
  virtual ~Engine() = default;
  /// Advances the world by one `deltat`. On failure the state is that before the step.
  virtual StepStatus step() = 0;
  /// Called before the first of `steps` steps whose inputs all are as they stand at that one: an engine
  /// may compute several at once.
  virtual void announce(std::int64_t /*steps*/) {}
  /// The published values; the reference stays valid for the engine's life.
  virtual const WorldState& state() const = 0;
  /// What acts on the world in the next step; may be written between steps. The reference and its
  /// elements' addresses stay valid for the engine's life.
  virtual WorldInputs& inputs() = 0;
  /// From now on, at once and after each step, `state().points` and `chains` are kept up to date.
  virtual void publish_details() {}
  /// The same of `state().reactions`.
  virtual void publish_reactions() {}
  /// Whether the bodies' mean `contact_force` is worked out where that costs something; at first it
  /// is. Without it an engine may leave 0.
  virtual void enable_mean_forces(bool /*on*/) {}
  /// From now on, after each step, `state().ground_forces` is kept up to date. An engine that does
  /// not know them leaves `ground_force_time` unknown.
  virtual void publish_ground_forces() {}
  /// What `ground_force_time` is once that was called.
  virtual GroundForceTime tells_ground_forces() const { return GroundForceTime::unknown; }
  /// From now on, after each step, `state().works` is kept up to date, where the engine tells them.
  virtual void publish_works() {}
  virtual bool tells_works() const { return false; }
  /// Puts what touches the ground at the published state in the place of `contacts`: boundary
  /// points with a name or without. Changes nothing of the run and costs nothing but when it is
  /// called, O(boundary points); details need not have been requested. Under an impulse law a
  /// body's mean force over the last step is shown in equal parts at the points that touch, for
  /// single impulses are over; a peer's forces are those of the step that led there.
  virtual void tell_contacts(std::vector<ContactView>& contacts) const { contacts.clear(); }
  /// What the ground's springs hold at the published state, less what they were given back of what their
  /// dampers took [J]; none where the engine does not tell, or where the ground gives energy by its law:
  /// impulses hold a body still by throwing it up.
  virtual std::optional<double> ground_energy() const { return std::nullopt; }
  /// Its state as numbers; null for an engine whose solver remembers what nobody can read or set.
  virtual Resumable* resumable() { return nullptr; }
  /// What a movie keeps of an instant: its state, or where nobody can read that all that it publishes.
  virtual Saveable* saveable() { return resumable(); }
};

/// What an engine does not do as ours does.
struct EngineGap {
  enum class Handling {
    refused,  ///< an experiment that needs it ends with an ExperimentError
    noticed,  ///< it runs otherwise, and a notice of the run says so
    stated    ///< of every run of the engine: said here and in its documentation
  };
  std::string feature;  ///< "prismatic joints"
  Handling handling = Handling::refused;
  std::string instead;  ///< what happens, or what to do
};

/// A constant of an engine that is a program, at one of its settings, as it says it.
struct SettingConstant {
  std::string settings, quantity, value, source;
};

/// What `hookpoint engines` and the provenance file say of an engine.
struct EngineDescription {
  std::string name;       ///< as in `engine = ode`
  std::string version;    ///< of the library linked
  std::string precision;  ///< "double"
  bool found = true;
  std::vector<std::string> settings;  ///< names that `settings =` accepts
  std::vector<EngineGap> gaps{};
  /// Settings at which it has one coefficient of friction, the kinetic one.
  std::vector<std::string> one_friction{};
  std::vector<SettingConstant> constants{};
  std::string missing{};  ///< of one that is not found: why, and what to do
  std::string program{};  ///< hash of the files of an engine that is a program, else empty
  /// Of a setting, the constants of a Material beside friction that it reads; without an entry the
  /// engine does not say.
  std::map<std::string, std::vector<std::string>> reads{};
};

/// Builds a world from an experiment. Throws ExperimentError when the engine cannot run it, saying
/// what it lacks.
using EngineFactory = std::function<std::unique_ptr<Engine>(const Experiment&)>;

/// The user's experiment cannot run as written; the message says what to change.
struct ExperimentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hookpoint::simulation
