#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "simulation/analysis/advice.h"
#include "simulation/analysis/stability.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::cli {
namespace {

using simulation::Advice;
using simulation::GroundAdvice;

/// Where nothing springs back, any step is stable.
std::string step_text(double step) { return std::isfinite(step) ? text::rounded(step) : "any"; }

void print_ground(const GroundAdvice& ground) {
  fmt::print(
      "robot {} on {}: {} N and {} kg on each of {} points (effective mass of an impact "
      "at one, joints free: {} kg)\n",
      ground.robot, ground.material, text::rounded(ground.load), text::rounded(ground.mass),
      ground.points, text::rounded(ground.least_mass));
  fmt::print("  {:<22} {:>12} {:>12}  {:<7} {}\n", "constant", "present", "advised", "unit",
             "so that");
  for (const simulation::ConstantAdvice& constant : ground.constants)
    fmt::print("  {:<22} {:>12} {:>12}  {:<7} {}\n", constant.name, text::rounded(constant.present),
               text::rounded(constant.advised), constant.unit, constant.reason);
  fmt::print(
      "  points keep their hooks while the body's vertical speed is below {} m/s (advised constants: "
      "{} m/s)\n",
      text::rounded(ground.survival_present, 3), text::rounded(ground.survival_advised, 3));
}

void print_text(const simulation::Experiment& experiment, const Advice& advice) {
  fmt::print("world {}, law {}, {} with deltat {} s\n\n", experiment.world, experiment.contact,
             experiment.integrator, text::rounded(experiment.deltat));
  for (const GroundAdvice& ground : advice.grounds) print_ground(ground);
  fmt::print("\nlargest stable step [s]  {:>12} {:>12}\n", "present", "advised");
  for (const simulation::StepAdvice& step : advice.steps) {
    if (!step.not_computed.empty())
      fmt::print("  {:<22} {}\n", step.integrator, step.not_computed);
    else
      fmt::print("  {:<22} {:>12} {:>12}\n", step.integrator, step_text(step.present),
                 step_text(step.advised));
  }
  if (!advice.controllers.empty())
    fmt::print("  with the loops of {}\n", simulation::first_of(advice.controllers));
  if (!advice.left_out.empty())
    fmt::print("  feedback that is not in it: {}\n", simulation::first_of(advice.left_out));
  fmt::print("\nwhat to change:{}\n", advice.changes.empty() ? " nothing" : "");
  for (const std::string& change : advice.changes) fmt::print("  - {}\n", change);
}

void write_ground(text::JsonWriter& json, const GroundAdvice& ground) {
  json.begin_object().member("robot", ground.robot).member("material", ground.material);
  json.member("points", static_cast<double>(ground.points)).member("load", ground.load);
  json.member("mass", ground.mass).member("least_mass", ground.least_mass);
  json.member("depth", ground.depth).member("wanted_depth", ground.wanted_depth);
  json.key("rebound");
  if (ground.rebound) {
    json.value(*ground.rebound);
  } else {
    json.null();
  }
  json.member("wanted_rebound", ground.wanted_rebound);
  json.member("survival_speed", ground.survival_present);
  json.member("survival_speed_advised", ground.survival_advised);
  json.key("constants").begin_object();
  for (const simulation::ConstantAdvice& constant : ground.constants) {
    json.key(constant.name).begin_object().member("unit", constant.unit);
    json.member("present", constant.present).member("advised", constant.advised).end_object();
  }
  json.end_object().end_object();
}

void write_list(text::JsonWriter& json, const char* key, const std::vector<std::string>& texts) {
  json.key(key).begin_array();
  for (const std::string& text : texts) json.value(text);
  json.end_array();
}

void print_json(const simulation::Experiment& experiment, const Advice& advice) {
  text::JsonWriter json;
  json.begin_object().member("world", experiment.world).member("law", experiment.contact);
  json.member("integrator", experiment.integrator).member("deltat", experiment.deltat);
  json.key("grounds").begin_array();
  for (const GroundAdvice& ground : advice.grounds) write_ground(json, ground);
  json.end_array().key("largest_stable_step").begin_object();
  for (const simulation::StepAdvice& step : advice.steps) {
    json.key(step.integrator).begin_object().member("present", step.present);
    json.member("advised", step.advised);
    if (!step.not_computed.empty()) json.member("not_computed", step.not_computed);
    json.end_object();
  }
  json.end_object();
  write_list(json, "controllers", advice.controllers);
  write_list(json, "left_out", advice.left_out);
  write_list(json, "changes", advice.changes);
  json.end_object();
  std::cout << json.text();
}

/// Where the file's first material stands: "world.rubber"; "" without one.
std::string first_material(const language::Object& root) {
  for (const language::Object* world : root.children_of("World")) {
    for (const language::Object* material : world->children_of("Material"))
      return world->name + "." + material->name;
  }
  for (const language::Object* material : root.children_of("Material")) return material->name;
  return "";
}

/// A wish, read as the material's field would be: with its unit, range and messages.
bool read_wish(application::Application& application, const std::filesystem::path& file,
               const application::Settings& settings, const std::string& material,
               const char* field, double contact::MaterialConstants<double>::*member,
               const std::optional<std::string>& text, std::optional<double>& wish) {
  if (!text) return true;
  application::Settings wishes = settings;
  wishes.trails.push_back(material + "." + field + "=" + *text);
  const auto root = application.evaluate_set(file, wishes);
  if (!root) return false;
  // What the wish sets is not what the file says: that no law reads it is no news.
  const auto wished = application.load(*root, application::Warnings::dropped);
  if (!wished) return false;
  const std::string name = material.substr(material.rfind('.') + 1);
  for (const simulation::MaterialSpec& spec : wished->materials) {
    if (spec.name == name) wish = spec.constants.*member;
  }
  return true;
}

}  // namespace

int advise(const AdviseArguments& arguments) {
  using Constants = contact::MaterialConstants<double>;
  application::Application application(arguments.consent);
  const std::filesystem::path file = application.locate(arguments.file);
  const auto root = application.evaluate_set(file, arguments.settings);
  if (!root) return wrong_input;
  const auto experiment = application.load(*root);
  if (!experiment) return wrong_input;
  const std::string material = first_material(*root);
  simulation::AdviceWishes wishes;
  if (!read_wish(application, file, arguments.settings, material, "nominal_penetration",
                 &Constants::nominal_penetration, arguments.penetration, wishes.penetration) ||
      !read_wish(application, file, arguments.settings, material, "restitution",
                 &Constants::restitution, arguments.rebound, wishes.rebound))
    return wrong_input;
  try {
    const Advice advice = simulation::advise(*experiment, wishes);
    if (arguments.json) {
      print_json(*experiment, advice);
    } else {
      print_text(*experiment, advice);
    }
    return fine;
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
