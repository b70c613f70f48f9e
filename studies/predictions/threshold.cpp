// The closed form of the threshold of slip: the least pull that friction does not carry, and when a
// body that is pulled by the scene's own signals reaches the speed of slip.
//
// Contacts i = 1..n carry N_i along the normal, of which sum N_i = N is known, and up to mu N_i
// along the plane. While mu does not fall at break-away, a contact at its limit goes on to carry
// it, so that the body moves once the pull is mu N, however N is shared. Where it falls from mu_s
// to mu_k, a contact that breaks away hands on (mu_s - mu_k) N_i to those that hold. Equal
// tangential springs carry F/n each: the contact with the least N_i breaks first, at F = n mu_s min
// N_i. If those that are left cannot carry the rest even at rest, all break there and then. If they
// can, they may still break as the body swings, which depends on the damping and on where each hook
// comes to hold again: then there is no closed form. Of equal N_i all break at mu_s N.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/force_law.h"
#include "contact/laws/stribeck.h"
#include "math/bisect.h"
#include "studies/measure/body_on_plane.h"
#include "studies/predictions/driving_force.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using Constants = contact::MaterialConstants<double>;

/// Tangent of the steepest slope on which the law creeps no faster than `onset_speed`.
double steepest_hold(const contact::LawDescription& law, const Constants& material) {
  const auto fast = [&](double tangent) {
    const std::optional<double> speed = law.creep_speed(tangent, material);
    return !speed || *speed > onset_speed;
  };
  const double friction = material.static_friction;
  if (!fast(friction)) return friction;
  return bisect([&](double tangent) { return fast(tangent) ? 1. : -1.; }, 0., friction);
}

/// Between impacts 2 u0/g apart nothing holds the body, so that it reaches 2 u0 tan.
bool hops_fast(const Constants& material) {
  return 2. * material.rebound_speed * material.static_friction >= onset_speed;
}

/// What acts on the body at one instant, as the plane sees it.
struct PlaneLoad {
  double press = 0.;  ///< into the ground [N]
  Vector3d pull;      ///< along it [N]
  Vector3d moment;    ///< of the external forces about the centre of mass [N m]
  double tangent() const { return norm(pull) / press; }
  double angle() const { return std::atan2(norm(pull), press); }
};

/// The tangents up to which an engine's creep under a pull is slow, by its closed form for slopes:
/// a pull through the centre of mass acts as gravity does that is turned.
class EngineCreep {
 public:
  EngineCreep(const RunContext& context, const PeerContact& peer, double mass, double friction)
      : tilted_(*context.experiment),
        normal_(context.normal),
        creep_of_(peer.creep_of),
        mass_(mass),
        friction_(friction) {
    tilted_.forces.clear();
    tilted_.wires.clear();
    tilted_.components.clear();
  }

  /// The greatest tangent at which the body creeps no faster than `onset_speed`, pulled as by
  /// `load`. Friction is taken to hold where the engine has no closed form.
  double slow_up_to(const PlaneLoad& load) {
    if (creep_of_ == nullptr) return friction_;
    const Vector3d direction = (1. / norm(load.pull)) * load.pull;
    constexpr double alike = 1e-3;
    const bool known = norm(direction - direction_) <= alike &&
                       std::abs(load.press - press_) <= alike * load.press;
    if (known) return slow_up_to_;
    direction_ = direction;
    press_ = load.press;
    return slow_up_to_ = search();
  }

 private:
  std::optional<double> speed_at(double tangent) {
    tilted_.gravity = (press_ / mass_) * (tangent * direction_ - normal_);
    const auto creep = creep_of_(tilted_);
    return creep ? std::optional(std::hypot(creep->downhill, creep->sideways)) : std::nullopt;
  }

  double search() {
    constexpr int parts = 50;
    for (int i = parts; i > 0; --i) {
      const double tangent = friction_ * (i - 1e-6) / parts;
      const std::optional<double> speed = speed_at(tangent);
      if (!speed) continue;
      if (*speed <= onset_speed) return friction_;
      return bisect([&](double t) { return speed_at(t).value_or(0.) - onset_speed; }, 0., tangent);
    }
    return friction_;
  }

  simulation::Experiment tilted_;
  Vector3d normal_;
  simulation::ClosedForm<simulation::CreepVelocity> (*creep_of_)(const simulation::Experiment&);
  double mass_, friction_, press_ = 0., slow_up_to_ = 0.;
  Vector3d direction_;
};

