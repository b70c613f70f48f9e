#include "simulation/analysis/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "integrators/stepper.h"
#include "simulation/analysis/linear_dynamics.h"
#include "simulation/analysis/stable_step.h"
#include "simulation/analysis/standing.h"
#include "simulation/engine/robot_system.h"
#include "simulation/ground.h"
#include "simulation/robot_tree.h"

namespace hookpoint::simulation {
namespace {

using integrators::StepperDescription;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of the greatest load: a point that carries less only touches.
constexpr double least_share = 1e-3;

Eigen::Matrix3d along_and_across(const Eigen::Vector3d& n, double along, double across) {
  const Eigen::Matrix3d projection = n * n.transpose();
  return along * projection + across * (Eigen::Matrix3d::Identity() - projection);
}

ContactSpring make_spring(const Experiment& experiment, const contact::AnyForceLaw& law,
                          const CarryingPoint& carrying) {
  const auto& material = constants_of(experiment, carrying.material);
  contact::LinearContact linear = contact::linearise(law, carrying.load, material);
  // Without friction nothing sticks.
  if (material.static_friction == 0.) linear.tangential_stiffness = 0.;
  if (material.static_friction == 0.) linear.tangential_damping = material.viscous_friction;
  const Eigen::Vector3d n = eigen(carrying.normal);
  return {carrying.lever, along_and_across(n, linear.normal_stiffness, linear.tangential_stiffness),
          along_and_across(n, linear.normal_damping, linear.tangential_damping)};
}

/// The least speed up to which the step resolves the bristles of the points that carry [m/s].
double resolved_speed(const Experiment& experiment, const StepperDescription& stepper,
                      const contact::AnyForceLaw& law, const Stance& stance) {
  double least = infinity, most = 0.;
  if (stepper.adaptive()) return least;
  for (const CarryingPoint& point : stance.points) most = std::max(most, point.load);
  for (const CarryingPoint& point : stance.points) {
    if (point.load < least_share * most) continue;
    least = std::min(least, contact::resolved_speed(law, point.load, experiment.deltat,
                                                    constants_of(experiment, point.material)));
  }
  return least;
}

using Contacts = StabilityBound::Contacts;

struct Springs {
  std::vector<ContactSpring> contacts;
  std::vector<SteadyLoad> loads;
};

/// Multiplications of a largest stable step of `size` coordinates: some 40 tries, each a Cholesky
/// factorisation, or the eigenvalues of a matrix of twice the size, which an unsymmetric QR
/// iteration finds in 10 size^3.
double work_of_step(const StepperDescription& stepper, double size, bool loops) {
  constexpr double tries = 40., eigenvalues = 80.;
  const double cube = size * size * size;
  if (loops || std::holds_alternative<integrators::BoundFromSteps>(stepper.stability))
    return tries * eigenvalues * cube;
  if (std::holds_alternative<integrators::EigenvalueBound>(stepper.stability))
    return eigenvalues * cube;
  return tries / 6. * cube;
}

StabilityBound bound_of(const StepperDescription& stepper, const LinearDynamics& dynamics,
                        std::span<const JointLoop> loops, const std::string& name,
                        Contacts contacts, AnalysisBudget& budget) {
  if (!dynamics.stiffness.allFinite() || !dynamics.damping.allFinite())
    return {infinity, 0., 0., name, contacts};
  const auto size = static_cast<double>(dynamics.stiffness.rows());
  budget.spend(work_of_step(stepper, size, false));
  if (!loops.empty()) budget.spend(work_of_step(stepper, size, true));
  StabilityBound bound{largest_stable_step(stepper, dynamics, loops),
                       std::max(0., largest_eigenvalue(dynamics.stiffness)),
                       std::max(0., largest_eigenvalue(dynamics.damping)), name, contacts};
  bound.without_controllers = loops.empty() ? bound.step : largest_stable_step(stepper, dynamics);
  for (const JointLoop& loop : loops) {
    if (loop.period > 0.) bound.controller_rate = 1. / loop.period;
    if (bound.controllers.empty() || bound.controllers.back() != loop.controller)
      bound.controllers.push_back(loop.controller);
  }
  return bound;
}

Springs springs_of(const Experiment& experiment, const contact::AnyForceLaw& law,
                   const Stance& stance) {
  Springs springs{{}, stance.loads};
  for (const CarryingPoint& point : stance.points)
    springs.contacts.push_back(make_spring(experiment, law, point));
  return springs;
}

/// Whether the law is stiffer or damps more under a greater load.
bool depends_on_load(const Experiment& experiment, const contact::AnyForceLaw& law,
                     const CarryingPoint& point, double load) {
  const auto& material = constants_of(experiment, point.material);
  const contact::LinearContact now = contact::linearise(law, point.load, material);
  const contact::LinearContact then = contact::linearise(law, load, material);
  return then.normal_stiffness > now.normal_stiffness || then.normal_damping > now.normal_damping ||
         then.tangential_damping > now.tangential_damping;
}

/// Where the loads vary, under a law that stiffens with them: each point may carry all alone.
void add_single_points(const Experiment& experiment, const contact::AnyForceLaw& law,
                       std::vector<Stance>& stances) {
  for (std::size_t i = 0, count = stances.size(); i < count; ++i) {
    double total = 0.;
    for (const CarryingPoint& point : stances[i].points) total += point.load;
    const std::vector<CarryingPoint> points = stances[i].points;
    for (CarryingPoint alone : points) {
      if (!depends_on_load(experiment, law, alone, total)) continue;
      alone.load = total;
      stances.push_back({{alone}, {}});
    }
  }
}

/// Of a robot that touches nothing, at its initial posture and at the one in which it hangs still.
StabilityBound free_bound(const Experiment& experiment, const StepperDescription& stepper,
                          std::size_t index, const WiredControl& control, RobotSystem& robot,
                          AnalysisBudget& budget) {
  const RobotSpec& spec = experiment.robots[index];
  const auto at_posture = [&] {
    const RobotAtRest rest(robot);
    // What falls freely feels no weight.
    std::vector<SteadyLoad> loads;
    if (!spec.mobile) loads = rest.weights(experiment.gravity);
    return bound_of(stepper, linear_dynamics(rest, {}, loads), loops_of(control, index), spec.name,
                    Contacts::none, budget);
  };
  const StabilityBound initial = at_posture();
  if (!hang(experiment, index, control, robot, budget)) return initial;
  const StabilityBound hanging = at_posture();
  return hanging.step < initial.step ? hanging : initial;
}

StabilityBound robot_bound(const Experiment& experiment, const StepperDescription& stepper,
                           std::size_t index, const contact::Terrain* ground,
                           const WiredControl& control, const WorldInputs& inputs,
                           AnalysisBudget& budget) {
  const contact::AnyForceLaw law = *contact::find_force_law(experiment.contact);
  const RobotSpec& spec = experiment.robots[index];
  RobotSystem robot(experiment, index, ground, inputs);
  const auto size = static_cast<double>(robot.dof_count());
  budget.spend(2. * size * size * size);
  const RobotAtRest rest(robot);
  if (rest.size() == 0 || !rest.is_regular()) return {infinity, 0., 0., spec.name};
  if (ground == nullptr || robot.contacts().points().empty())
    return free_bound(experiment, stepper, index, control, robot, budget);
  Stances stances = find_stances(experiment, index, rest, control, budget);
  if (std::ranges::any_of(driven_of(control, index),
                          [](const DrivenJoint& joint) { return !joint.goal; }))
    add_single_points(experiment, law, stances.all);

  const Contacts contacts = stances.lands ? Contacts::landing : Contacts::touching;
  StabilityBound least{infinity, 0., 0., spec.name, contacts};
  for (const Stance& stance : stances.all) {
    const Springs springs = springs_of(experiment, law, stance);
    const double resolved =
        std::min(least.resolved_speed, resolved_speed(experiment, stepper, law, stance));
    budget.spend(static_cast<double>(springs.contacts.size()) * 6. * size * size +
                 work_of_step(stepper, size, false));
    // The contacts alone decide which stance is worst; the loops then join it.
    const LinearDynamics dynamics = linear_dynamics(rest, springs.contacts, springs.loads);
    if (&stance == &stances.all.front() ||
        largest_stable_step(stepper, dynamics, {}, least.step) < least.step) {
      least = bound_of(stepper, dynamics, loops_of(control, index), spec.name, contacts, budget);
    }
    least.resolved_speed = resolved;
  }
  least.evaluations = stances.evaluations;
  return least;
}

StabilityBound not_computed(const Experiment& experiment, std::size_t index,
                            const StepperDescription& stepper) {
  const RobotSpec& robot = experiment.robots[index];
  StabilityBound bound{infinity, 0., 0., robot.name};
  bound.not_computed = fmt::format(
      "not computed: robot '{}' has {} joints and {} boundary points, which takes too long under "
      "{}; check the step by halving it",
      robot.name, joint_count(robot), boundary_points(robot).size(), stepper.name);
  return bound;
}

}  // namespace

std::string controller_advice(const StabilityBound& bound) {
  if (bound.controllers.empty() || !(bound.step < bound.without_controllers)) return "";
  std::string who = first_of(bound.controllers);
  if (bound.controller_rate > 0.) who += fmt::format(" (at {:.4g} Hz)", bound.controller_rate);
  if (bound.step > 0.)
    return fmt::format(
        "it is {} that the step is too large for: lower the gains, or make the step "
        "smaller",
        who);
  return fmt::format(
      "{} is unstable however small the step: its gains are too high for its rate "
      "and its delay; raise the rate, shorten the delay, or lower the gains",
      who);
}

std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    text += (i == 0 ? "" : "; ") + names[i];
  if (names.size() > shown) text += "; and " + std::to_string(names.size() - shown) + " more";
  return text;
}

StabilityBound stability_bound(const Experiment& experiment) {
  StabilityBound least{infinity};
  if (!contact::find_force_law(experiment.contact) || experiment.engine != "dts") return least;
  const StepperDescription* stepper = integrators::find_stepper(experiment.integrator);
  if (stepper == nullptr) return least;
  const auto ground = make_ground(experiment);
  const WiredControl control = wired_control(experiment);
  const WorldInputs inputs = initial_inputs(experiment);
  AnalysisBudget budget;
  std::int64_t evaluations = 0;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    try {
      const StabilityBound bound = robot_bound(experiment, *stepper, i, ground ? &*ground : nullptr,
                                               control, inputs, budget);
      evaluations += bound.evaluations;
      if (bound.step < least.step) least = bound;
    } catch (const OverBudget&) {
      return not_computed(experiment, i, *stepper);
    }
  }
  least.evaluations = evaluations;
  least.left_out = control.left_out;
  return least;
}

}  // namespace hookpoint::simulation
