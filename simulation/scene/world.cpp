// World: what is simulated and how time advances. Simulator: the program that runs it.
#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "language/tree/fields.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::boolean_field;
using language::choice_field;
using language::Direction;
using language::Fields;
using language::integer_field;
using language::list_field;
using language::LoadedField;
using language::number_field;
using language::port_only;

namespace {

constexpr const char* gravity_field = "gravity";

/// Ours, then the peers.
LoadedField<Experiment> engine_field(const PeerChoices& peers) {
  std::vector<std::string> names{Experiment{}.engine};
  append(names, peers.engines);
  return choice_field("engine", names, &Experiment::engine,
                      "who computes the motion: the decoupled tree-structure engine or another");
}

LoadedField<Experiment> settings_field(const PeerChoices& peers) {
  std::vector<std::string> names(common_settings.begin(), common_settings.end());
  std::string doc =
      "how another engine is set up: its first example, its maintainers' practice, or nearest to the "
      "penalty law";
  for (const PeerChoices::Setting& own : peers.settings) {
    names.push_back(own.name);
    doc += "; " + own.doc;
  }
  return choice_field("settings", names, &Experiment::settings, doc);
}

LoadedField<Experiment> step_field() {
  constexpr const char* automatic = "auto";
  LoadedField<Experiment> field = or_word(
      automatic, positive(number_field(deltat_field, "s", &Experiment::deltat,
                                       "time step; auto: half the largest stable one, at most 1 "
                                       "ms, rounded down to 1, 2 or 5 times a power of ten")));
  field.default_text = automatic;
  return field;
}

Fields<Experiment> world_fields(const PeerChoices& peers) {
  return {
      list_field(gravity_field, "m/s^2", 1, 3, language::default_text(-Experiment{}.gravity.z),
                 "a number g means 0,0,-g; three numbers are the vector"),
      step_field(),
      choice_field(
          "integrator", integrators::integrator_names(), &Experiment::integrator,
          "how engine dts integrates a contact force law; an impulse law advances time itself"),
      positive(number_field("relative_tolerance", "", &Experiment::relative_tolerance,
                            "local error that an adaptive integrator allows, as a part of each "
                            "position and velocity")),
      positive(number_field("absolute_tolerance", "", &Experiment::absolute_tolerance,
                            "local error allowed whatever the size: m, rad, m/s, rad/s")),
      choice_field("contact", contact::law_names(), &Experiment::contact,
                   "contact law of engine dts; other engines bring their own contact"),
      choice_field("touch", {"points", "shapes"}, &Experiment::touch,
                   "what of a body touches: points sampled from its shapes, each on the one tile "
                   "under it, as in the paper; or the shapes as they are, with edges, corners and "
                   "other bodies"),
      choice_field(
          "combine", contact::combination_names(), &Experiment::combine,
          "what holds of the foot's a and the ground's b of friction, restitution, "
          "adhesion and resistance: foot a, ground b, minimum, maximum, product a b, geometric "
          "sqrt(a b), harmonic 2 a b/(a + b), series a b/(a + b); stiffness and damping "
          "are in series always; what one side alone states holds; a Pair overrides"),
      engine_field(peers),
      settings_field(peers),
      not_negative(number_field("constraint_mixing", "m/N/s", &Experiment::constraint_mixing,
                                "CFM of ODE's world instead of the library's 1e-10: a contact "
                                "deflects by it times its force; 0 makes four corners singular; "
                                "at settings = matched contacts have their own")),
      positive(number_field(duration_field, "s", &Experiment::duration, "simulated time of a run")),
      not_negative(integer_field("seed", &Experiment::seed, "seed of all random streams")),
      port_only(Direction::both, number_field("gravity.x", "m/s^2", "",
                                              "of the gravity now, world axes; of engine dts")),
      port_only(Direction::both, number_field("gravity.y", "m/s^2", "", "the same along y")),
      port_only(Direction::both, number_field("gravity.z", "m/s^2", "", "the same along z")),
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
                             "events so far at which an adaptive integrator restarted")),
      port_only(Direction::both, boolean_field("running", "", "false while the run is paused")),
  };
}

language::ClassSchema world_class(const PeerChoices& peers) {
  language::ClassSchema world;
  world.name = "World";
  world.doc =
      "what is simulated: gravity, ground, robots, and how time advances; exactly one a run";
  world.top_level = true;
  world.default_name = "World";
  world.children = {"Robot", "Material", "Pair", "Terrain.", "Obstacle.",
                    "Force", "Push",     "Loop", "Record",   "Movie"};
  append(world.children, component_families());
  world.fields = schemas(world_fields(peers));
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

Vector3d load_gravity(const language::Object& world, Loading& loading) {
  const std::vector<double>& gravity = world.numbers(gravity_field);
  if (gravity.size() == 1) return {0., 0., -gravity[0]};
  if (gravity.size() == 3) return {gravity[0], gravity[1], gravity[2]};
  loading.error(
      place_of(world, gravity_field),
      "gravity has two components; give one number g for 0,0,-g, or the three of the vector");
  return {};
}

}  // namespace

void add_world_classes(language::Schema& schema, const PeerChoices& peers) {
  schema.add(world_class(peers));
  schema.add(simulator_class());
}

void load_world(const language::Object& world, Loading& loading) {
  // Which engines may be chosen has been checked by the schema.
  static const Fields<Experiment> fields = world_fields({});
  Experiment& experiment = loading.experiment;
  experiment.world = world.name;
  experiment.gravity = load_gravity(world, loading);
  store_fields(world, fields, experiment);
}

}  // namespace hookpoint::simulation
