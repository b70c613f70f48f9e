// Every constant of ODE at every setting: the world is made of them, the table prints them.
#pragma once

#include <vector>

#include "reference/settings.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

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

/// The constants of the rows of `solver`, with the experiment's own mixing where it gives one.
ConstraintConstants ode_constraint_constants(const simulation::Experiment& experiment,
                                             Settings settings, OdeSolver solver);

/// Every constant at every setting, as reports print them.
std::vector<SettingRow> ode_settings_table(OdeSolver solver);

}  // namespace hookpoint::reference
