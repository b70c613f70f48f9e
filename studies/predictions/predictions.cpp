#include "studies/predictions/predictions.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/measure/body_on_plane.h"
#include "studies/predictions/start_effects.h"

namespace hookpoint::studies {
namespace {

const NoClosedForm thrown{"the body is thrown along the ground"};

/// Why it is not certain that a body which Coulomb's friction can hold does hold; "" where it is.
/// A point that breaks away falls to kinetic friction, which does not carry the body.
std::string why_it_may_break_away(const RunContext& context, const BodyOnPlane& body) {
  if (!body.sticks() || !body.friction_drops() || body.tangent() <= body.material.kinetic_friction)
    return "";
  const double load = body.overshoot() * body.friction_load();
  const double moment = load * body.contacts() * body.height;
  const auto normal_loads = body.normal_loads(moment, context.downhill, context.normal);
  const bool holds =
      normal_loads && std::ranges::all_of(normal_loads->at_points, [&](double normal) {
        return load <= body.material.static_friction * normal;
      });
  if (holds) return "";
  return "the slope is between kinetic and static friction: a contact that breaks away at the start "
         "may take the others with it";
}

Prediction sticking_creep(const RunContext& context, const BodyOnPlane& body,
                          const PeerContact& peer) {
  if (body.peer) {
    if (!peer.creep) return peer.creep.none();
    return peer.creep->downhill;
  }
  const std::string& law = context.experiment->contact;
  if (body.law) {
    const auto speed = body.law->creep_speed(body.tangent(), body.material);
    if (!speed) return NoClosedForm{"the friction of " + law + " never carries the body"};
    return *speed;
  }
  const auto* const impulse_law = contact::find_impulse_law(law);
  if (!impulse_law) return NoClosedForm{"the law " + law + " has none of its creep"};
  const auto speed =
      impulse_law->impulse->creep_speed(body.tangent(), body.single_point, body.material);
  if (!speed) return NoClosedForm{"a body with several contact points rocks between the impacts"};
  return *speed;
}

/// The steady motion, where the start does not count in what is measured any more.
Prediction once_started(const RunContext& context, const BodyOnPlane& body, Fitted fitted,
                        const Prediction& steady) {
  if (!steady) return steady;
  if (std::string why = why_start_counts(context, body, fitted, *steady); !why.empty())
    return NoClosedForm{std::move(why)};
  return steady;
}

Prediction creep_speed(const RunContext& context, const BodyOnPlane& body,
                       const PeerContact& peer) {
  if (body.speed > 0.) return thrown;
  if (std::string why = why_it_may_break_away(context, body); !why.empty())
    return NoClosedForm{std::move(why)};
  // The best line through a t^2/2 on [t1, t2] has the slope a (t1 + t2)/2.
  const Prediction steady =
      body.sticks() ? sticking_creep(context, body, peer)
                    : body.slip_acceleration() * 0.5 * (context.settle + context.duration);
  return once_started(context, body, Fitted::speed, steady);
}

/// Isotropic friction acts along the line of steepest descent at every contact, so nothing moves
/// the body sideways.
Prediction creep_sideways(const RunContext& context, const BodyOnPlane& body,
                          const PeerContact& peer) {
  const Prediction downhill = creep_speed(context, body, peer);
  if (!downhill) return downhill;
  return body.peer && body.sticks() ? peer.creep->sideways : 0.;
}

Prediction slip_acceleration(const RunContext& context, const BodyOnPlane& body,
                             const PeerContact&) {
  if (body.speed > 0.) return thrown;
  if (std::string why = why_it_may_break_away(context, body); !why.empty())
    return NoClosedForm{std::move(why)};
  return once_started(context, body, Fitted::acceleration,
                      body.sticks() ? 0. : body.slip_acceleration());
}

/// Of `friction`, tangential over normal force: mu_k of a body that slides, tan(slope) of one that
/// sticks.
Prediction friction(const RunContext& context, const BodyOnPlane& body, const PeerContact& peer) {
  if (body.speed > 0.) return thrown;
  if (std::string why = why_it_may_break_away(context, body); !why.empty())
    return NoClosedForm{std::move(why)};
  if (body.sticks()) return body.tangent();
  // (pull - a)/load, a the slide's acceleration.
  const Prediction slide = slip_acceleration(context, body, peer);
  if (!slide) return slide;
  return body.material.kinetic_friction;
}

Prediction anisotropy(const RunContext&, const BodyOnPlane& body, const PeerContact&) {
  if (body.speed > 0.) return thrown;
  return 0.;
}

/// Shift of a point that carries the tangential `load` [N], where the law's shift is proportional
/// to its load: only then has a load that is put on at once, or a slide that ends, a closed form.
Prediction elastic_shift(const RunContext& context, const BodyOnPlane& body, double load) {
  const auto shift = [&](double f) {
    return body.law->stick_displacement(f, body.normal_load(), body.material);
  };
  const std::optional<double> half = shift(0.5 * load), whole = shift(load);
  if (!half || !whole || std::abs(*whole - 2. * *half) > 1e-12 * *whole)
    return NoClosedForm{"the shift of a contact of " + context.experiment->contact +
                        " is not proportional to its load"};
  return *whole;
}

/// What a start with slack springs becomes at rest; from a start in balance nothing moves.
Prediction slack_give(const RunContext& context, const BodyOnPlane& body, const PeerContact&) {
  if (body.peer || !body.law) return NoClosedForm{"the contact has no tangential springs"};
  if (body.speed > 0.) return thrown;
  if (!body.sticks()) return NoClosedForm{"the body slides"};
  if (body.law->creep_speed(body.tangent(), body.material) != 0.)
    return NoClosedForm{"the body creeps: no spring holds it"};
  const Prediction shift = elastic_shift(context, body, body.friction_load());
  if (!shift) return shift;
  const double peak = body.overshoot() * body.friction_load();
  const auto loads =
      body.normal_loads(peak * body.contacts() * body.height, context.downhill, context.normal);
  const bool within = loads && std::ranges::all_of(loads->at_points, [&](double normal) {
                        return peak <= body.material.static_friction * normal;
                      });
  if (!within)
    return NoClosedForm{"a contact may slip as the body swings past its rest at the start"};
  return shift;
}

Prediction stick_displacement(const RunContext& context, const BodyOnPlane& body,
                              const PeerContact& peer) {
  const bool springs_hold = body.settled && body.tangential_stiffness() > 0. && body.sticks();
  return springs_hold ? 0. : slack_give(context, body, peer);
}

Prediction stopping_distance(const RunContext& context, const BodyOnPlane& body,
                             const PeerContact&) {
  if (body.speed == 0.) return NoClosedForm{"the body is not thrown"};
  if (!body.level()) return NoClosedForm{"the ground slopes"};
  if (body.material.kinetic_friction == 0.)
    return NoClosedForm{"without friction the body never stops"};
  const double coulomb =
      contact::braking_distance(body.speed, body.gravity, body.material.kinetic_friction);
  if (!body.law) return coulomb;
  const Prediction shift =
      elastic_shift(context, body, body.material.kinetic_friction * body.normal_load());
  if (!shift) return shift;
  if (*shift == 0.) return coulomb;
  const double offset = contact::braking_elastic_offset(body.normal_load(), body.material);
  return coulomb - (body.material.tangential_damping > 0. ? offset : 0.5 * offset);
}

Prediction impacts(const RunContext& context, const BodyOnPlane& body, const PeerContact&) {
  const auto* const impulse_law = contact::find_impulse_law(context.experiment->contact);
  if (body.peer || !impulse_law) return NoClosedForm{"the contact has no impulses"};
  if (!body.single_point)
    return NoClosedForm{"a body with several contact points rocks between the impacts"};
  const auto rate = impulse_law->impulse->impact_rate(body.gravity * body.cosine, body.material);
  if (!rate)
    return NoClosedForm{"the law " + context.experiment->contact + " has none of its rate"};
  return *rate;
}

Prediction direction_error(const RunContext&, const BodyOnPlane& body, const PeerContact&) {
  if (body.speed > 0.) return thrown;
  if (body.sticks()) return NoClosedForm{"friction holds the body: it has no direction"};
  return 0.;
}

/// A closed form that holds for a rigid body alone on a plane.
using OfBody = Prediction (*)(const RunContext&, const BodyOnPlane&, const PeerContact&);

template <OfBody form>
Prediction of_body(const RunContext& context, const PeerContact& peer) {
  if (std::string why = not_one_rigid_body(context); !why.empty())
    return NoClosedForm{std::move(why)};
  return form(context, body_on_plane(context), peer);
}

}  // namespace

PeerContact peer_contact(const EngineEntry& engine, const simulation::Experiment& experiment) {
  PeerContact contact;
  contact.creep_of = engine.creep;
  if (engine.creep != nullptr) contact.creep = engine.creep(experiment);
  if (engine.softness != nullptr) contact.softness = engine.softness(experiment);
  return contact;
}

namespace predicted {

Prediction creep_speed(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::creep_speed>(context, peer);
}
Prediction creep_sideways(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::creep_sideways>(context, peer);
}
Prediction slip_acceleration(const RunContext& context, const PeerContact& peer) {
  if (is_ball(context)) return rolling_acceleration(context);
  return of_body<studies::slip_acceleration>(context, peer);
}
Prediction friction(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::friction>(context, peer);
}
Prediction anisotropy(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::anisotropy>(context, peer);
}
Prediction stick_displacement(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::stick_displacement>(context, peer);
}
Prediction stopping_distance(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::stopping_distance>(context, peer);
}
Prediction impacts(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::impacts>(context, peer);
}
Prediction direction_error(const RunContext& context, const PeerContact& peer) {
  return of_body<studies::direction_error>(context, peer);
}

}  // namespace predicted

Prediction predict(std::string_view metric, const RunContext& context, const PeerContact& peer) {
  const MetricDefinition* const row = find_metric(metric);
  if (row == nullptr || row->predict == nullptr)
    return NoClosedForm{"none is known of " + std::string(metric)};
  return row->predict(context, peer);
}

Prediction tangential_give(const RunContext& context) { return of_body<slack_give>(context, {}); }

double RigidSlide::displacement(double time) const {
  const bool rests = speed > 0. && acceleration < 0. && time > -speed / acceleration;
  const double moving = rests ? -speed / acceleration : time;
  return (speed + 0.5 * acceleration * moving) * moving;
}

std::optional<RigidSlide> rigid_slide(const RunContext& context) {
  if (!not_one_rigid_body(context).empty()) return std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed == 0.) return RigidSlide{0., body.sticks() ? 0. : body.slip_acceleration()};
  if (!body.level()) return std::nullopt;
  return RigidSlide{body.speed, -body.material.kinetic_friction * body.gravity};
}

Regime regime_of(const RunContext& context) {
  if (!not_one_rigid_body(context).empty()) return Regime::none;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed > 0.) return Regime::none;
  return body.sticks() ? Regime::holds : Regime::slides;
}

}  // namespace hookpoint::studies
