#include "cli/run_loop.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>
#include <utility>

#include "application/application.h"
#include "cli/exit_status.h"
#include "cli/run_watch.h"
#include "contact/force_law.h"
#include "output/text/number.h"
#include "simulation/analysis/automatic_step.h"
#include "simulation/analysis/stability.h"
#include "simulation/robot_tree.h"
#include "simulation/run/energy_watch.h"

namespace hookpoint::cli {
namespace {

using simulation::Experiment;
using simulation::WorldState;

std::string how_computed(const Experiment& experiment) {
  if (experiment.engine != "dts")
    return fmt::format("engine {}, settings {}", experiment.engine, experiment.settings);
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  const bool own_time = law != nullptr && law->is_impulse_law;
  return fmt::format("engine dts, contact {}{}", experiment.contact,
                     own_time ? "" : ", " + experiment.integrator);
}

/// Says how a run that no step failed came to its end. Returns the exit status.
int report_end(RunWatch& watch, const simulation::World& world) {
  if (const std::string reason = world.ended(); !reason.empty())
    watch.say(
        fmt::format("hookpoint: note: the run ended at {:.6g} s: {}", world.state().time, reason));
  if (!watch.stopped()) return fine;
  watch.say(
      fmt::format("hookpoint: error: interrupted at {:.6g} s; what was recorded up to then "
                  "is kept",
                  world.state().time));
  return watch.status();
}

int report_failure(RunWatch& watch, const simulation::StepStatus& status) {
  watch.say(fmt::format("hookpoint: error: the run stopped at {:.6g} s: {}: {}", status.time,
                        status.body, status.advice));
  return truth_failed;
}

}  // namespace

void tell_stability(const Experiment& experiment) {
  using Contacts = simulation::StabilityBound::Contacts;
  const simulation::StabilityBound bound = simulation::stability_bound(experiment);
  if (!std::isfinite(bound.step)) return;
  const std::string scope = bound.contacts == Contacts::touching  ? " resting on its ground"
                            : bound.contacts == Contacts::landing ? " landing on its ground"
                                                                  : "";
  const std::string limit = bound.step > 0. ? fmt::format("{:.4g} s", bound.step)
                            : bound.controllers.empty()
                                ? "none, without damping it is unstable at any"
                                : "none, its loops are unstable at any";
  const std::string chosen = experiment.chosen_from
                                 ? fmt::format(", auto: at most {:g} of it", simulation::safe_part)
                                 : std::string();
  std::cerr << fmt::format("largest stable step of {} for {}{}: {} (deltat is {:.4g} s{})\n",
                           experiment.integrator, bound.robot, scope, limit, experiment.deltat,
                           chosen);
  if (!bound.left_out.empty())
    std::cerr << "feedback that is not in it: " << simulation::first_of(bound.left_out) << '\n';
  if (experiment.deltat > bound.step) {
    const char* softer = bound.contacts == Contacts::none ? "" : "the ground softer, ";
    const std::string controllers = simulation::controller_advice(bound);
    std::cerr << fmt::format(
        "hookpoint: warning: deltat is above the largest stable step: what springs back will gain "
        "energy; {}\n",
        controllers.empty()
            ? fmt::format("make the step smaller (deltat = auto), {}or choose another integrator",
                          softer)
            : controllers);
  }
  if (std::isfinite(bound.resolved_speed)) {
    std::cerr << fmt::format(
        "under {} the step resolves how friction builds up to {:.3g} m/s of sliding; above, it is "
        "steady friction at once\n",
        experiment.contact, bound.resolved_speed);
  }
}

void print_summary(const Experiment& experiment, const WorldState& state) {
  fmt::print("{} at {} s ({})\n", experiment.world, output::rounded(state.time, 6),
             how_computed(experiment));
  std::size_t body = 0, joint = 0;
  for (const simulation::RobotSpec& robot : experiment.robots) {
    const simulation::BodyState& base = state.bodies[body++];
    fmt::print(
        "  {:<28} location {:13.6g} {:13.6g} {:13.6g} m   velocity {:13.6g} {:13.6g} {:13.6g} "
        "m/s\n",
        robot.name + ".base", base.position.x, base.position.y, base.position.z, base.velocity.x,
        base.velocity.y, base.velocity.z);
    simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
      const simulation::JointState& values = state.joints[joint++];
      const simulation::JointType& type = simulation::joint_type(at.link.joint);
      fmt::print("  {:<28} {} {:13.6g} {:<3}   rate {:13.6g} {}\n",
                 robot.name + "." + at.chain.name + "." + at.link.body.name,
                 type.turns ? "angle   " : "travel  ", values.angle, type.units.position,
                 values.rate, type.units.rate);
      ++body;
    });
  }
  if (state.impacts > 0) fmt::print("  impacts {}\n", state.impacts);
}

