#include "simulation/analysis/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "integrators/stepper.h"
#include "simulation/analysis/meeting_bodies.h"
#include "simulation/analysis/robots_in_touch.h"
#include "simulation/analysis/stable_step.h"
#include "simulation/analysis/standing.h"
#include "simulation/dts_engine/robot_system.h"
#include "simulation/dts_engine/shape_object.h"
#include "simulation/experiment/ground.h"
#include "simulation/experiment/robot_tree.h"

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

/// The law about the load of a place that carries: a CarryingPoint or a TouchingPlace.
template <class Carrying>
PlaceSpring make_spring(const contact::LawDescription& law, const Carrying& carrying) {
  const auto& material = carrying.material;
  contact::LinearContact linear = law.linearise(carrying.load, material);
  // Without friction nothing sticks.
  if (material.static_friction == 0.) linear.tangential_stiffness = 0.;
  if (material.static_friction == 0.) linear.tangential_damping = material.viscous_friction;
  const Eigen::Vector3d n = eigen(carrying.normal);
  return {along_and_across(n, linear.normal_stiffness, linear.tangential_stiffness),
          along_and_across(n, linear.normal_damping, linear.tangential_damping)};
}

/// The least speed up to which the step resolves the bristles of the points that carry [m/s].
template <class Carrying>
double resolved_speed(const Experiment& experiment, const StepperDescription& stepper,
                      const contact::LawDescription& law, const std::vector<Carrying>& points) {
  double least = infinity, most = 0.;
  if (stepper.adaptive()) return least;
  for (const Carrying& point : points) most = std::max(most, point.load);
  for (const Carrying& point : points) {
    if (point.load < least_share * most) continue;
    least = std::min(least, law.resolved_speed(point.load, experiment.deltat, point.material));
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

Springs springs_of(const contact::LawDescription& law, const Stance& stance) {
  Springs springs{{}, stance.loads};
  for (const CarryingPoint& point : stance.points) {
    const PlaceSpring spring = make_spring(law, point);
    springs.contacts.push_back({point.lever, spring.stiffness, spring.damping});
  }
  return springs;
}

/// Whether the law is stiffer or damps more under a greater load.
bool depends_on_load(const contact::LawDescription& law, const CarryingPoint& point, double load) {
  const auto& material = point.material;
  const contact::LinearContact now = law.linearise(point.load, material);
  const contact::LinearContact then = law.linearise(load, material);
  return then.normal_stiffness > now.normal_stiffness || then.normal_damping > now.normal_damping ||
         then.tangential_damping > now.tangential_damping;
}

/// Where the loads vary, under a law that stiffens with them: each point may carry all alone.
void add_single_points(const contact::LawDescription& law, std::vector<Stance>& stances) {
  for (std::size_t i = 0, count = stances.size(); i < count; ++i) {
    double total = 0.;
    for (const CarryingPoint& point : stances[i].points) total += point.load;
    const std::vector<CarryingPoint> points = stances[i].points;
    for (CarryingPoint alone : points) {
      if (!depends_on_load(law, alone, total)) continue;
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
                           const WiredControl& control, RobotSystem& robot,
                           AnalysisBudget& budget) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  const RobotSpec& spec = experiment.robots[index];
  const auto size = static_cast<double>(robot.dof_count());
  budget.spend(2. * size * size * size);
  const RobotAtRest rest(robot);
  if (rest.size() == 0 || !rest.is_regular()) return {infinity, 0., 0., spec.name};
  if (ground == nullptr || robot.contacts().points().empty())
    return free_bound(experiment, stepper, index, control, robot, budget);
  Stances stances = find_stances(experiment, index, rest, control, budget);
  if (std::ranges::any_of(driven_of(control, index),
                          [](const DrivenJoint& joint) { return !joint.goal; }))
    add_single_points(law, stances.all);

  const Contacts contacts = stances.lands ? Contacts::landing : Contacts::touching;
  StabilityBound least{infinity, 0., 0., spec.name, contacts};
  for (const Stance& stance : stances.all) {
    const Springs springs = springs_of(law, stance);
    const double resolved =
        std::min(least.resolved_speed, resolved_speed(experiment, stepper, law, stance.points));
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

/// Their controllers' loops, in the joints of all of them.
std::vector<JointLoop> loops_of(const WiredControl& control, const RobotsInTouch& group,
                                std::span<const RobotAtRest> rests) {
  std::vector<JointLoop> all;
  std::size_t first = 0;
  for (const std::size_t robot : group.robots) {
    for (JointLoop loop : loops_of(control, robot)) {
      loop.sensed += first;
      loop.driven += first;
      all.push_back(loop);
    }
    first += rests[robot].robot().model().link_count();
  }
  return all;
}

/// Of robots that touch as shapes: all together, or where that takes too long each by itself.
StabilityBound touching_bound(const Experiment& experiment, const StepperDescription& stepper,
                              const RobotsInTouch& group, std::span<const RobotAtRest> rests,
                              const WiredControl& control) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  std::vector<PlaceSpring> springs;
  for (const TouchingPlace& place : group.places) {
    PlaceSpring spring = make_spring(law, place);
    springs.push_back({place.weight * spring.stiffness, place.weight * spring.damping});
  }
  std::vector<std::string> names;
  double size = 0.;
  for (const std::size_t robot : group.robots) {
    if (!rests[robot].is_regular()) return {infinity, 0., 0., experiment.robots[robot].name};
    names.push_back(experiment.robots[robot].name);
    size += static_cast<double>(rests[robot].size());
  }
  try {
    AnalysisBudget budget;
    budget.spend(2. * static_cast<double>(springs.size()) * size * size);
    StabilityBound bound =
        bound_of(stepper, linear_dynamics(group, rests, springs, experiment.gravity),
                 loops_of(control, group, rests), first_of(names), Contacts::touching, budget);
    bound.resolved_speed = resolved_speed(experiment, stepper, law, group.places);
    return bound;
  } catch (const OverBudget&) {
    if (group.robots.size() == 1) throw;
    StabilityBound least{infinity};
    for (const std::size_t robot : group.robots) {
      const StabilityBound part =
          touching_bound(experiment, stepper, alone(group, robot), rests, control);
      if (part.step < least.step) least = part;
    }
    return least;
  }
}

/// Of two bodies when they meet: one spring between them.
StabilityBound meeting_bound(const Experiment& experiment, const StepperDescription& stepper,
                             const Meeting& meeting, AnalysisBudget& budget) {
  const contact::LawDescription& law = *contact::find_force_law(experiment.contact);
  const PlaceSpring spring = make_spring(law, meeting);
  const auto most = [&](const Eigen::Matrix3d& of_place) {
    return Eigen::MatrixXd::Constant(1, 1, meeting.inverse_mass * largest_eigenvalue(of_place));
  };
  std::vector<std::string> names{experiment.robots[meeting.other].name};
  if (meeting.robot != meeting.other) names.push_back(experiment.robots[meeting.robot].name);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(1, 1);
  return bound_of(
      stepper, {most(spring.stiffness), most(spring.damping), Eigen::MatrixXd(0, 1), {none, none}},
      {}, first_of(names), Contacts::meeting, budget);
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
  const contact::Terrain* const below = ground ? &*ground : nullptr;
  std::vector<std::unique_ptr<RobotSystem>> robots;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    robots.push_back(std::make_unique<RobotSystem>(experiment, i, below, inputs));

  std::vector<bool> touches(robots.size());
  const std::vector<RobotsInTouch> groups = robots_in_touch(experiment, below, inputs, robots);
  std::vector<RobotAtRest> rests;
  if (shapes_matter(experiment))
    for (const auto& robot : robots) rests.emplace_back(*robot);
  for (const RobotsInTouch& group : groups) {
    for (const std::size_t robot : group.robots) touches[robot] = true;
    try {
      const StabilityBound bound = touching_bound(experiment, *stepper, group, rests, control);
      if (bound.step < least.step) least = bound;
    } catch (const OverBudget&) {
      return not_computed(experiment, group.robots.front(), *stepper);
    }
  }

  AnalysisBudget budget;
  for (const Meeting& meeting : meeting_bodies(experiment, rests, groups)) {
    const StabilityBound bound = meeting_bound(experiment, *stepper, meeting, budget);
    if (bound.step < least.step) least = bound;
  }
  std::int64_t evaluations = 0;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    try {
      const StabilityBound bound =
          robot_bound(experiment, *stepper, i, below, control, *robots[i], budget);
      evaluations += bound.evaluations;
      // Their contacts are in touching_bound, exactly; here they are points sampled from the shapes.
      if (touches[i] && bound.contacts == Contacts::touching) continue;
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
