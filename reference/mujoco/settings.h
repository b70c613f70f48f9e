// Every constant of MuJoCo at every setting: the world is made of them, the table prints them.
#pragma once

#include <array>
#include <vector>

#include "reference/settings.h"

namespace hookpoint::reference {

/// MuJoCo takes no impedance below this, nor above 1 less this (mjmodel.h, mjMINIMP, mjMAXIMP).
constexpr double mujoco_least_impedance = 1e-4;

struct MujocoSettings {
  bool elliptic = false;           ///< the cone of friction; else a pyramid inside it
  double friction_impedance = 1.;  ///< R of the normal row over that of a friction row (impratio)
  double tolerance = 1e-8;         ///< of Newton's iterations
  int no_slip_iterations = 0;      ///< over the friction rows, after the problem is solved
  bool spring = false;             ///< rows are the material's springs and dampers (mujoco_row)
};
/// `dt` [s] and `material` enter at `matched` only. Settings::own is `noslip`.
MujocoSettings mujoco_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material);

/// A contact's constants as MuJoCo takes them. Its rows obey a = -B v - K d r - R f, with the
/// acceleration a, speed v, position r (< 0 inside) and force f along the row, and
/// R = (1 - d)/d A, where A is the body's inverse weight (MuJoCo's manual, Computation, Constraint
/// model). Friction rows have no K and R / impratio.
struct MujocoRow {
  /// solref: time constant and damping ratio, or, below 0, -K d^2 and -B d.
  std::array<double, 2> reference{0.02, 1.};
  /// solimp: the impedance d at depth 0 and from the width on, the width [m], midpoint, power.
  std::array<double, 5> impedance{0.9, 0.95, 1e-3, 0.5, 2.};
};
/// `inverse_weight`: A [1/kg], > 0.
MujocoRow mujoco_row(const MujocoSettings& settings, double dt,
                     const contact::MaterialConstants<double>& material, double inverse_weight);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> mujoco_settings_table();

}  // namespace hookpoint::reference
