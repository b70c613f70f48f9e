#include "apps/shared/engine_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "contact/terrain/rolling.h"
#include "reference/experiment_checks.h"
#include "reference/process/engine.h"
#include "reference/process/experiment_json.h"
#include "reference/process/program.h"
#include "simulation/dts_engine/dts_engine.h"

namespace hookpoint::application {
namespace {

using reference::Program;
using reference::ProgramDefinition;
using simulation::Experiment;
using Verdict = EngineFinding::Verdict;

constexpr double g = 9.81, step = 1e-3;
constexpr double mass = 2., radius = 0.1, inertia = 0.4 * mass * radius * radius;

/// What one check comes to.
struct Outcome {
  Verdict verdict;
  std::string text;
};

Outcome judge(bool right, std::string text) {
  return {right ? Verdict::passed : Verdict::failed, std::move(text)};
}
/// Of an error that may be `most`.
Outcome judge(double error, double most, const char* what) {
  return judge(error <= most, fmt::format("{}: {:.2g}, at most {:.2g}", what, error, most));
}

simulation::RobotSpec ball(const Vector3d& location) {
  simulation::RobotSpec robot;
  robot.name = "ball";
  robot.mobile = true;
  robot.base.name = "base";
  robot.base.mass = {mass, {}, {inertia, inertia, inertia, 0., 0., 0.}};
  robot.base.shapes.emplace_back().geometry = simulation::Sphere{radius};
  robot.location = location;
  return robot;
}

Experiment world(simulation::RobotSpec robot) {
  Experiment experiment;
  experiment.world = "w";
  experiment.deltat = step;
  experiment.robots.push_back(std::move(robot));
  return experiment;
}

Experiment weightless(simulation::RobotSpec robot) {
  Experiment experiment = world(std::move(robot));
  experiment.gravity = {};
  return experiment;
}

/// A ball 5 mm over the ground.
Experiment over_ground() {
  Experiment experiment = world(ball({0., 0., radius + 5e-3}));
  experiment.materials.emplace_back().name = "ground";
  experiment.terrain.emplace().name = "ground";
  return experiment;
}

/// A base with two links, their axes askew, at rest and under torques. At rest, since an engine whose
/// joints are constraints has no centripetal accelerations within a step.
Experiment chain() {
  simulation::RobotSpec robot = ball({0., 0., 1.});
  robot.base.shapes.clear();
  simulation::ChainSpec& arm = robot.chains.emplace_back();
  arm.name = "arm";
  arm.hip_distance = {0.1, 0., 0.05};
  for (const double angle : {0.3, -0.5}) {
    simulation::LinkSpec& link = arm.links.emplace_back();
    link.body.name = arm.links.size() == 1 ? "upper" : "lower";
    link.body.mass = {0.5, {0.1, 0.02, 0.}, {2e-4, 1e-3, 1e-3, 1e-5, 0., 0.}};
    link.a = arm.links.size() == 1 ? 0. : 0.25;
    link.alpha = 0.4;
    link.angle = angle;
    link.torque = 0.2 - angle;
  }
  Experiment experiment = world(std::move(robot));
  // In single precision bodies stand to 1e-7 m, and a step closes the gaps of that size: a long step does
  // so slowly.
  experiment.deltat = 10. * step;
  experiment.integrator = "explicit_euler";  // ours: the accelerations of the start
  return experiment;
}

class EngineCheck {
 public:
  explicit EngineCheck(ProgramDefinition definition)
      : definition_(std::move(definition)), program_(definition_) {
    definition_.settings = program_.hello().settings;
    if (definition_.name.empty()) definition_.name = program_.hello().name;
    engine_.emplace(definition_);
  }

