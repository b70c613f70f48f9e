// The step of Reichler & Delcomyn 2000, section 3, for one robot:
//
//   M(q) v' + c(q, v) = tau + sum_i J_i(q)^T f_i + (external forces)        equations of motion
//   q' = v (on the manifold of orientations)
//   (f_i, h_i+) = law(x_i, x_i', h_i)        the ground at boundary point i, h_i what it remembers
//
// The state that a run has accepted at t is (q, v, h) with the kinematics and forces that belong to
// it. From there a step leads to t + dt. Around it World (run/world.h) lets wires deliver, due
// controllers update and actuators set tau before, and sensors and records look after it.
#include "simulation/dts_engine/step.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/adaptive.h"

namespace hookpoint::simulation {
namespace {

StepStatus explain(integrators::Status status, const integrators::Stepper& stepper, double time,
                   const SteppedSystem& robot);

}  // namespace

std::string too_many_unknowns(std::size_t unknowns, std::size_t bristles) {
  return fmt::format(
      "the integrator solves equations with {} unknowns, {} of them bristles of contact points "
      "that "
      "touch, which takes too long: give shapes fewer boundary_points, or choose arkode or a "
      "fixed-step integrator",
      unknowns, bristles);
}

StepStatus step(SteppedSystem& robot, integrators::Stepper& stepper, double time) {
  const double dt = robot.deltat();

  // tau and the external forces: what the wires delivered, held over the step (docs/wires.md).
  robot.take_inputs();

  // (q, v) at t, which a step that fails goes back to.
  robot.begin_step(time, dt);

  // h := h+: hooks, bristles and dry friction as the accepted state has made them. Every force of
  // the step, at however many trial states, is computed from these (docs/decisions/0001).
  robot.commit_memory();

  // (q, v) at t + dt from q' = v, v' = M^-1 (...), by the method of integrators/, which asks
  // RobotSystem::accelerations for v' as often as it wants and refuses what is not finite (3.5):
  //   X_WB, v_WB of every body, base to tips; external forces; f_i at each boundary point
  //   (RobotSystem::evaluate_forces), then tau and the other passes of the recursion (Fig. 3); by the
  //   default method once more for each iteration that brings c to the mean velocity, the f_i held.
  const integrators::Status status =
      stepper.step(robot, time, dt, robot.positions(), robot.velocities());
  if (status != integrators::Status::ok) {
    robot.undo();
    return explain(status, stepper, time, robot);
  }

  // x_i, x_i', f_i and h_i+ at t + dt: what is published, and what the next step commits.
  robot.finish_step();
  return {};
}

namespace {

/// Why an adaptive integrator did not end its step within its budget, and what to change.
std::string over_budget(const integrators::Spending& spent) {
  using integrators::most_evaluations;
  if (spent.too_many_unknowns) return too_many_unknowns(spent.unknowns, spent.states);
  if (spent.evaluations <= most_evaluations && spent.factorisations > 0)
    return fmt::format(
        "this step has taken {} evaluations and {} factorisations of a Jacobian of {} unknowns and "
        "is not over: give shapes fewer boundary_points, raise relative_tolerance and "
        "absolute_tolerance, make deltat smaller, or choose arkode or a fixed-step integrator",
        spent.evaluations, spent.factorisations, spent.unknowns);
  return fmt::format(
      "this step has taken {} evaluations and is not over: raise relative_tolerance and "
      "absolute_tolerance, bring the constants of ground and joints nearer to each other, make "
      "deltat smaller, or choose a fixed-step integrator",
      std::min(spent.evaluations, most_evaluations));
}

StepStatus explain(integrators::Status status, const integrators::Stepper& stepper, double time,
                   const SteppedSystem& robot) {
  std::string body = robot.trail();
  if (status == integrators::Status::too_long) {
    const auto& adaptive = dynamic_cast<const integrators::AdaptiveStepper&>(stepper);
    return {StepStatus::Kind::solver_failed, time, std::move(body),
            over_budget(adaptive.spending())};
  }
  if (status == integrators::Status::no_step) {
    return {StepStatus::Kind::solver_failed, time, std::move(body),
            "the integrator finds no step that meets its tolerances: raise relative_tolerance and "
            "absolute_tolerance, make the ground softer, or choose a fixed-step integrator"};
  }
  if (status == integrators::Status::turns_too_far) {
    return {StepStatus::Kind::step_too_large, time, std::move(body),
            fmt::format("it turns too far in a step for its gyroscopic, centrifugal and Coriolis "
                        "forces to be found (by {:.3g} rad at the step's start): make the step "
                        "smaller, or choose rk4 or an adaptive integrator",
                        robot.deltat() * robot.greatest_angular_speed()),
            true};
  }
  return {StepStatus::Kind::not_finite, time, std::move(body),
          "its accelerations are no longer finite: make the step smaller or the ground softer",
          true};
}

}  // namespace

}  // namespace hookpoint::simulation
