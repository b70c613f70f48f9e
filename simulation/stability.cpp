#include "simulation/stability.h"

#include <array>
#include <cmath>
#include <limits>

#include "integrators/stepper.h"
#include "simulation/dts_robot.h"
#include "simulation/ground.h"
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

StabilityBound bound_of(const Experiment& experiment, const DtsRobot& robot,
                        const std::vector<ContactSpring>& springs, const std::string& name,
                        bool touching) {
  const Vibration vibration = linear_vibration(robot, springs);
  return {largest_stable_step(experiment.integrator, vibration),
          largest_eigenvalue(vibration.stiffness),
          largest_eigenvalue(vibration.damping),
          name,
          touching,
          infinity};
}

double weight(const Experiment& experiment, const RobotSpec& robot) {
  double mass = robot.mobile ? robot.base.mass.mass : 0.;
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links) mass += link.body.mass.mass;
  }
  return mass * norm(experiment.gravity);
}

StabilityBound robot_bound(const Experiment& experiment, int index,
                           const contact::Terrain& ground) {
  const contact::ForceLaw law = *contact::find_force_law(experiment.contact);
  const RobotSpec& spec = experiment.robots[index];
  const WorldInputs inputs = initial_inputs(experiment);
  const DtsRobot robot(experiment, index, &ground, inputs);

  std::vector<const ContactPoint*> touching;
  for (const ContactPoint& point : robot.contact_points()) {
    if (point.pending.attached) touching.push_back(&point);
  }
  if (!touching.empty()) {
    std::vector<ContactSpring> springs;
    const double load = weight(experiment, spec) / static_cast<double>(touching.size());
    for (const ContactPoint* point : touching)
      springs.push_back(make_spring(experiment, law, *point, load));
    StabilityBound bound = bound_of(experiment, robot, springs, spec.name, true);
    bound.resolved_speed = resolved_speed(experiment, law, touching, load);
    return bound;
  }
  StabilityBound least{infinity, 0., 0., spec.name, false, infinity};
  for (const ContactPoint& point : robot.contact_points()) {
    const ContactSpring spring = make_spring(experiment, law, point, weight(experiment, spec));
    StabilityBound bound = bound_of(experiment, robot, {spring}, spec.name, false);
    const std::array one{&point};
    bound.resolved_speed = resolved_speed(experiment, law, one, weight(experiment, spec));
    if (bound.step < least.step) least = bound;
  }
  return least;
}

}  // namespace

StabilityBound stability_bound(const Experiment& experiment) {
  StabilityBound least{infinity, 0., 0., "", false, infinity};
  const auto ground = make_ground(experiment);
  if (!ground || !contact::find_force_law(experiment.contact) || experiment.engine != "dts")
    return least;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    const StabilityBound bound = robot_bound(experiment, static_cast<int>(i), *ground);
    if (bound.step < least.step) least = bound;
  }
  return least;
}

}  // namespace hookpoint::simulation
