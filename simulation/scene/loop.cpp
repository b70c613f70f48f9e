// Loop: the joint that closes a chain of links.
#include <fmt/format.h>

#include <algorithm>

#include "contact/force_law.h"
#include "language/tree/fields.h"
#include "simulation/dts_engine/loop_assembly.h"
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

namespace loop_field {
constexpr const char *a = "a", *b = "b", *axis = "axis", *stiffness = "stiffness",
                     *damping = "damping";
}

/// Farther than that [m] angles are not what was meant: the user is told.
constexpr double noticed_gap = 1e-4;
/// A loop that Newton's method leaves that far open cannot be closed [m].
constexpr double open_gap = 1e-10;

const Fields<LoopSpec>& loop_fields() {
  static const Fields<LoopSpec> fields{
      required(object_field(loop_field::a, "", "one body: a link (bot.left.shin) or a base")),
      required(object_field(loop_field::b, "", "the other body, of the same robot")),
      vector_field("point_a", "m", &LoopSpec::point_a, "a place of body a, in its frame"),
      vector_field("point_b", "m", &LoopSpec::point_b,
                   "the place of body b, in its frame, that stays there"),
      vector_field(loop_field::axis, "", "",
                   "of a hinge, in body a's frame: the bodies turn about it alone; not given: they "
                   "turn freely about the point"),
      positive(number_field(loop_field::stiffness, "N/m", &LoopSpec::stiffness,
                            "of a spring between the points instead of a constraint; not given: "
                            "exact")),
      not_negative(number_field(loop_field::damping, "N.s/m", &LoopSpec::damping,
                                "with stiffness: beside the spring")),
  };
  return fields;
}

BodyIndex body_of(const language::Object& loop, const char* field, Loading& loading) {
  const auto body = loading.bodies.find(loop.object(field));
  if (body != loading.bodies.end()) return body->second;
  loading.error(place_of(loop, field),
                "a Loop joins bodies: name a link (bot.leg.shin) or a robot's base (bot.base)");
  return {-1, 0};
}

void load_loop(const language::Object& object, const language::Object& world, Loading& loading) {
  const BodyIndex a = body_of(object, loop_field::a, loading);
  const BodyIndex b = body_of(object, loop_field::b, loading);
  if (a.robot < 0 || b.robot < 0) return;
  if (a.robot != b.robot)
    return loading.error(place_of(object, loop_field::b),
                         "a Loop joins two bodies of one robot; these are of two");
  if (a.body == b.body)
    return loading.error(place_of(object, loop_field::b),
                         "a Loop joins two bodies; this is one and the same");
  LoopSpec loop = load_fields(object, loop_fields());
  loop.name = name_within(object, world);
  loop.robot = a.robot;
  loop.body_a = a.body;
  loop.body_b = b.body;
  loop.point_a = a.in_body(loop.point_a);
  loop.point_b = b.in_body(loop.point_b);
  if (object.given(loop_field::axis)) {
    const Vector3d axis = vector_of(object, loop_field::axis);
    if (!(norm(axis) > 0.))
      return loading.error(place_of(object, loop_field::axis),
                           "an axis has a direction; this is 0");
    if (loop.stiffness)
      return loading.error(place_of(object, loop_field::axis),
                           "a Loop with stiffness has no axis: its bodies turn freely; leave one "
                           "of the two out");
    loop.axes = {rotate(a.X_BL.orientation, axis), {}};
  }
  if (object.given(loop_field::damping) && !loop.stiffness)
    return loading.error(place_of(object, loop_field::damping),
                         "damping goes with stiffness; give it too, or leave damping out");
  loading.experiment.loops.push_back(std::move(loop));
}

/// Says so where the angles that a file gives do not close the loops of a robot.
void close(std::size_t robot, const language::Object& first, Loading& loading) {
  const LoopAssembly assembly = assemble_loops(loading.experiment, robot);
  if (assembly.gap_after > open_gap) {
    loading.error(first.position,
                  fmt::format("the loops of robot `{}` cannot be closed: from the joint angles "
                              "given {:.3g} m are left between two points; check lengths and "
                              "points, or start nearer to where they meet",
                              loading.experiment.robots[robot].name, assembly.gap_after));
  } else if (assembly.gap_before > noticed_gap) {
    loading.diagnostics.warning(
        first.position,
        fmt::format("at the joint angles given the points of a loop are {:.3g} m apart; joints of "
                    "robot `{}` were moved by up to {:.3g} rad or m to close it",
                    assembly.gap_before, loading.experiment.robots[robot].name, assembly.farthest));
  }
  if (assembly.rank < assembly.rows)
    loading.diagnostics.note(
        first.position,
        fmt::format("the loops and coupled joints of robot `{}` put {} conditions, {} of them "
                    "independent: what follows from the others carries no force",
                    loading.experiment.robots[robot].name, assembly.rows, assembly.rank));
}

}  // namespace

void add_loop_class(language::Schema& schema) {
  language::ClassSchema loop;
  loop.name = "Loop";
  loop.doc = "closes a chain of links: a place of one body stays at a place of another";
  loop.fields = schemas(loop_fields());
  append(loop.fields,
         {port_only(Direction::output,
                    number_field("error", "m", "", "distance between the two places")),
          port_only(Direction::output,
                    vector_field("force", "N", "", "on body a at the place, world axes")),
          port_only(Direction::output,
                    vector_field("moment", "N.m", "",
                                 "on body a about the place, of a hinge, world axes"))});
  schema.add(std::move(loop));
}

void load_loops(const language::Object& world, Loading& loading) {
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> loops = collect_all(world, "Loop");
  for (const language::Object* object : loops) load_loop(*object, world, loading);
  if (loops.empty() || loading.diagnostics.error_count() != errors_before) return;
  if (contact::find_impulse_law(loading.experiment.contact) != nullptr)
    return loading.error(loops.front()->position,
                         "under an impulse law chains have no loops; choose a force law");
  for (std::size_t robot = 0; robot < loading.experiment.robots.size(); ++robot) {
    const auto of_robot = [&](const LoopSpec& spec) {
      return static_cast<std::size_t>(spec.robot) == robot;
    };
    const auto first = std::ranges::find_if(loading.experiment.loops, of_robot);
    if (first == loading.experiment.loops.end()) continue;
    const auto loop = static_cast<std::size_t>(first - loading.experiment.loops.begin());
    close(robot, *loops[loop], loading);
  }
}

}  // namespace hookpoint::simulation
