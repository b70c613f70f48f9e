// Every constant of every setting of the peers, in one place: the worlds read it, the tables print
// it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reference/engines.h"
#include "simulation/experiment.h"

namespace hookpoint::reference {

enum class Settings { default_, recommended, matched };

/// Names that `settings =` accepts, in the order of the enumeration.
std::vector<std::string> settings_names();
/// The setting of `experiment`. Throws ExperimentError that lists the names.
Settings settings_of(const simulation::Experiment& experiment, std::string_view engine);

enum class OdeSolver { step, quickstep };

struct OdeSettings {
  ConstraintConstants constraint;
  bool tangential_slip =
      false;  ///< the friction rows have their own mixing (dContactSlip1, dContactSlip2)
  bool soft_normal =
      false;  ///< the normal row has its own constants (dContactSoftERP, dContactSoftCFM)
  bool restitution = true;  ///< the material's restitution is passed on (dContactBounce)
  int iterations = 20;      ///< of dWorldQuickStep
};
/// `dt` [s] and `material` enter at `matched` only.
OdeSettings ode_settings(Settings settings, OdeSolver solver, double dt,
                         const contact::MaterialConstants<double>& material);

struct BulletSettings {
  ConstraintConstants constraint;
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

}  // namespace hookpoint::reference
