#include "simulation/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "integrators/stepper.h"
#include "simulation/dts_robot.h"
#include "simulation/ground.h"
#include "simulation/joint_loops.h"
#include "simulation/loop_stability.h"
#include "simulation/vibration.h"

namespace hookpoint::simulation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::Matrix3d along_and_across(const Eigen::Vector3d& n, double along, double across) {
  const Eigen::Matrix3d projection = n * n.transpose();
  return along * projection + across * (Eigen::Matrix3d::Identity() - projection);
}

ContactSpring make_spring(const Experiment& experiment, const contact::ForceLaw& law,
                          const ContactPoint& point, double load) {
  const contact::LinearContact linear =
      contact::linearise(law, load, experiment.materials[point.material].constants);
  const Eigen::Vector3d n(point.normal.x, point.normal.y, point.normal.z);
  return {{point.body, point.position},
          along_and_across(n, linear.normal_stiffness, linear.tangential_stiffness),
          along_and_across(n, linear.normal_damping, linear.tangential_damping)};
}

/// Of the points given, each under `load` [N]: the least speed up to which the step resolves their
/// bristles [m/s].
double resolved_speed(const Experiment& experiment, const contact::ForceLaw& law,
                      std::span<const ContactPoint* const> points, double load) {
  const integrators::StepperDescription* stepper = integrators::find_stepper(experiment.integrator);
  double least = infinity;
  if (stepper == nullptr || stepper->adaptive()) return least;
  for (const ContactPoint* point : points) {
    least =
        std::min(least, contact::resolved_speed(law, load, experiment.deltat,
                                                experiment.materials[point->material].constants));
  }
  return least;
}

using Contacts = StabilityBound::Contacts;

StabilityBound bound_of(const Experiment& experiment, const DtsRobot& robot,
                        const std::vector<ContactSpring>& springs,
                        const std::vector<JointLoop>& loops, const std::string& name,
                        Contacts contacts) {
  const Vibration vibration = linear_vibration(robot, springs);
  StabilityBound bound{largest_stable_step(experiment.integrator, vibration, loops),
                       largest_eigenvalue(vibration.stiffness),
                       largest_eigenvalue(vibration.damping), name, contacts};
  for (const JointLoop& loop : loops) {
    if (bound.controllers.empty() || bound.controllers.back() != loop.controller)
      bound.controllers.push_back(loop.controller);
  }
  return bound;
}

double weight(const Experiment& experiment, const RobotSpec& robot) {
  double mass = robot.mobile ? robot.base.mass.mass : 0.;
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links) mass += link.body.mass.mass;
  }
  return mass * norm(experiment.gravity);
}

StabilityBound robot_bound(const Experiment& experiment, std::size_t index,
                           const contact::Terrain* ground, const std::vector<JointLoop>& loops) {
  const contact::ForceLaw law = *contact::find_force_law(experiment.contact);
  const RobotSpec& spec = experiment.robots[index];
  const WorldInputs inputs = initial_inputs(experiment);
  const DtsRobot robot(experiment, static_cast<int>(index), ground, inputs);
  if (ground == nullptr || robot.contact_points().empty())
    return bound_of(experiment, robot, {}, loops, spec.name, Contacts::none);

  std::vector<const ContactPoint*> touching;
  for (const ContactPoint& point : robot.contact_points()) {
    if (point.pending.attached) touching.push_back(&point);
  }
  if (!touching.empty()) {
    std::vector<ContactSpring> springs;
    const double load = weight(experiment, spec) / static_cast<double>(touching.size());
    for (const ContactPoint* point : touching)
      springs.push_back(make_spring(experiment, law, *point, load));
    StabilityBound bound =
        bound_of(experiment, robot, springs, loops, spec.name, Contacts::touching);
    bound.resolved_speed = resolved_speed(experiment, law, touching, load);
    return bound;
  }
  // The point alone decides which is worst; the loops then join it.
  const ContactPoint* worst = &robot.contact_points().front();
  StabilityBound least{infinity, 0., 0., spec.name, Contacts::worst};
  for (const ContactPoint& point : robot.contact_points()) {
    const ContactSpring spring = make_spring(experiment, law, point, weight(experiment, spec));
    const StabilityBound bound =
        bound_of(experiment, robot, {spring}, {}, spec.name, Contacts::worst);
    if (!(bound.step < least.step)) continue;
    least = bound;
    worst = &point;
  }
  if (!loops.empty()) {
    const ContactSpring spring = make_spring(experiment, law, *worst, weight(experiment, spec));
    least = bound_of(experiment, robot, {spring}, loops, spec.name, Contacts::worst);
  }
  const std::array one{worst};
  least.resolved_speed = resolved_speed(experiment, law, one, weight(experiment, spec));
  return least;
}

}  // namespace

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
  const auto ground = make_ground(experiment);
  const WiredControl control = wired_control(experiment);
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    std::vector<JointLoop> loops;
    std::ranges::copy_if(control.loops, std::back_inserter(loops),
                         [&](const JointLoop& loop) { return loop.robot == i; });
    const StabilityBound bound = robot_bound(experiment, i, ground ? &*ground : nullptr, loops);
    if (bound.step < least.step) least = bound;
  }
  least.left_out = control.left_out;
  return least;
}

}  // namespace hookpoint::simulation