  std::vector<EngineFinding> run() {
    const std::vector<std::pair<const char*, Outcome (EngineCheck::*)()>> checks{
        {"hello", &EngineCheck::hello},
        {"errors", &EngineCheck::errors},
        {"free fall", &EngineCheck::free_fall},
        {"external forces", &EngineCheck::external_forces},
        {"torques", &EngineCheck::torques},
        {"quaternion order", &EngineCheck::quaternion_order},
        {"units of angles", &EngineCheck::units_of_angles},
        {"joint accelerations", &EngineCheck::joint_accelerations},
        {"contact forces", &EngineCheck::contact_forces},
        {"rest on the ground", &EngineCheck::rest},
        {"the same bytes again", &EngineCheck::again},
        {"reset", &EngineCheck::reset},
        {"several steps at once", &EngineCheck::several_steps},
        {"speed", &EngineCheck::speed},
    };
    std::vector<EngineFinding> findings;
    for (const auto& [name, check] : checks) {
      try {
        Outcome outcome = (this->*check)();
        findings.push_back({name, outcome.verdict, std::move(outcome.text)});
      } catch (const simulation::ExperimentError& error) {
        findings.push_back({name, Verdict::failed, error.what()});
      } catch (const reference::ProgramError& error) {
        findings.push_back({name, Verdict::failed, error.what()});
        program_ = Program(definition_);
      }
    }
    return findings;
  }

 private:
  bool is_single() const { return program_.hello().precision == "single"; }
  double precision(double of_double, double of_single) const {
    return is_single() ? of_single : of_double;
  }
  const simulation::EngineGap* gap(std::string_view feature) const {
    for (const simulation::EngineGap& gap : program_.hello().gaps)
      if (gap.feature == feature) return &gap;
    return nullptr;
  }
  Outcome not_supported(const simulation::EngineGap& gap) const {
    return {Verdict::not_supported, gap.feature + ": " + gap.instead};
  }

  std::unique_ptr<simulation::Engine> make(Experiment experiment, const std::string& settings) {
    experiment.settings = settings;
    return engine_->make(experiment);
  }
  std::unique_ptr<simulation::Engine> make(const Experiment& experiment) {
    return make(experiment, definition_.settings.front());
  }
  /// Throws ExperimentError where a step fails.
  static void advance(simulation::Engine& engine, int steps) {
    for (int i = 0; i < steps; ++i)
      if (const simulation::StepStatus status = engine.step(); !status.ok())
        throw simulation::ExperimentError(status.advice);
  }

  Outcome hello() {
    const auto& hello = program_.hello();
    std::string unknown;
    for (const simulation::EngineGap& gap : hello.gaps)
      if (gap.handling != simulation::EngineGap::Handling::stated &&
          std::ranges::find(reference::feature::all, gap.feature) == reference::feature::all.end())
        unknown += (unknown.empty() ? "" : ", ") + gap.feature;
    return judge(unknown.empty(),
                 unknown.empty() ? fmt::format("{} {}, {} precision, {} gaps", hello.name,
                                               hello.version, hello.precision, hello.gaps.size())
                                 : "gaps that are no features of an experiment: " + unknown);
  }

  Outcome errors() {
    Experiment experiment = world(ball({0., 0., 1.}));
    experiment.settings = "of no engine";
    const text::JsonValue answer = program_.request(reference::experiment_json(experiment));
    const text::JsonValue* type = answer.member("type");
    const text::JsonValue* reason = answer.member("reason");
    const bool refused = type != nullptr && type->text() == "refused" && reason != nullptr &&
                         !reason->text().empty();
    return judge(refused, "settings that it does not have: " +
                              (refused ? "refused, " + reason->text()
                                       : std::string("not refused with a reason")));
  }

  Outcome free_fall() {
    constexpr int steps = 100;
    constexpr double time = steps * step, start = 1.;
    const auto engine = make(world(ball({0., 0., start})));
    advance(*engine, steps);
    const simulation::BodyState& body = engine->state().bodies[0];
    const double speed = std::abs(body.velocity.z + g * time) / (g * time);
    const double place = std::abs(body.position.z - (start - 0.5 * g * time * time));
    // A method of first order is late by g t dt/2.
    constexpr double first_order = 0.51 * g * time * step;
    if (place > first_order) return judge(place, first_order, "error of the height [m]");
    return judge(speed, precision(1e-9, 1e-5), "relative error of the speed");
  }

