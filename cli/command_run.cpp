#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "contact/force_law.h"
#include "output/csv.h"
#include "output/progress.h"
#include "simulation/records.h"
#include "simulation/stability.h"
#include "simulation/world.h"

namespace hookpoint::cli {
namespace {

using simulation::Experiment;
using simulation::WorldState;

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// The Records of the file, and the rows of trace.csv: the row at time 0, then one a step.
class Recorder {
 public:
  Recorder(const Experiment& experiment, const std::vector<simulation::Port>& all,
           const std::vector<std::string>& trails, const std::filesystem::path& folder,
           const std::string& text)
      : records_(experiment, all, folder, text) {
    if (trails.empty()) return;
    std::vector<output::TraceColumn> columns;
    for (const std::string& trail : trails) {
      ports_.push_back(simulation::find_port(experiment, all, trail));
      columns.push_back({trail, ports_.back().unit});
    }
    values_.resize(ports_.size());
    writer_.emplace(folder / "trace.csv", columns);
  }
  void row(std::int64_t step, double time) {
    records_.row(step, time);
    if (!writer_) return;
    for (std::size_t i = 0; i < ports_.size(); ++i) values_[i] = *ports_[i].value;
    writer_->row(time, values_);
  }
  void close() {
    records_.close();
    if (writer_) writer_->close();
  }

 private:
  simulation::Records records_;
  std::vector<simulation::Port> ports_;
  std::vector<double> values_;
  std::optional<output::TraceWriter> writer_;
};

/// The bar appears only for work that takes a while.
class LazyProgress {
 public:
  LazyProgress(std::string label, std::int64_t steps) : label_(std::move(label)), steps_(steps) {}
  void at(std::int64_t step) {
    if (step % granularity != 0) return;
    if (!bar_ && std::chrono::steady_clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(label_, static_cast<std::size_t>(steps_), static_cast<std::size_t>(step));
    } else if (bar_) {
      bar_->advance(granularity);
    }
  }

 private:
  static constexpr std::int64_t granularity = 1024;
  std::string label_;
  std::int64_t steps_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<output::Progress> bar_;
};

void tell_stability(const Experiment& experiment) {
  const simulation::StabilityBound bound = simulation::stability_bound(experiment);
  if (!std::isfinite(bound.step)) return;
  const std::string scope =
      bound.touching ? "resting on its ground" : "touching with its stiffest point";
  const std::string limit = bound.step > 0. ? fmt::format("{:.4g} s", bound.step)
                                            : "none, without damping it is unstable at any";
  std::cerr << fmt::format("largest stable step of {} for {} {}: {} (deltat is {:.4g} s)\n",
                           experiment.integrator, bound.robot, scope, limit, experiment.deltat);
  if (experiment.deltat > bound.step) {
    std::cerr << "hookpoint: warning: deltat is above the largest stable step: contacts will gain "
                 "energy; make the step smaller, "
                 "the ground softer, or choose another integrator\n";
  }
}

std::string how_computed(const Experiment& experiment) {
  if (experiment.engine != "dts")
    return fmt::format("engine {}, settings {}", experiment.engine, experiment.settings);
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  const bool own_time = law != nullptr && law->is_impulse_law;
  return fmt::format("engine dts, contact {}{}", experiment.contact,
                     own_time ? "" : ", " + experiment.integrator);
}

void print_summary(const Experiment& experiment, const WorldState& state) {
  fmt::print("{} at {} s ({})\n", experiment.world, state.time, how_computed(experiment));
  std::size_t body = 0, joint = 0;
  for (const simulation::RobotSpec& robot : experiment.robots) {
    const simulation::BodyState& base = state.bodies[body++];
    fmt::print(
        "  {:<28} location {:13.6g} {:13.6g} {:13.6g} m   velocity {:13.6g} {:13.6g} {:13.6g} "
        "m/s\n",
        robot.name + ".base", base.position.x, base.position.y, base.position.z, base.velocity.x,
        base.velocity.y, base.velocity.z);
    for (const simulation::ChainSpec& chain : robot.chains) {
      for (const simulation::LinkSpec& link : chain.links) {
        const simulation::JointState& values = state.joints[joint++];
        const bool turns = link.joint == simulation::JointKind::revolute;
        fmt::print("  {:<28} {} {:13.6g} {}   rate {:13.6g} {}\n",
                   robot.name + "." + chain.name + "." + link.body.name,
                   turns ? "angle   " : "travel  ", values.angle, turns ? "rad" : "m  ",
                   values.rate, turns ? "rad/s" : "m/s");
        ++body;
      }
    }
  }
  if (state.impacts > 0) fmt::print("  impacts {}\n", state.impacts);
}

int report_failure(const simulation::StepStatus& status) {
  print_error(
      fmt::format("the run stopped at {:.6g} s: {}: {}", status.time, status.body, status.advice));
  return truth_failed;
}

int step_through(const Experiment& experiment, simulation::World& world, Recorder& recorder) {
  const auto steps =
      static_cast<std::int64_t>(std::llround(experiment.duration / experiment.deltat));
  LazyProgress progress(experiment.world, steps);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  recorder.row(0, 0.);
  std::size_t told = 0;
  const auto tell_notices = [&] {
    for (; told < world.state().notices.size(); ++told)
      std::cerr << "hookpoint: note: " << world.state().notices[told] << '\n';
  };
  for (std::int64_t step = 1; step <= steps && !interrupted && world.ended().empty(); ++step) {
    const simulation::StepStatus status = world.step();
    tell_notices();
    if (!status.ok()) return report_failure(status);
    recorder.row(step, world.state().time);
    progress.at(step);
  }
  if (const std::string reason = world.ended(); !reason.empty())
    std::cerr << fmt::format("hookpoint: note: the run ended at {:.6g} s: {}\n", world.state().time,
                             reason);
  if (!interrupted) return fine;
  print_error(fmt::format("interrupted at {:.6g} s; what was recorded up to then is kept",
                          world.state().time));
  return truth_failed;
}

/// `--for` is the World's duration. What is wrong with the file is told when it is evaluated with
/// these settings.
std::vector<std::string> settings_with_duration(Application& application,
                                                const RunArguments& arguments) {
  std::vector<std::string> settings = arguments.settings;
  if (!arguments.duration) return settings;
  language::Diagnostics untold;
  const auto root = application.library().evaluate(arguments.file, {}, untold);
  if (!root) return settings;
  for (const language::Object* world : root->children_of("World")) {
    settings.push_back(world->name + ".duration=" + *arguments.duration);
  }
  return settings;
}

}  // namespace

int run(const RunArguments& arguments) {
  Application application;
  const std::vector<std::string> settings = settings_with_duration(application, arguments);
  const auto root = application.evaluate(arguments.file, settings);
  if (!root) return wrong_input;
  const auto experiment = application.load(*root);
  if (!experiment) return wrong_input;

  try {
    simulation::World world(*experiment, application.make_engine(*experiment));
    const std::filesystem::path folder =
        arguments.out.value_or(std::filesystem::path("runs") / experiment->world);
    const std::string text = language::print(*root);
    Recorder recorder(*experiment, world.ports(), arguments.record, folder, text);
    tell_stability(*experiment);
    if (arguments.out || !arguments.record.empty() || !experiment->records.empty())
      output::write_file(folder / "experiment.hook", text);
    const int status = step_through(*experiment, world, recorder);
    recorder.close();
    print_summary(*experiment, world.state());
    return status;
  } catch (const simulation::ExperimentError& error) {
    print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
