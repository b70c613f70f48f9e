#include "contact/force_law.h"
#include "simulation/schema.h"
#include "simulation/schema_fields.h"

namespace hookpoint::simulation {
namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const contact::LawDescription& law : contact::law_table()) names.emplace_back(law.name);
  return names;
}

language::ClassSchema world_class() {
  language::ClassSchema world;
  world.name = "World";
  world.doc =
      "what is simulated: gravity, ground, robots, and how time advances; exactly one a run";
  world.top_level = true;
  world.default_name = "World";
  world.children = {"Robot", "Material", "Terrain.", "Force", "Controller."};
  world.fields = {
      list_field("gravity", "m/s^2", 1, 3, "9.81",
                 "a number g means 0,0,-g; three numbers are the vector"),
      positive(number_field("deltat", "s", "0.001", "time step")),
      choice_field(
          "integrator", {"explicit_euler", "semi_implicit_euler", "rk4"}, "semi_implicit_euler",
          "how engine dts integrates a contact force law; an impulse law advances time itself"),
      choice_field("contact", law_names(), "hookpoint",
                   "contact law of engine dts; a peer brings its own contact"),
      choice_field("engine", {"dts", "ode", "ode_quickstep", "bullet"}, "dts",
                   "who computes the motion: the decoupled tree-structure engine or a peer"),
      choice_field("settings", {"default", "recommended", "matched"}, "default",
                   "how a peer is set up: its first example, its maintainers' practice, or nearest "
                   "to the penalty law"),
      positive(number_field("duration", "s", "10", "simulated time of a run")),
      not_negative(integer_field("seed", "1", "seed of all random streams")),
      port_only(Direction::output, number_field("time", "s", "", "simulated time, step * deltat")),
      port_only(Direction::output, number_field("step", "", "", "steps taken")),
      port_only(Direction::both, boolean_field("running", "", "false while the run is paused")),
  };
  return world;
}

language::ClassSchema simulator_class() {
  language::ClassSchema simulator;
  simulator.name = "Simulator";
  simulator.doc = "the running program; always there, under this name";
  simulator.naming = language::Naming::forbidden;
  simulator.implicit = true;
  simulator.default_name = "Simulator";
  simulator.fields = {
      port_only(Direction::input, boolean_field("quit", "", "true ends the program")),
  };
  return simulator;
}

language::ClassSchema force_class() {
  language::ClassSchema force;
  force.name = "Force";
  force.doc = "a constant external force and torque on a body";
  force.fields = {
      required(object_field(
          "body", "", "the body it acts on: a robot's base (bot.base) or a link (bot.leg1.link2)")),
      vector_field("point", "m", "0,0,0",
                   "where the force acts, body axes, from the body frame's origin"),
      vector_field("force", "N", "0,0,0", "world axes"),
      vector_field("torque", "N.m", "0,0,0", "a torque beside the force's moment, world axes"),
  };
  return force;
}

}  // namespace

void add_world_classes(language::Schema& schema) {
  schema.add(world_class());
  schema.add(simulator_class());
  schema.add(force_class());
}

void add_experiment_classes(language::Schema& schema) {
  add_world_classes(schema);
  add_robot_classes(schema);
  add_shape_classes(schema);
  add_ground_classes(schema);
  add_control_classes(schema);
}

}  // namespace hookpoint::simulation