  Outcome external_forces() {
    Experiment experiment = weightless(ball({0.3, -0.2, 1.}));
    const Vector3d force{1., -2., 3.};
    experiment.forces.emplace_back().force = force;
    constexpr int steps = 20;
    const auto engine = make(experiment);
    advance(*engine, steps);
    const Vector3d expected = (steps * step / mass) * force;
    return judge(norm(engine->state().bodies[0].velocity - expected) / norm(expected),
                 precision(1e-9, 1e-5), "relative error of the velocity");
  }

  Outcome torques() {
    if (const auto* lacking = gap("rotation")) return not_supported(*lacking);
    Experiment experiment = weightless(ball({}));
    const Vector3d point{0.05, 0., 0.}, force{0., 0.2, 0.}, torque{0.01, 0., 0.};
    simulation::ForceSpec& turn = experiment.forces.emplace_back();
    turn.point = point;
    turn.force = force;
    turn.torque = torque;
    const auto engine = make(experiment);
    advance(*engine, 1);
    const Vector3d expected = (step / inertia) * (torque + cross(point, force));
    return judge(norm(engine->state().bodies[0].angular_velocity - expected) / norm(expected),
                 precision(1e-6, 1e-3), "relative error of the spin after a step");
  }

  /// The ball's turn in `steps` steps at 1 rad/s about z, world axes [rad].
  Vector3d turn(int steps) {
    simulation::RobotSpec robot = ball({});
    const Quaterniond start = exponential(Vector3d{0.5 * std::numbers::pi, 0., 0.});
    robot.orientation = start;
    robot.angular_velocity = {0., 0., 1.};
    const auto engine = make(weightless(robot));
    advance(*engine, steps);
    return contact::rotation_vector(engine->state().bodies[0].orientation * conjugate(start));
  }
  Outcome quaternion_order() {
    if (const auto* lacking = gap("rotation")) return not_supported(*lacking);
    // Whatever its rate, in a step it turns little.
    if (const double turned = norm(turn(1)); turned > 0.1)
      return judge(turned, 0.1, "turn in one step of a body at 1 rad/s [rad]");
    const Vector3d turned = turn(100);
    constexpr double most = 0.05;
    return judge(norm(turned - Vector3d{0., 0., norm(turned)}), most * norm(turned),
                 "part of the turn of a body that spins about z that is about other axes [rad]");
  }
  Outcome units_of_angles() {
    if (const auto* lacking = gap("rotation")) return not_supported(*lacking);
    constexpr int steps = 100;
    return judge(std::abs(norm(turn(steps)) - steps * step), 2e-3,
                 "error of the turn after 0.1 s at 1 rad/s [rad]");
  }

  Outcome joint_accelerations() {
    if (const auto* lacking = gap(reference::feature::chains)) return not_supported(*lacking);
    const Experiment experiment = chain();
    const auto ours = simulation::make_dts(experiment);
    advance(*ours, 1);
    // Where an iteration holds the joints together, some of its settings may end it early.
    double best = std::numeric_limits<double>::infinity(), first = best;
    std::string best_settings;
    for (const std::string& settings : definition_.settings) {
      const auto theirs = make(experiment, settings);
      advance(*theirs, 1);
      double error = 0., largest = 0.;
      for (std::size_t i = 0; i < ours->state().joints.size(); ++i) {
        const double expected = ours->state().joints[i].acceleration;
        error = std::max(error, std::abs(theirs->state().joints[i].acceleration - expected));
        largest = std::max(largest, std::abs(expected));
      }
      if (best_settings.empty()) first = error / largest;
      if (error / largest < best) {
        best = error / largest;
        best_settings = settings;
      }
    }
    const double most = precision(1e-8, 1e-3);
    return judge(
        best <= most,
        fmt::format("relative error of two joints: {:.2g} at settings {}, {:.2g} at {}; at "
                    "most {:.2g} at one of them",
                    first, definition_.settings.front(), best, best_settings, most));
  }

