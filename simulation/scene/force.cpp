// Force: what acts on a body from outside. Push: a Force over a window of time.
#include <exception>

#include "control/core/rational.h"
#include "language/tree/fields.h"
#include "language/wording.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::Direction;
using language::Fields;
using language::number_field;
using language::object_field;
using language::port_only;
using language::vector_field;

namespace {

namespace force_field {
constexpr const char *body = "body", *to = "to", *duration = "duration", *edge = "edge";
}

/// Where and how strongly a force acts; wires may drive each part.
const Fields<ForceSpec>& force_fields() {
  static const Fields<ForceSpec> fields{
      required(object_field(
          force_field::body, "",
          "the body it acts on: a robot's base (bot.base) or a link (bot.leg1.link2)")),
      with_port(Direction::both,
                vector_field("point", "m", &ForceSpec::point,
                             "where the force acts, body axes, from the body frame's origin")),
      with_port(Direction::both, vector_field("force", "N", &ForceSpec::force, "world axes")),
      with_port(Direction::both, vector_field("torque", "N.m", &ForceSpec::torque,
                                              "a torque beside the force's moment, world axes")),
  };
  return fields;
}

const Fields<ForceWindow>& push_fields() {
  static const Fields<ForceWindow> fields{
      not_negative(number_field("from", "s", &ForceWindow::from, "when it begins")),
      not_negative(number_field(force_field::to, "s", "", "when it ends; or give `duration`")),
      positive(number_field(force_field::duration, "s", "", "how long it lasts; or give `to`")),
      not_negative(number_field(force_field::edge, "s", &ForceWindow::edge,
                                "time over which it rises at first and falls at last, as half "
                                "a cosine; 0 switches")),
  };
  return fields;
}

language::ClassSchema force_class() {
  language::ClassSchema force;
  force.name = "Force";
  force.doc = "an external force and torque on a body, constant unless wired";
  force.fields = schemas(force_fields());
  return force;
}

language::ClassSchema push_class() {
  language::ClassSchema push;
  push.name = "Push";
  push.doc = "a Force over a window of time";
  push.fields = schemas(force_fields());
  append(push.fields, schemas(push_fields()));
  append(
      push.fields,
      {port_only(Direction::output,
                 number_field("envelope", "", "",
                              "the part of the force that acts: 0 outside the window, 1 inside"))});
  return push;
}

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
  ForceWindow window = load_fields(push, push_fields());
  const bool has_end = push.given(force_field::to),
             has_duration = push.given(force_field::duration);
  if (has_end == has_duration) {
    loading.error(has_end ? place_of(push, force_field::duration) : push.position,
                  has_end ? "`to` already ends this Push; leave one of `to` and `duration` out"
                          : "this Push never ends; give `to` or `duration`");
    return window;
  }
  window.to =
      has_end ? push.number(force_field::to) : window.from + push.number(force_field::duration);
  if (!is_kept_exactly(window.from) || !is_kept_exactly(window.to)) {
    loading.error(push.position,
                  "a time of this Push is too large or too small to be kept exactly; round it");
  } else if (window.to <= window.from) {
    loading.error(place_of(push, force_field::to),
                  "this Push ends before it begins; `to` must be after `from`");
  } else if (2. * window.edge > window.to - window.from) {
    loading.error(place_of(push, force_field::edge),
                  "the two edges of this Push are longer than the Push itself; make `edge` at most "
                  "half of it");
  }
  return window;
}

void load_force(const language::Object& object, const language::Object& world, Loading& loading) {
  const auto body = loading.bodies.find(object.object(force_field::body));
  if (body == loading.bodies.end()) {
    return loading.error(
        place_of(object, force_field::body),
        language::with_article(object.type) +
            " acts on a body: name a robot's base (bot.base) or a link (bot.leg1.link2)");
  }
  ForceSpec force = load_fields(object, force_fields());
  force.name = name_within(object, world);
  force.robot = body->second.robot;
  force.body = body->second.body;
  force.point = body->second.in_body(force.point);
  if (object.type == "Push") force.window = load_window(object, loading);
  loading.experiment.forces.push_back(std::move(force));
}

}  // namespace

void add_force_classes(language::Schema& schema) {
  schema.add(force_class());
  schema.add(push_class());
}

void load_forces(const language::Object& world, Loading& loading) {
  for (const char* type : {"Force", "Push"}) {
    for (const language::Object* object : world.children_of(type))
      load_force(*object, world, loading);
  }
}

}  // namespace hookpoint::simulation
