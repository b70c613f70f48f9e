// Every constant of MuJoCo at every setting: the world is made of them, the table prints them.
#pragma once

#include <vector>

#include "contact/mujoco_contact.h"
#include "reference/settings.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

using contact::MujocoRow;

struct MujocoSettings {
  contact::MujocoFriction friction;
  double tolerance = 1e-8;     ///< of Newton's iterations
  int no_slip_iterations = 0;  ///< over the friction rows, after the problem is solved
  bool spring = false;         ///< rows are the material's springs and dampers (mujoco_row)
  bool of_file = false;        ///< rows are those that the materials state (mujoco_row_of)
};
/// `noslip` and `file`, of MuJoCo alone.
constexpr Settings mujoco_no_slip = Settings::own, mujoco_file = Settings::second_own;
/// `dt` [s] and `material` enter at `matched` only; `file` has MuJoCo's defaults here.
MujocoSettings mujoco_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material);
/// Of an experiment: at `file` with the cone and the impratio of its Materials. Throws
/// simulation::ExperimentError where these differ.
MujocoSettings mujoco_settings(const simulation::Experiment& experiment, Settings settings);

/// `inverse_weight`: A [1/kg], > 0.
MujocoRow mujoco_row(const MujocoSettings& settings, double dt,
                     const contact::MaterialConstants<double>& material, double inverse_weight);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> mujoco_settings_table();

}  // namespace hookpoint::reference
