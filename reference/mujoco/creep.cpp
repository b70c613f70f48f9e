#include "reference/mujoco/creep.h"

#include <algorithm>
#include <cmath>

#include "reference/mujoco/contact_at_rest.h"
#include "reference/mujoco/engine.h"
#include "reference/mujoco/friction.h"
#include "reference/mujoco/settings.h"
#include "reference/mujoco_materials.h"
#include "reference/resting_body.h"
#include "reference/static_depth.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {
namespace {

/// Least and largest normal load, under the moment of the friction.
void spread(const RestingBody& body, const Vector3d& loads, MujocoLoad& load) {
  for (const Vector3d& arm : body.arms) {
    const double part = load_at(body, loads, arm) / load.normal;
    load.least = std::min(load.least, part);
    load.largest = std::max(load.largest, part);
  }
}

simulation::ClosedForm<MujocoLoad> load_at_rest(const simulation::Experiment& experiment) {
  const auto body = resting_body(experiment);
  const double friction = single_friction(ground_material(experiment));
  if (!body) return body.none();
  if (!(body->press > 0.))
    return simulation::NoClosedForm{"nothing presses the body on its ground"};
  if (!(friction > 0.)) return simulation::NoClosedForm{"the ground has no friction"};
  const auto loads = normal_loads(*body, body->pull);
  if (!loads) return loads.none();
  MujocoLoad load;
  const auto count = static_cast<double>(body->arms.size());
  load.inverse_weight = 1. / body->mass->mass;
  load.normal = body->press / count;
  load.tangential = body->pull / count;
  load.friction = friction;
  const auto [first, second] = mujoco_tangents(body->normal);
  load.along = std::abs(dot(body->downhill, first));
  load.across = std::abs(dot(body->downhill, second));
  load.turned = dot(body->downhill, first) * dot(body->downhill, second);
  spread(*body, *loads, load);
  return load;
}

double mass_of(const simulation::Experiment& experiment) {
  double mass = 0.;
  for (const simulation::RobotSpec& robot : experiment.robots)
    mass += simulation::robot_mass(robot);
  return mass;
}

/// Whether MuJoCo keeps to the spring: its rows' softness against the inverse weight of a contact,
/// which is that of all mass at least.
bool mujoco_keeps_spring(const simulation::Experiment& experiment) {
  const auto material = ground_material(experiment);
  const MujocoSettings settings = mujoco_settings(Settings::matched, experiment.deltat, material);
  const double softness =
      1. / (experiment.deltat *
            (material.normal_damping + experiment.deltat * material.normal_stiffness));
  const double inverse_weight = 1. / mass_of(experiment);
  const MujocoRow row = mujoco_row(settings, experiment.deltat, material, inverse_weight);
  return row.impedance[0] == inverse_weight / (inverse_weight + softness);
}

}  // namespace

simulation::ClosedForm<simulation::CreepVelocity> mujoco_creep(
    const simulation::Experiment& experiment) {
  const auto load = load_at_rest(experiment);
  if (!load) return load.none();
  const MujocoSettings settings = mujoco_settings(experiment, settings_of(experiment, mujoco_peer));
  if (settings.no_slip_iterations > 0)
    return simulation::NoClosedForm{"MuJoCo's no-slip iterations end before they converge"};
  const MujocoRow row =
      settings.of_file
          ? mujoco_row_of(experiment, sole_foot_material(experiment), experiment.terrain->material)
          : mujoco_row(settings, experiment.deltat, ground_material(experiment),
                       load->inverse_weight);
  const auto rest = mujoco_rest(*load, settings, row, experiment.deltat);
  if (!rest) return rest.none();
  return rest->velocity;
}

simulation::ClosedForm<double> mujoco_softness(const simulation::Experiment& experiment) {
  if (settings_of(experiment, mujoco_peer) == Settings::matched && !mujoco_keeps_spring(experiment))
    return simulation::NoClosedForm{
        "MuJoCo's impedance is cut off at a bound: its contact is softer than the material"};
  return matched_softness(experiment);
}

}  // namespace hookpoint::reference
