#include "studies/predictions/predictions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/body_on_plane.h"

namespace hookpoint::studies {
namespace {

std::optional<double> sticking_creep(const RunContext& context, const BodyOnPlane& body,
                                     const PeerContact& peer) {
  if (body.peer) return peer.creep;
  if (body.law) return contact::creep_speed(*body.law, body.tangent(), body.material);
  const auto impulse_law = contact::find_impulse_law(context.experiment->contact);
  if (!impulse_law) return std::nullopt;
  return contact::creep_speed(*impulse_law, body.tangent(), body.single_point, body.material);
}

std::optional<double> creep_speed(const RunContext& context, const BodyOnPlane& body,
                                  const PeerContact& peer) {
  if (body.speed > 0.) return std::nullopt;
  if (body.sticks()) return sticking_creep(context, body, peer);
  // The best line through a t^2/2 on [t1, t2] has the slope a (t1 + t2)/2.
  return body.slip_acceleration() * 0.5 * (context.settle + context.duration);
}

/// Isotropic friction acts along the line of steepest descent at every contact, so nothing moves
/// the body sideways.
std::optional<double> creep_sideways(const RunContext& context, const BodyOnPlane& body,
                                     const PeerContact& peer) {
  if (body.peer && body.sticks()) return peer.creep_sideways;
  return creep_speed(context, body, peer) ? std::optional(0.) : std::nullopt;
}

std::optional<double> slip_acceleration(const BodyOnPlane& body) {
  if (body.speed > 0.) return std::nullopt;
  return body.sticks() ? 0. : body.slip_acceleration();
}

/// Of `friction`, tangential over normal force: mu_k of a body that slides, tan(slope) of one that
/// sticks.
std::optional<double> friction(const BodyOnPlane& body) {
  if (body.speed > 0.) return std::nullopt;
  return body.sticks() ? body.tangent() : body.material.kinetic_friction;
}

/// Shift of a point that carries the tangential `load` [N], where the law's shift is proportional
/// to its load: only then has a load that is put on at once, or a slide that ends, a closed form.
std::optional<double> elastic_shift(const BodyOnPlane& body, double load) {
  const auto shift = [&](double f) {
    return contact::stick_displacement(*body.law, f, body.normal_load(), body.material);
  };
  const std::optional<double> half = shift(0.5 * load), whole = shift(load);
  if (!half || !whole || std::abs(*whole - 2. * *half) > 1e-12 * *whole) return std::nullopt;
  return whole;
}

std::optional<double> stick_displacement(const BodyOnPlane& body) {
  const bool holds_by_spring =
      body.law && contact::creep_speed(*body.law, body.tangent(), body.material) == 0.;
  if (!body.sticks() || body.speed > 0. || !holds_by_spring) return std::nullopt;
  return elastic_shift(body, body.friction_load());
}

std::optional<double> stopping_distance(const BodyOnPlane& body) {
  if (body.speed == 0. || body.sine > 1e-9) return std::nullopt;
  const double coulomb =
      contact::braking_distance(body.speed, body.gravity, body.material.kinetic_friction);
  if (!body.law) return coulomb;
  const std::optional<double> shift =
      elastic_shift(body, body.material.kinetic_friction * body.normal_load());
  if (!shift) return std::nullopt;
  if (*shift == 0.) return coulomb;
  const double offset = contact::braking_elastic_offset(body.normal_load(), body.material);
  return coulomb - (body.material.tangential_damping > 0. ? offset : 0.5 * offset);
}

std::optional<double> impacts(const RunContext& context, const BodyOnPlane& body) {
  const auto impulse_law = contact::find_impulse_law(context.experiment->contact);
  if (body.peer || !impulse_law || !body.single_point) return std::nullopt;
  return contact::impact_rate(*impulse_law, body.gravity * body.cosine, body.material);
}

}  // namespace

PeerContact peer_contact(const EngineEntry& engine, const simulation::Experiment& experiment) {
  PeerContact contact;
  if (engine.creep != nullptr)
    if (const auto creep = engine.creep(experiment)) {
      contact.creep = creep->downhill;
      contact.creep_sideways = creep->sideways;
    }
  if (engine.softness != nullptr) contact.softness = engine.softness(experiment);
  return contact;
}

std::optional<double> predict(std::string_view metric, const RunContext& context,
                              const PeerContact& peer) {
  if (metric == "fell") return joint_loop_fails(context);
  if (metric == "restless") return restless(context);
  if (metric == "slip_onset") return slip_onset(context);
  if (metric == "threshold_error") return threshold_error(context);
  if (metric == "rebound") return rebound(context);
  if (metric == "support_force") return support_force(context);
  if (metric.substr(0, 11) == "penetration") return penetration(metric, context, peer.softness);
  if (!one_rigid_body(context))
    return metric == "slip_acceleration" ? rolling_acceleration(context) : std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (metric == "creep_speed") return creep_speed(context, body, peer);
  if (metric == "creep_sideways") return creep_sideways(context, body, peer);
  if (metric == "slip_acceleration") return slip_acceleration(body);
  if (metric == "friction") return friction(body);
  if (metric == "anisotropy" && body.speed == 0.) return 0.;
  if (metric == "stick_displacement") return stick_displacement(body);
  if (metric == "stopping_distance") return stopping_distance(body);
  if (metric == "impacts") return impacts(context, body);
  if (metric == "direction_error" && !body.sticks() && body.speed == 0.) return 0.;
  return std::nullopt;
}

double RigidSlide::displacement(double time) const {
  const bool rests = speed > 0. && acceleration < 0. && time > -speed / acceleration;
  const double moving = rests ? -speed / acceleration : time;
  return (speed + 0.5 * acceleration * moving) * moving;
}

std::optional<RigidSlide> rigid_slide(const RunContext& context) {
  if (!one_rigid_body(context)) return std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed == 0.) return RigidSlide{0., body.sticks() ? 0. : body.slip_acceleration()};
  if (body.sine > 1e-9) return std::nullopt;
  return RigidSlide{body.speed, -body.material.kinetic_friction * body.gravity};
}

Regime regime_of(const RunContext& context) {
  if (!one_rigid_body(context)) return Regime::none;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed > 0.) return Regime::none;
  return body.sticks() ? Regime::holds : Regime::slides;
}

}  // namespace hookpoint::studies
