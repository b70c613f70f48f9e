#include "reference/ode/settings.h"

#include <string>

#include "reference/experiment_checks.h"

namespace hookpoint::reference {
namespace {

// ode/objects.h, dWorldSetERP and dWorldSetCFM: the defaults of the double precision library. A
// mixing of 0 makes the matrix of a four-cornered contact singular, so no setting goes there.
constexpr ConstraintConstants ode_defaults{0.2, 1e-10, 0., 1e-10, 0.};

}  // namespace

OdeSettings ode_settings(Settings settings, OdeSolver solver, double dt,
                         const contact::MaterialConstants<double>& material) {
  OdeSettings result;
  result.constraint = ode_defaults;
  if (settings == Settings::default_) return result;
  // QuickStep's 20 iterations leave a resting box creeping at 1e-5 to 1e-4 m/s; with 100 it creeps
  // as dWorldStep does (measured, docs/reference_engines.md).
  if (solver == OdeSolver::quickstep) result.iterations = 100;
  if (settings == Settings::recommended) {
    // ode/objects.h, dWorldSetContactSurfaceLayer: a millimetre, against contacts made and broken.
    result.constraint.surface_layer = 1e-3;
    return result;
  }
  const ImplicitSpring normal = normal_spring(material, dt);
  const ImplicitSpring tangential = tangential_spring(material, dt);
  result.constraint = {normal.error_reduction, normal.mixing, 0., tangential.mixing, 0.};
  result.soft_normal = result.tangential_slip = true;
  result.restitution = false;
  return result;
}

ConstraintConstants ode_constraint_constants(const simulation::Experiment& experiment,
                                             Settings settings, OdeSolver solver) {
  ConstraintConstants constants =
      ode_settings(settings, solver, experiment.deltat, ground_material(experiment)).constraint;
  if (experiment.constraint_mixing && settings != Settings::matched)
    constants.normal_mixing = constants.tangential_mixing = *experiment.constraint_mixing;
  return constants;
}

std::vector<SettingRow> ode_settings_table(OdeSolver solver) {
  const auto at = [solver](Settings settings) { return ode_settings(settings, solver, 1., {}); };
  const OdeSettings first = at(Settings::default_), second = at(Settings::recommended);
  const OdeSettings third = at(Settings::matched);
  std::vector<SettingRow> rows{
      {"solver", solver == OdeSolver::step ? "dWorldStep" : "dWorldQuickStep", "same", "same",
       "ode/objects.h"},
      {"normal ERP [1]", setting_text(first.constraint.normal_error_reduction),
       setting_text(second.constraint.normal_error_reduction), "dt k/(dt k + c)",
       "ode/objects.h (default); ODE manual, How to use ERP and CFM (matched)"},
      {"normal CFM [m/(N s)]", setting_text(first.constraint.normal_mixing),
       setting_text(second.constraint.normal_mixing), "1/(dt k + c)", "as normal ERP"},
      {"friction CFM [m/(N s)]", setting_text(first.constraint.tangential_mixing),
       setting_text(second.constraint.tangential_mixing), "1/(dt k_t + c_t)",
       "world CFM (default); dContactSlip1/2 (matched): friction rows have no position error"},
      {"friction", "dContactApprox1, directions by the library", "same", "same",
       "ODE manual, Contact: without dContactApprox1 mu is a force"},
      {"contact surface layer [m]", setting_text(first.constraint.surface_layer),
       setting_text(second.constraint.surface_layer), setting_text(third.constraint.surface_layer),
       "ode/objects.h, dWorldSetContactSurfaceLayer"},
      {"restitution", "material's", "material's", "0: the damper's", "dContactBounce"},
  };
  if (solver == OdeSolver::quickstep)
    rows.push_back({"iterations", std::to_string(first.iterations),
                    std::to_string(second.iterations), std::to_string(third.iterations),
                    "ode/objects.h, dWorldSetQuickStepNumIterations (default)"});
  return rows;
}

}  // namespace hookpoint::reference