/// A rigid block under Coulomb's friction that the scene's forces pull.
class PulledBlock {
 public:
  PulledBlock(const RunContext& context, const PeerContact& peer)
      : context_(context),
        body_(body_on_plane(context)),
        creep_(context, peer, body_.mass, body_.material.static_friction),
        driving_(context) {
    if (body_.law) steepest_ = steepest_hold(*body_.law, body_.material);
  }

  /// The angle of the driving force when the body begins to slip.
  Prediction onset() {
    if (std::string why = why_start_counts(); !why.empty()) return NoClosedForm{std::move(why)};
    const double dt = context_.experiment->deltat;
    double speed = 0., since = 0.;
    std::optional<double> angle;  // when a slip began that still lasts
    do {
      const double time = static_cast<double>(driving_.step()) * dt;
      const PlaneLoad load = present_load();
      if (!(load.press > 0.)) return NoClosedForm{"the forces lift the body off its ground"};
      const auto slips = breaks_away(load);
      if (!slips) return slips.none();
      const bool fast = speed > onset_speed || creeps_fast(load);
      if (!fast || time < context_.settle - 0.5 * dt) {
        angle.reset();
      } else if (!angle) {
        angle = load.angle();
        since = time;
      }
      if (angle && time - since >= slip_lasts - 1e-9) return *angle;
      if (speed > 0. || *slips)
        speed = std::max(
            0., speed + dt / body_.mass * (norm(load.pull) - friction_at(speed) * load.press));
      last_pull_ = load.pull;
    } while (driving_.advance());
    return NoClosedForm{"the pull does not make the body slip within the run"};
  }

 private:
  PlaneLoad present_load() const {
    const Vector3d force = driving_.force();
    return {-dot(force, context_.normal), tangential(force, context_.normal), driving_.moment()};
  }

  double friction_at(double speed) const {
    const bool falls_with_speed = body_.law && body_.law->reads(&Constants::stribeck_speed);
    return falls_with_speed ? contact::stribeck_friction(speed, body_.material)
                            : body_.material.kinetic_friction;
  }

  /// A start on a slope puts the pull on springs that are not stretched yet. "" where that is over
  /// at `settle` and has broken no contact away.
  std::string why_start_counts() const {
    if (body_.settled) return "";
    const PlaneLoad load = present_load();
    const double stiffness = body_.tangential_stiffness();
    const bool pulled = norm(load.pull) > 1e-9 * load.press;
    if (!pulled || stiffness == 0. || load.tangent() > body_.material.static_friction) return "";
    const double damping =
        body_.contacts() *
        body_.law->linearise(body_.normal_load(), body_.material).tangential_damping;
    const double frequency = std::sqrt(stiffness / body_.mass);
    const double zeta = damping / (2. * std::sqrt(stiffness * body_.mass));
    const double decay = frequency * (zeta < 1. ? zeta : zeta - std::sqrt(zeta * zeta - 1.));
    const double give = norm(load.pull) / (body_.mass * frequency);
    if (give * std::exp(-decay * context_.settle) > onset_speed)
      return "at `settle` the contacts still give from the start on the slope";
    if (body_.friction_drops() &&
        body_.overshoot() * load.tangent() > body_.material.kinetic_friction)
      return "a contact may break away as the contacts give at the start on the slope";
    return "";
  }

  bool creeps_fast(const PlaneLoad& load) {
    const double tangent = load.tangent();
    if (body_.law) return steepest_ < body_.material.static_friction && tangent > steepest_;
    if (!body_.peer || !(tangent > 0.)) return false;
    const double slow = creep_.slow_up_to(load);
    return slow < body_.material.static_friction && tangent > slow;
  }

  /// Whether friction does not carry the load.
  simulation::ClosedForm<bool> breaks_away(const PlaneLoad& load) const {
    if (norm(load.pull) <= 1e-12 * load.press) return false;
    const auto loads = shared(load);
    if (!loads) return loads.none();
    const double stiffness = body_.tangential_stiffness();
    const double rate = norm(load.pull - last_pull_) / context_.experiment->deltat;
    if (driving_.step() > 0 && stiffness > 0. && rate > 0.5 * onset_speed * stiffness)
      return NoClosedForm{"the pull grows so fast that the give of the contacts counts as slip"};
    if (!body_.friction_drops()) return load.tangent() > body_.material.static_friction;
    return avalanche(load, *loads);
  }

