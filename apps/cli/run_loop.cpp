#include "apps/cli/run_loop.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "apps/cli/exit_status.h"
#include "apps/cli/run_watch.h"
#include "apps/shared/application.h"
#include "apps/shared/short_forms.h"
#include "contact/force_law.h"
#include "simulation/analysis/automatic_step.h"
#include "simulation/analysis/stability.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/run/loop.h"
#include "simulation/run/world_watch.h"
#include "text/number.h"

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
  watch.say("hookpoint: error: the run stopped " + simulation::failure_text(status));
  return truth_failed;
}

}  // namespace

void tell_stability(const Experiment& experiment) {
  using Contacts = simulation::StabilityBound::Contacts;
  const simulation::StabilityBound bound = simulation::stability_bound(experiment);
  if (!bound.not_computed.empty())
    std::cerr << "largest stable step of " << experiment.integrator << ": " << bound.not_computed
              << '\n';
  if (!std::isfinite(bound.step)) return;
  const std::string scope = bound.contacts == Contacts::touching  ? " resting on its ground"
                            : bound.contacts == Contacts::landing ? " landing on its ground"
                            : bound.contacts == Contacts::meeting ? " meeting other bodies"
                                                                  : "";
  const std::string limit = bound.step > 0. ? fmt::format("{:.4g} s", bound.step)
                            : bound.controllers.empty()
                                ? "none, without damping it is unstable at any"
                                : "none, its loops are unstable at any";
  const std::string chosen =
      experiment.chosen_from
          ? fmt::format(", auto: at most {:g} of it and {:g} s", simulation::safe_part,
                        simulation::largest_automatic_step)
          : std::string();
  std::cerr << fmt::format("largest stable step of {} for {}{}: {} (deltat is {:.4g} s{})\n",
                           experiment.integrator, bound.robot, scope, limit, experiment.deltat,
                           chosen);
  if (!bound.left_out.empty())
    std::cerr << "feedback that is not in it: " << simulation::first_of(bound.left_out) << '\n';
  if (const auto warning = simulation::step_warning(experiment, bound))
    std::cerr << "hookpoint: warning: " << *warning << '\n';
  if (std::isfinite(bound.resolved_speed)) {
    std::cerr << fmt::format(
        "under {} the step resolves how friction builds up to {:.3g} m/s of sliding; above, it is "
        "steady friction at once\n",
        experiment.contact, bound.resolved_speed);
  }
}

void tell_unread(const language::Object& root, const Experiment& experiment) {
  if (experiment.engine == "dts") return;
  const language::Object& world = *root.children_of("World").front();
  for (const application::ShortForm& form : application::short_forms)
    if (form.of_dts && world.given(form.field) && world.find(form.field)->from_outside)
      std::cerr << fmt::format(
          "hookpoint: note: `{}` is not read: it is of engine dts, and {} has its own\n",
          form.field, experiment.engine);
}

void print_summary(const Experiment& experiment, const WorldState& state) {
  fmt::print("{} at {} s ({})\n", experiment.world, text::rounded(state.time, 6),
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
    const std::string measured = text::rounded(result.measured, "never");
    const std::string difference = text::rounded(result.error(), "none", 2);
    const bool relative = spec.tolerance > 0. && spec.expected != 0.;
    fmt::print("  {} {:<26} {:>12} {}, closed form {}, {} error {}{}\n", result.ok() ? "✓" : "✗",
               spec.name, measured, spec.unit, text::rounded(spec.expected),
               relative ? "relative" : "absolute", difference,
               spec.source.empty() ? "" : "  (" + spec.source + ")");
    if (!result.ok()) status = truth_failed;
  }
  return status;
}

void print_not_judged(const Experiment& experiment, bool whole) {
  const auto count = std::ranges::count_if(
      experiment.expectations,
      [&](const simulation::ExpectationSpec& spec) { return !whole || !spec.covers(experiment); });
  if (count == 0) return;
  const std::string why = !whole ? std::string("the run does not last as long as its scene says")
                                 : fmt::format("of contact {} with integrator {}",
                                               experiment.contact, experiment.integrator) +
                                       (count == 1 ? " it says nothing" : " they say nothing");
  fmt::print("  {} not judged: {}\n",
             count == 1 ? "1 Expect is" : fmt::format("{} Expects are", count), why);
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
  simulation::WorldWatch watched(experiment, world, last);
  std::size_t told = 0;
  const auto tell_notices = [&] {
    for (; told < world.state().notices.size(); ++told)
      watch.say("hookpoint: note: " + world.state().notices[told]);
  };
  const auto end_step = [&] {
    watch.end_step(world.state().time);
    tell_notices();
  };
  const auto after = [&] {
    end_step();
    if (auto status = written(); !status.ok()) return status;
    files.row(world.state().step, world.state().time);
    if (expectations != nullptr) expectations->observe(world.state().time);
    watched.observe();
    return simulation::StepStatus{};
  };
  world.announce(last - world.state().step);
  const simulation::RunEnd end = simulation::run_until(
      world, last, [&] { return watch.begin_step(); }, after);
  if (end.failed()) {
    end_step();
    return report_failure(watch, end.status);
  }
  for (const std::string& finding : watched.findings()) watch.say("hookpoint: warning: " + finding);
  return report_end(watch, world);
}

int step_through(simulation::LiveRun& run) {
  RunWatch watch(run.experiment().world,
                 {0., static_cast<double>(run.last_step()) * run.experiment().deltat},
                 [&run] { run.close_within_step(); });
  std::size_t told = 0;
  std::uint64_t generation = run.generation();
  const auto end_step = [&] {
    watch.end_step(run.state().time);
    // Another world has nothing said yet.
    if (std::exchange(generation, run.generation()) != generation) told = 0;
    const std::vector<std::string>& notices = run.state().notices;
    for (; told < notices.size(); ++told) watch.say("hookpoint: note: " + notices[told]);
  };
  const simulation::RunEnd end = simulation::run_until(
      run, run.last_step(), [&] { return watch.begin_step(); }, end_step);
  if (!end.failed()) return report_end(watch, run.world());
  end_step();
  return report_failure(watch, end.status);
}

void tell_files(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::cerr << fmt::format("wrote {}: {}\n", folder.string(), fmt::join(names, ", "));
}

}  // namespace hookpoint::cli
