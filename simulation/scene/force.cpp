#include <exception>

#include "control/core/rational.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

bool is_kept_exactly(double time) {
  try {
    control::Rational::from(time);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// A Push ends at `to` or after `duration`, one of the two.
ForceWindow load_window(const language::Object& push, Loading& loading) {
  ForceWindow window{push.number("from"), 0., push.number("edge")};
  const bool has_end = push.given("to"), has_duration = push.given("duration");
  if (has_end == has_duration) {
    loading.error(has_end ? place_of(push, "duration") : push.position,
                  has_end ? "`to` already ends this Push; leave one of `to` and `duration` out"
                          : "this Push never ends; give `to` or `duration`");
    return window;
  }
  window.to = has_end ? push.number("to") : window.from + push.number("duration");
  if (!is_kept_exactly(window.from) || !is_kept_exactly(window.to)) {
    loading.error(push.position,
                  "a time of this Push is too large or too small to be kept exactly; round it");
  } else if (window.to <= window.from) {
    loading.error(place_of(push, "to"),
                  "this Push ends before it begins; `to` must be after `from`");
  } else if (2. * window.edge > window.to - window.from) {
    loading.error(place_of(push, "edge"),
                  "the two edges of this Push are longer than the Push itself; make `edge` at most "
                  "half of it");
  }
  return window;
}

void load_force(const language::Object& object, const language::Object& world, Loading& loading) {
  const auto body = loading.bodies.find(object.object("body"));
  if (body == loading.bodies.end()) {
    return loading.error(
        place_of(object, "body"),
        "a " + object.type +
            " acts on a body: name a robot's base (bot.base) or a link (bot.leg1.link2)");
  }
  ForceSpec force{name_within(object, world),
                  body->second.robot,
                  body->second.body,
                  vector_of(object, "point"),
                  vector_of(object, "force"),
                  vector_of(object, "torque"),
                  {}};
  if (object.type == "Push") force.window = load_window(object, loading);
  loading.experiment.forces.push_back(std::move(force));
}

}  // namespace

void load_forces(const language::Object& world, Loading& loading) {
  for (const char* type : {"Force", "Push"}) {
    for (const language::Object* object : world.children_of(type))
      load_force(*object, world, loading);
  }
}

}  // namespace hookpoint::simulation
