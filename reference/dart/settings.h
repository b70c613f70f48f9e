// Every constant of DART at every setting: the world is made of them, the table prints them.
#pragma once

#include <vector>

#include "reference/settings.h"

namespace hookpoint::reference {

struct DartSettings {
  ConstraintConstants constraint;
  double correction_speed = 1e-3;  ///< at most, of what pushes a penetration out [m/s]
  bool own_mixing = false;   ///< rows have the mixings of `constraint`, beside DART's relative one
  bool tessellated = false;  ///< spheres and cylinders collide as meshes
  bool restitution = true;   ///< the material's restitution is passed on
};
/// `dt` [s] and `material` enter at `matched` only.
DartSettings dart_settings(Settings settings, double dt,
                           const contact::MaterialConstants<double>& material);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> dart_settings_table();

}  // namespace hookpoint::reference