int print_expectations(const simulation::Expectations& expectations) {
  int status = fine;
  for (const simulation::ExpectationResult& result : expectations.results()) {
    const simulation::ExpectationSpec& spec = *result.spec;
    const std::string measured = result.measured ? output::rounded(*result.measured) : "never";
    const std::string difference = result.error() ? output::rounded(*result.error(), 2) : "none";
    const bool relative = spec.tolerance > 0. && spec.expected != 0.;
    fmt::print("  {} {:<26} {:>12} {}, closed form {}, {} error {}{}\n", result.ok() ? "✓" : "✗",
               spec.name, measured, spec.unit, output::rounded(spec.expected),
               relative ? "relative" : "absolute", difference,
               spec.source.empty() ? "" : "  (" + spec.source + ")");
    if (!result.ok()) status = truth_failed;
  }
  return status;
}

int step_through(const Experiment& experiment, simulation::World& world,
                 simulation::RunFiles& files, std::int64_t last,
                 simulation::Expectations* expectations) {
  const std::int64_t first = world.state().step;
  RunWatch watch(experiment.world,
                 {world.state().time, static_cast<double>(last) * experiment.deltat},
                 [&files] { files.close_within_step(); });
  // What is written is finite, or the run has stopped.
  const auto written = [&] {
    const std::string& trail = files.first_not_finite();
    return trail.empty() ? simulation::StepStatus{}
                         : simulation::stopped_by_port(world.state().time, trail);
  };
  if (const auto status = written(); !status.ok()) return report_failure(watch, status);
  files.row(first, world.state().time);
  if (expectations != nullptr) expectations->observe(world.state().time);
  simulation::EnergyWatch energy(experiment, world, last);
  std::size_t told = 0;
  const auto tell_notices = [&] {
    for (; told < world.state().notices.size(); ++told)
      watch.say("hookpoint: note: " + world.state().notices[told]);
  };
  for (std::int64_t step = first + 1; step <= last && !watch.stopped() && world.ended().empty();
       ++step) {
    watch.begin_step();
    simulation::StepStatus status = world.step();
    watch.end_step(world.state().time);
    if (status.ok()) status = written();
    tell_notices();
    if (!status.ok()) return report_failure(watch, status);
    files.row(step, world.state().time);
    if (expectations != nullptr) expectations->observe(world.state().time);
    energy.observe();
  }
  if (const std::string finding = energy.finding(); !finding.empty())
    watch.say("hookpoint: warning: " + finding);
  return report_end(watch, world);
}

int step_through(simulation::LiveRun& run) {
  RunWatch watch(run.experiment().world,
                 {0., static_cast<double>(run.last_step()) * run.experiment().deltat},
                 [&run] { run.close_within_step(); });
  std::size_t told = 0;
  std::uint64_t generation = run.generation();
  while (run.world().state().step < run.last_step() && !watch.stopped() && run.ended().empty()) {
    watch.begin_step();
    const simulation::StepStatus status = run.step();
    watch.end_step(run.world().state().time);
    // Another world has nothing said yet.
    if (std::exchange(generation, run.generation()) != generation) told = 0;
    const std::vector<std::string>& notices = run.world().state().notices;
    for (; told < notices.size(); ++told) watch.say("hookpoint: note: " + notices[told]);
    if (!status.ok()) return report_failure(watch, status);
  }
  return report_end(watch, run.world());
}

void tell_files(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::cerr << fmt::format("wrote {}: {}\n", folder.string(), fmt::join(names, ", "));
}

}  // namespace hookpoint::cli
