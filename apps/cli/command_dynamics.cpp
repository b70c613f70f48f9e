#include <fmt/format.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "simulation/analysis/controller_terms.h"
#include "simulation/analysis/dynamics_report.h"
#include "simulation/experiment/robot_tree.h"
#include "text/json.h"

namespace hookpoint::cli {
namespace {

using simulation::DynamicsReport;
using simulation::RobotDynamics;

void member(text::JsonWriter& json, const char* name, const Vector3d& v) {
  json.key(name).numbers({v.x, v.y, v.z});
}

/// A matrix as a list of its rows.
void member(text::JsonWriter& json, const std::string& name, std::span<const double> numbers,
            std::size_t columns) {
  json.key(name).begin_array();
  for (; columns > 0 && !numbers.empty(); numbers = numbers.subspan(columns))
    json.numbers(numbers.first(columns));
  json.end_array();
}

void write_terms(text::JsonWriter& json, const simulation::ControllerTerms& terms) {
  const std::size_t n = terms.coordinates().size(), joints = terms.bodies().size() - 1;
  json.key("coordinates").begin_array();
  for (const auto& [trail, unit] : terms.coordinates())
    json.begin_object().member("trail", trail).member("unit", unit).end_object();
  json.end_array();
  member(json, "mass_matrix", terms.mass_matrix(), n);
  json.key("bias_forces").numbers(terms.bias_forces());
  json.key("gravity_forces").numbers(terms.gravity_forces());
  json.member("mass", terms.center_of_mass().mass);
  member(json, "center_of_mass", terms.center_of_mass().position);
  member(json, "center_of_mass_jacobian", terms.center_of_mass().jacobian, n);
  json.key("jacobians").begin_object();
  for (std::size_t body = 0; body <= joints; ++body)
    member(json, terms.bodies()[body], terms.jacobian(body, {}), n);
  json.end_object().key("linearisation").begin_object();
  const simulation::LinearisedRobot linear = terms.linearised(std::vector<double>(joints));
  member(json, "A", linear.A, 2 * n);
  member(json, "B", linear.B, joints);
  json.end_object();
}

void write_robot(text::JsonWriter& json, const RobotDynamics& robot,
                 const simulation::ControllerTerms& terms) {
  json.key(robot.name).begin_object().key("base").begin_object();
  member(json, "linear_acceleration", robot.base_acceleration);
  member(json, "angular_acceleration", robot.base_angular_acceleration);
  json.end_object().key("chains").begin_object();
  for (const simulation::ChainDynamics& chain : robot.chains) {
    json.key(chain.name)
        .begin_object()
        .member("carrier", chain.carrier)
        .key("joint_accelerations")
        .numbers(chain.joint_accelerations);
    member(json, "hip_force", chain.hip_force);
    member(json, "hip_moment", chain.hip_moment);
    json.end_object();
  }
  json.end_object()
      .member("kinetic_energy", robot.kinetic_energy)
      .member("potential_energy", robot.potential_energy);
  member(json, "linear_momentum", robot.linear_momentum);
  member(json, "angular_momentum", robot.angular_momentum);
  json.key("contacts").begin_array();
  for (const simulation::ContactReport& contact : robot.contacts) {
    json.begin_object().member("body", contact.body).member("depth", contact.depth);
    member(json, "position", contact.position);
    member(json, "normal", contact.normal);
    member(json, "force", contact.force);
    json.end_object();
  }
  json.end_array();
  write_terms(json, terms);
  json.end_object();
}

void print_json(const simulation::Experiment& experiment, const DynamicsReport& report) {
  text::JsonWriter json;
  json.begin_object().member("world", report.world).member("time", 0.);
  json.key("robots").begin_object();
  for (std::size_t i = 0; i < report.robots.size(); ++i)
    write_robot(json, report.robots[i], simulation::ControllerTerms(experiment, i));
  json.end_object().key("largest_stable_step");
  if (report.largest_stable_step) {
    json.value(*report.largest_stable_step);
  } else {
    json.null();
  }
  json.end_object();
  std::cout << json.text();
}

/// Why the matrices of a robot are not written: they have the square of its coordinates as numbers.
/// Empty where they are.
std::string too_large_for_json(const simulation::Experiment& experiment) {
  constexpr std::size_t most_joints = 1000;
  for (const simulation::RobotSpec& robot : experiment.robots) {
    const std::size_t joints = simulation::joint_count(robot);
    if (joints > most_joints)
      return fmt::format(
          "robot '{}' has {} joints, and --json writes matrices of at most {}: leave --json out, "
          "or "
          "read single terms by World.dynamics in Python",
          robot.name, joints, most_joints);
  }
  return "";
}

std::string text(const Vector3d& v) {
  return fmt::format("{:12.6g} {:12.6g} {:12.6g}", v.x, v.y, v.z);
}

void print_robot(const RobotDynamics& robot) {
  fmt::print("robot {}\n", robot.name);
  fmt::print("  {:<34} {} m/s^2\n", "base linear acceleration", text(robot.base_acceleration));
  fmt::print("  {:<34} {} rad/s^2\n", "base angular acceleration",
             text(robot.base_angular_acceleration));
  for (const simulation::ChainDynamics& chain : robot.chains) {
    fmt::print("  chain {:<28} joint accelerations", chain.name);
    for (double acceleration : chain.joint_accelerations) fmt::print(" {:.6g}", acceleration);
    const std::string where = fmt::format("on the {} at the hip", chain.carrier);
    fmt::print("\n  {:<34} {} N\n", "  force " + where, text(chain.hip_force));
    fmt::print("  {:<34} {} N.m\n", "  moment " + where, text(chain.hip_moment));
  }
  fmt::print("  {:<34} {:12.6g} J\n", "kinetic energy", robot.kinetic_energy);
  fmt::print("  {:<34} {:12.6g} J\n", "potential energy", robot.potential_energy);
  fmt::print("  {:<34} {} kg.m/s\n", "linear momentum", text(robot.linear_momentum));
  fmt::print("  {:<34} {} kg.m^2/s\n", "angular momentum (world origin)",
             text(robot.angular_momentum));
  for (const simulation::ContactReport& contact : robot.contacts) {
    fmt::print("  contact {:<26} {} N, {:.4g} m deep\n", contact.body, text(contact.force),
               contact.depth);
  }
}

void print_text(const simulation::Experiment& experiment, const DynamicsReport& report) {
  fmt::print("world {}, at its initial state (world axes)\n", report.world);
  for (const RobotDynamics& robot : report.robots) print_robot(robot);
  if (report.largest_stable_step)
    fmt::print("largest stable step of {}: {:.4g} s\n", experiment.integrator,
               *report.largest_stable_step);
}

}  // namespace

int dynamics(const std::filesystem::path& file, const application::Settings& settings, bool json,
             application::Consent consent) {
  application::Application application(consent);
  const auto root = application.evaluate_set(application.locate(file), settings);
  if (!root) return wrong_input;
  const auto experiment = application.load(*root);
  if (!experiment) return wrong_input;
  if (json) {
    const std::string problem = too_large_for_json(*experiment);
    if (!problem.empty()) {
      application::print_error(problem);
      return wrong_input;
    }
  }
  try {
    const DynamicsReport report = simulation::evaluate_dynamics(*experiment);
    if (json)
      print_json(*experiment, report);
    else
      print_text(*experiment, report);
    return fine;
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
