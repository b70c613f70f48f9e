// Every constant of Simbody at every setting: the world is made of them, the table prints them.
#pragma once

#include <vector>

#include "reference/settings.h"

namespace hookpoint::reference {

struct SimbodySettings {
  double stiffness = 1e7;             ///< plane strain modulus of each of the two surfaces [Pa]
  double dissipation = 2.;            ///< of Hunt and Crossley, of each surface [s/m]
  double transition_velocity = 0.01;  ///< where friction is full [m/s]
  double accuracy = 1e-5;             ///< of the integrator: about the relative error of a step
  bool penalty = false;  ///< contacts are the material's k, c, c_t and mu, without Hertz
};
SimbodySettings simbody_settings(Settings settings);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> simbody_settings_table();

}  // namespace hookpoint::reference
