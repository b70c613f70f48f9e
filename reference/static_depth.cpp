#include "reference/static_depth.h"

#include "reference/experiment_checks.h"
#include "reference/settings.h"
#include "simulation/robot_tree.h"

namespace hookpoint::reference {
namespace {

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

std::optional<double> static_softness(const simulation::Experiment& experiment) {
  const Settings settings = settings_of(experiment, experiment.engine);
  if (settings == Settings::matched) {
    if (experiment.engine == "mujoco" && !mujoco_keeps_spring(experiment)) return std::nullopt;
    return 1. / ground_material(experiment).normal_stiffness;
  }
  if (experiment.engine != "ode") return std::nullopt;
  const ConstraintConstants constants = constraint_constants("ode", experiment);
  if (constants.surface_layer > 0.) return std::nullopt;
  return constants.normal_mixing * experiment.deltat / constants.normal_error_reduction;
}

}  // namespace hookpoint::reference
