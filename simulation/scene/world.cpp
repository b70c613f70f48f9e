#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const contact::LawDescription& law : contact::law_table()) names.emplace_back(law.name);
  return names;
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const integrators::StepperDescription& row : integrators::stepper_table())
    names.emplace_back(row.name);
  return names;
}

language::ClassSchema world_class() {
  language::ClassSchema world;
  world.name = "World";
  world.doc =
      "what is simulated: gravity, ground, robots, and how time advances; exactly one a run";
  world.top_level = true;
  world.default_name = "World";
  world.children = {"Robot", "Material", "Terrain.", "Force", "Push", "Record", "Movie"};
  append(world.children, component_families());
  world.fields = {
      list_field("gravity", "m/s^2", 1, 3, "9.81",
                 "a number g means 0,0,-g; three numbers are the vector"),
      or_word("auto", positive(number_field(
                          "deltat", "s", "0.001",
                          "time step; auto: a safe part of the largest stable one, where there is "
                          "one"))),
      choice_field(
          "integrator", integrator_names(), "semi_implicit_euler",
          "how engine dts integrates a contact force law; an impulse law advances time itself"),
      positive(number_field("relative_tolerance", "", "1e-6",
                            "local error that an adaptive integrator allows, as a part of each "
                            "position and velocity")),
      positive(number_field("absolute_tolerance", "", "1e-8",
                            "local error allowed whatever the size: m, rad, m/s, rad/s")),
      choice_field("contact", law_names(), "hookpoint",
                   "contact law of engine dts; a peer brings its own contact"),
      choice_field("engine", {"dts", "ode", "ode_quickstep", "bullet", "mujoco", "dart", "simbody"},
                   "dts", "who computes the motion: the decoupled tree-structure engine or a peer"),
      choice_field("settings", {"default", "recommended", "matched", "noslip"}, "default",
                   "how a peer is set up: its first example, its maintainers' practice, or nearest "
                   "to the penalty law; noslip, of mujoco alone, is recommended with the no-slip "
                   "iterations of its manual"),
      not_negative(number_field("constraint_mixing", "m/N/s", "",
                                "CFM of ODE's world instead of the library's 1e-10: a contact "
                                "gives way at it times its force; 0 makes four corners singular; "
                                "at settings = matched contacts have their own")),
      positive(number_field("duration", "s", "10", "simulated time of a run")),
      not_negative(integer_field("seed", "1", "seed of all random streams")),
      port_only(Direction::output, number_field("time", "s", "", "simulated time, step * deltat")),
      port_only(Direction::output, number_field("step", "", "", "steps taken")),
      port_only(Direction::output,
                number_field("impacts", "", "", "impulses so far, of an impulse law")),
      port_only(Direction::output,
                number_field("integrator.steps", "", "",
                             "steps so far, of an adaptive integrator its internal ones")),
      port_only(Direction::output, number_field("integrator.rejected", "", "",
                                                "steps that an adaptive integrator took back")),
      port_only(Direction::output, number_field("integrator.evaluations", "", "",
                                                "evaluations of accelerations so far")),
      port_only(Direction::output,
                number_field("integrator.jacobians", "", "", "Jacobian matrices so far")),
      port_only(Direction::output,
                number_field("integrator.events", "", "",
                             "events so far at which an adaptive integrator began anew")),
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

/// Where and how strongly a force acts; wires may drive each part.
std::vector<FieldSchema> force_fields() {
  return {
      required(object_field(
          "body", "", "the body it acts on: a robot's base (bot.base) or a link (bot.leg1.link2)")),
      with_port(Direction::both,
                vector_field("point", "m", "0,0,0",
                             "where the force acts, body axes, from the body frame's origin")),
      with_port(Direction::both, vector_field("force", "N", "0,0,0", "world axes")),
      with_port(Direction::both, vector_field("torque", "N.m", "0,0,0",
                                              "a torque beside the force's moment, world axes")),
  };
}

language::ClassSchema force_class() {
  language::ClassSchema force;
  force.name = "Force";
  force.doc = "an external force and torque on a body, constant unless wired";
  force.fields = force_fields();
  return force;
}

language::ClassSchema push_class() {
  language::ClassSchema push;
  push.name = "Push";
  push.doc = "a Force over a window of time";
  push.fields = force_fields();
  append(
      push.fields,
      {not_negative(number_field("from", "s", "0", "when it begins")),
       not_negative(number_field("to", "s", "", "when it ends; or give `duration`")),
       positive(number_field("duration", "s", "", "how long it lasts; or give `to`")),
       not_negative(number_field("edge", "s", "0",
                                 "time over which it rises at first and falls at last, as half "
                                 "a cosine; 0 switches")),
       port_only(Direction::output,
                 number_field("envelope", "", "",
                              "the part of the force that acts: 0 outside the window, 1 inside"))});
  return push;
}

/// Every number of an object is readable by its trail.
void make_readable(language::ClassSchema& schema) {
  for (FieldSchema& field : schema.fields) {
    const bool numeric = field.type == FieldType::number || field.type == FieldType::integer ||
                         field.type == FieldType::numbers || field.type == FieldType::boolean ||
                         field.type == FieldType::orientation;
    if (numeric && field.port == Direction::none) field.port = Direction::output;
  }
}

}  // namespace

void add_world_classes(language::Schema& schema) {
  schema.add(world_class());
  schema.add(simulator_class());
  schema.add(force_class());
  schema.add(push_class());
}

void add_experiment_classes(language::Schema& schema) {
  schema.add_reader(".urdf", include_urdf);
  language::Schema classes;
  add_world_classes(classes);
  add_robot_classes(classes);
  add_shape_classes(classes);
  add_ground_classes(classes);
  add_control_classes(classes);
  add_record_classes(classes);
  add_expectation_classes(classes);
  for (const auto& [name, type] : classes.classes()) {
    if (schema.find(name) != nullptr) continue;  // the language's own
    language::ClassSchema readable = type;
    make_readable(readable);
    schema.add(std::move(readable));
  }
}

}  // namespace hookpoint::simulation