  /// Normal loads of the contacts [N]; no closed form where the body would tip or turn.
  simulation::ClosedForm<std::vector<double>> shared(const PlaneLoad& load) const {
    const double pull = norm(load.pull);
    const Vector3d along = (1. / pull) * load.pull, across = cross(context_.normal, along);
    // Moments about the centre of mass, of the forces and of the friction h below it.
    const double pitch = pull * body_.height + dot(load.moment, across);
    const double roll = dot(load.moment, along), yaw = dot(load.moment, context_.normal);
    constexpr double centred = 1e-9;  // [m]
    if (std::abs(roll) > centred * load.press || std::abs(yaw) > centred * load.press)
      return NoClosedForm{"the pull passes beside the centre of mass and turns the body"};
    BodyOnPlane pressed = body_;
    pressed.mass = load.press / (body_.gravity * body_.cosine);
    const auto loads = pressed.normal_loads(pitch, along, context_.normal);
    if (!loads)
      return NoClosedForm{body_.uneven
                              ? "the contacts are not level: how they share the load is unknown"
                              : "the pull tips the body"};
    if (!body_.friction_drops()) return loads->at_points;
    Vector3d middle;
    for (const Vector3d& point : body_.footprint) middle += point;
    if (std::abs(dot(middle, across)) > centred * body_.contacts())
      return NoClosedForm{"the contacts lie unevenly about the line of the pull"};
    const auto [least, greatest] = std::ranges::minmax(loads->at_points);
    constexpr double equal = 1e-9;
    if (greatest - least > equal * greatest && body_.law && !body_.linear_normal_force())
      return NoClosedForm{
          "friction falls as contacts break away, and how they share the load is unknown: the "
          "normal "
          "force of " +
          context_.experiment->contact + " is not proportional to depth"};
    return loads->at_points;
  }

  /// Whether all contacts break away under the load, one after the other; no closed form where only
  /// some do.
  simulation::ClosedForm<bool> avalanche(const PlaneLoad& load, std::vector<double> normal) const {
    std::ranges::sort(normal);
    const double before = body_.material.static_friction, after = body_.material.kinetic_friction;
    double left = norm(load.pull);
    std::size_t held = normal.size();
    for (const double each : normal) {
      if (left / static_cast<double>(held) <= before * each) break;
      left -= after * each;
      --held;
    }
    if (held == normal.size()) return false;
    if (held == 0) return true;
    return NoClosedForm{
        "the contacts carry unequal loads and break away one after the other: when the last one "
        "does "
        "depends on how the body swings"};
  }

  const RunContext& context_;
  BodyOnPlane body_;
  EngineCreep creep_;
  DrivingForce driving_;
  double steepest_ = 0.;  ///< of our law: tangent up to which it creeps slowly
  Vector3d last_pull_;    ///< of the step before [N]
};

/// Why the scene is no single body that forces may pull along a plane; "" where it is.
std::string why_not_pulled_block(const RunContext& context) {
  simulation::Experiment unloaded = *context.experiment;
  unloaded.forces.clear();
  RunContext without = context;
  without.experiment = &unloaded;
  if (std::string why = not_one_rigid_body(without); !why.empty()) return why;
  if (!context.robot_spec().settled && norm(context.robot_spec().velocity) > 0.)
    return "the body moves at the start";
  if (context.robot_spec().plane_normal) return "the robot's base is kept in a plane";
  if (context.weight == 0.) return "there is no gravity";
  return "";
}

}  // namespace

Prediction predicted::slip_onset(const RunContext& context, const PeerContact& peer) {
  if (std::string why = why_not_pulled_block(context); !why.empty())
    return NoClosedForm{std::move(why)};
  const BodyOnPlane body = body_on_plane(context);
  if (!body.peer && !body.law && hops_fast(body.material))
    return NoClosedForm{"the hops of " + context.experiment->contact + " are as fast as a slip"};
  if (std::string why = why_forces_depend_on_motion(*context.experiment); !why.empty())
    return NoClosedForm{std::move(why)};
  try {
    return PulledBlock(context, peer).onset();
  } catch (const simulation::ExperimentError& error) {
    return NoClosedForm{error.what()};  // of the signals, as the run itself says it
  }
}

Prediction predicted::threshold_error(const RunContext& context, const PeerContact& peer) {
  const Prediction onset = slip_onset(context, peer);
  if (!onset) return onset;
  return *onset - std::atan(*static_friction(context));
}

}  // namespace hookpoint::studies
