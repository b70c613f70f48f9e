#include "simulation/stability.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>

#include "dts/impulse_response.h"
#include "integrators/stability_bound.h"
#include "integrators/stepper.h"
#include "simulation/dts_robot.h"
#include "simulation/ground.h"

namespace hookpoint::simulation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A contact with the square roots of its stiffness and damping along and across the normal.
struct Spring {
  dts::BodyPoint<double> point;
  Eigen::Matrix3d root_stiffness, root_damping;
};

Eigen::Matrix3d along_and_across(const Eigen::Vector3d& n, double along, double across) {
  const Eigen::Matrix3d projection = n * n.transpose();
  return along * projection + across * (Eigen::Matrix3d::Identity() - projection);
}

Spring make_spring(const Experiment& experiment, const contact::ForceLaw& law,
                   const ContactPoint& point, double load) {
  const contact::LinearContact linear =
      contact::linearise(law, load, experiment.materials[point.material].constants);
  const Eigen::Vector3d n(point.normal.x, point.normal.y, point.normal.z);
  return {
      {point.body, point.position},
      along_and_across(n, std::sqrt(linear.normal_stiffness),
                       std::sqrt(linear.tangential_stiffness)),
      along_and_across(n, std::sqrt(linear.normal_damping), std::sqrt(linear.tangential_damping))};
}

Eigen::Matrix3d as_eigen(const Matrix3d& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz).finished();
}

struct Rates {
  double stiffness = 0., damping = 0.;
};

// M^-1 sum J_i^T S_i J_i has the nonzero eigenvalues of the symmetric [sqrt(S_i) J_i M^-1 J_j^T
// sqrt(S_j)]_ij.
Rates largest_rates(DtsRobot& robot, const std::vector<Spring>& springs) {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(springs.size());
  Eigen::MatrixXd stiffness(size, size), damping(size, size);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    for (std::size_t j = 0; j < springs.size(); ++j) {
      const Eigen::Matrix3d response = as_eigen(dts::impulse_response(
          robot.model(), robot.workspace(), springs[j].point, springs[i].point));
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(i),
                         column = 3 * static_cast<Eigen::Index>(j);
      stiffness.block<3, 3>(row, column) =
          springs[i].root_stiffness * response * springs[j].root_stiffness;
      damping.block<3, 3>(row, column) =
          springs[i].root_damping * response * springs[j].root_damping;
    }
  }
  const auto largest = [](const Eigen::MatrixXd& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
  };
  return {largest(stiffness), largest(damping)};
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

StabilityBound bound_of(const Experiment& experiment, const std::string& robot, const Rates& rates,
                        bool touching) {
  const integrators::Mode mode{rates.stiffness, rates.damping, 1.};
  // An adaptive integrator shortens its own steps.
  const double step =
      integrators::largest_stable_step(experiment.integrator, mode).value_or(infinity);
  return {step, rates.stiffness, rates.damping, robot, touching, infinity};
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
  DtsRobot robot(experiment, index, &ground, inputs);
  dts::articulated_inertias(robot.model(), robot.workspace());

  std::vector<const ContactPoint*> touching;
  for (const ContactPoint& point : robot.contact_points()) {
    if (point.pending.attached) touching.push_back(&point);
  }
  if (!touching.empty()) {
    std::vector<Spring> springs;
    const double load = weight(experiment, spec) / static_cast<double>(touching.size());
    for (const ContactPoint* point : touching)
      springs.push_back(make_spring(experiment, law, *point, load));
    StabilityBound bound = bound_of(experiment, spec.name, largest_rates(robot, springs), true);
    bound.resolved_speed = resolved_speed(experiment, law, touching, load);
    return bound;
  }
  StabilityBound least{infinity, 0., 0., spec.name, false, infinity};
  for (const ContactPoint& point : robot.contact_points()) {
    const Spring spring = make_spring(experiment, law, point, weight(experiment, spec));
    StabilityBound bound = bound_of(experiment, spec.name, largest_rates(robot, {spring}), false);
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
