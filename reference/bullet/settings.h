// Every constant of Bullet at every setting: the world is made of them, the table prints them.
#pragma once

#include <vector>

#include "reference/settings.h"

namespace hookpoint::reference {

struct BulletSettings {
  ConstraintConstants constraint;
  bool multibodies = false;        ///< every body is a btMultiBody, in the world of those
  bool contact_stiffness = false;  ///< stiffness and damping set on the bodies, split impulses off
  bool friction_anchor = false;    ///< friction rows undo the displacement of a sticking contact
  bool restitution = true;         ///< the material's restitution is passed on
  int iterations = 10;             ///< of the sequential impulse solver
  double residual_threshold = 0.;  ///< sum of squared residuals at which it stops early
  double warmstarting = 0.85;      ///< part of the last step's normal impulses to start from
};
/// `dt` [s] and `material` enter at `matched` only.
BulletSettings bullet_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> bullet_settings_table();

}  // namespace hookpoint::reference