  Outcome contact_forces() {
    const auto engine = make(over_ground());
    double worst = 0., most = 0.;
    constexpr int steps = 300;
    for (int i = 0; i < steps; ++i) {
      const Vector3d before = engine->state().bodies[0].velocity;
      advance(*engine, 1);
      const simulation::BodyState& body = engine->state().bodies[0];
      const Vector3d needed = (mass / step) * (body.velocity - before) + Vector3d{0., 0., mass * g};
      worst = std::max(worst, norm(needed - body.contact_force));
      most = std::max(most, norm(needed));
    }
    if (most < mass * g) return judge(false, "the ball meets no ground");
    return judge(
        worst / most, precision(1e-6, 1e-3),
        "greatest difference between the published force and that which the momentum needs, by "
        "the greatest force");
  }

  Outcome rest() {
    const auto engine = make(over_ground());
    constexpr int settle = 3000, steps = 200;
    advance(*engine, settle);
    double load = 0.;
    for (int i = 0; i < steps; ++i) {
      advance(*engine, 1);
      load += engine->state().bodies[0].contact_force.z / steps;
    }
    const double depth = radius - engine->state().bodies[0].position.z;
    if (std::abs(depth) > 0.5 * radius)
      return judge(std::abs(depth), 0.5 * radius, "depth of a ball at rest [m]");
    return judge(std::abs(load / (mass * g) - 1.), 0.01,
                 "relative error of the load of a ball at rest");
  }

  /// All states of a run.
  std::vector<double> states(const std::string& start, int exchanges, int steps_each) {
    const text::JsonValue ready = program_.request(start);
    const text::JsonValue* type = ready.member("type");
    if (type == nullptr || type->text() != "ready")
      throw reference::ProgramError("the program does not answer ready");
    std::vector<double> all;
    const std::array<double, 1> inputs{static_cast<double>(steps_each)};
    for (int i = 0; i < exchanges; ++i) {
      const auto answer = program_.step(inputs);
      if (const auto* failed = std::get_if<std::string>(&answer))
        throw reference::ProgramError(*failed);
      const auto& numbers = std::get<std::vector<double>>(answer);
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    return all;
  }
  std::string landing() const {
    Experiment experiment = over_ground();
    experiment.settings = definition_.settings.front();
    return reference::experiment_json(experiment);
  }
  static Outcome same(const std::vector<double>& a, const std::vector<double>& b) {
    return judge(a == b, a == b ? "200 steps of a landing ball" : "a landing ball moves otherwise");
  }
  Outcome again() { return same(states(landing(), 200, 1), states(landing(), 200, 1)); }
  Outcome reset() {
    return same(states(landing(), 200, 1), states(R"({"type": "reset"})", 200, 1));
  }
  Outcome several_steps() { return same(states(landing(), 200, 1), states(landing(), 10, 20)); }

  Outcome speed() {
    using Clock = std::chrono::steady_clock;
    const auto of_step = [&](int exchanges, int steps_each) {
      const auto start = Clock::now();
      states(landing(), exchanges, steps_each);
      return std::chrono::duration<double, std::micro>(Clock::now() - start).count() /
             (exchanges * steps_each);
    };
    const double single = of_step(1000, 1), hundred = of_step(10, 100);
    return {Verdict::passed,
            fmt::format("{:.3g} us a step with one step an exchange, {:.3g} us with "
                        "100, of one ball",
                        single, hundred)};
  }

  ProgramDefinition definition_;
  Program program_;
  std::optional<reference::ProgramEngine> engine_;
};

}  // namespace

std::vector<EngineFinding> check_engine(ProgramDefinition definition) {
  try {
    return EngineCheck(std::move(definition)).run();
  } catch (const reference::ProgramError& error) {
    return {{"hello", Verdict::failed, error.what()}};
  }
}

}  // namespace hookpoint::application
