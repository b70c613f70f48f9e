#include "simulation/analysis/carried_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "dts/impulse_response.h"
#include "simulation/dts_engine/robot_system.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// How far above its lowest point a robot that does not touch is taken to stand [m].
constexpr double standing_reach = 1e-3;

double greatest_depth(const RobotSystem& robot) {
  double deepest = -HUGE_VAL;
  for (const ContactPoint& point : robot.contacts().points())
    deepest = std::max(deepest, point.depth);
  return deepest;
}

/// 1/(n . K n), K the collision matrix: that of an impact along the normal.
double effective_mass(RobotSystem& robot, const ContactPoint& point) {
  const Matrix3d K =
      dts::collision_matrix(robot.model(), robot.workspace(), {point.body, point.position});
  return 1. / dot(point.normal, K * point.normal);
}

/// Of a point that falls through `gap` from the speed that it has: v^2 + 2 g gap.
double landing_speed(const RobotSystem& robot, const ContactPoint& point, double gap,
                     const Vector3d& gravity) {
  const dts::BodyMotion<double>& body = robot.workspace().bodies[point.body];
  const Vector3d v = body.v_WB + cross(body.w_WB, point.position - body.p_WB);
  const double down = -dot(v, point.normal);
  if (gap == 0.) return std::max(0., down);
  return std::sqrt(std::max(0., down * down - 2. * dot(gravity, point.normal) * gap));
}

}  // namespace

std::vector<CarriedLoad> carried_loads(const Experiment& experiment, std::size_t index,
                                       const contact::Terrain& terrain, const WorldInputs& inputs) {
  RobotSystem robot(experiment, index, &terrain, inputs);
  dts::articulated_inertias(robot.model(), robot.workspace());
  const double deepest = greatest_depth(robot);
  const double least = deepest > 0. ? 0. : deepest - standing_reach;
  std::map<int, CarriedLoad> by_material;
  std::size_t points = 0;
  for (const ContactPoint& point : robot.contacts().points()) {
    if (!(point.depth > least)) continue;
    ++points;
    CarriedLoad& share = by_material[point.material];
    const double effective = effective_mass(robot, point);
    if (share.points == 0 || effective < share.least_mass) {
      share.least_mass = effective;
      share.body = point.body;
      share.foot = point.foot_material;
    }
    share.impact_speed =
        std::max(share.impact_speed,
                 landing_speed(robot, point, std::max(0., -deepest), experiment.gravity));
    ++share.points;
  }
  std::vector<CarriedLoad> loads;
  for (auto& [material, share] : by_material) {
    share.material = material;
    share.mass = moving_mass(experiment.robots[index]) / static_cast<double>(points);
    share.load = share.mass * norm(experiment.gravity);
    loads.push_back(share);
  }
  return loads;
}

void require_ground_alone(const Experiment& experiment, const CarriedLoad& carried,
                          const char* who) {
  if (carried.foot == no_material || carried.foot == carried.material) return;
  const MaterialSpec& foot = experiment.materials[static_cast<std::size_t>(carried.foot)];
  using Constants = contact::MaterialConstants<double>;
  for (const auto constant : {&Constants::normal_stiffness, &Constants::normal_damping,
                              &Constants::tangential_stiffness, &Constants::tangential_damping,
                              &Constants::nominal_stiffness, &Constants::hysteresis_damping}) {
    if (std::ranges::count(foot.unstated, constant) > 0) continue;
    throw ExperimentError(fmt::format(
        "Material {} of the feet states {}: a contact is of both sides, and {} computes the ground's constants "
        "alone; state it on the ground's Material instead (contact = friction or ground of an Include)",
        foot.name, field_of(constant).name, who));
  }
}

}  // namespace hookpoint::simulation
