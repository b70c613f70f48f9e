#include "reference/mujoco/settings.h"

#include <algorithm>
#include <string>

#include "reference/experiment_checks.h"
#include "reference/mujoco_materials.h"

namespace hookpoint::reference {
MujocoSettings mujoco_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material) {
  MujocoSettings result;
  result.of_file = settings == mujoco_file;
  if (settings == Settings::default_ || result.of_file) return result;
  // The manual's advice where slip matters (Modeling, choice of algorithm): elliptic cones, a large
  // impratio, Newton's method with a tolerance such as 1e-10. The impratio is that of the
  // maintainers' legged robots (MuJoCo Menagerie, unitree_a1/a1.xml).
  result.friction.elliptic = true;
  result.tolerance = 1e-10;
  result.friction.impedance_ratio = 100.;
  if (settings == mujoco_no_slip) result.no_slip_iterations = 10;
  if (settings != Settings::matched) return result;
  result.spring = true;
  result.friction.impedance_ratio =
      (material.tangential_damping + dt * material.tangential_stiffness) /
      (material.normal_damping + dt * material.normal_stiffness);
  return result;
}

MujocoSettings mujoco_settings(const simulation::Experiment& experiment, Settings settings) {
  MujocoSettings result = mujoco_settings(settings, experiment.deltat, ground_material(experiment));
  if (result.of_file) result.friction = mujoco_friction_of(experiment);
  return result;
}

MujocoRow mujoco_row(const MujocoSettings& settings, double dt,
                     const contact::MaterialConstants<double>& material, double inverse_weight) {
  MujocoRow row;
  if (!settings.spring) return row;
  // The spring and damper taken implicitly, f = -k (r + dt (v + dt a)) - c (v + dt a), is a row
  // with R = 1/(dt (c + dt k)), B = 1/dt and K d = k R.
  const double softness = 1. / (dt * (material.normal_damping + dt * material.normal_stiffness));
  const double d =
      std::clamp(inverse_weight / (inverse_weight + softness), contact::mujoco_least_impedance,
                 1. - contact::mujoco_least_impedance);
  row.reference = {-d * material.normal_stiffness * softness, -d / dt};
  row.impedance = {d, d, 0., 0.5, 1.};
  return row;
}

std::vector<SettingRow> mujoco_settings_table() {
  const auto at = [](Settings settings) { return mujoco_settings(settings, 1., {}); };
  const MujocoSettings first = at(Settings::default_), second = at(Settings::recommended);
  const MujocoSettings third = at(Settings::matched), fourth = at(mujoco_no_slip);
  const auto cone = [](const MujocoSettings& settings) {
    return std::string(settings.friction.elliptic ? "elliptic" : "pyramidal");
  };
  const auto number = [](int value) { return std::to_string(value); };
  const MujocoRow row;
  const std::string reference =
      setting_text(row.reference[0]) + ", " + setting_text(row.reference[1]);
  const std::string impedance = setting_text(row.impedance[0]) + ", " +
                                setting_text(row.impedance[1]) + ", " +
                                setting_text(row.impedance[2]);
  const std::string of_materials = "of the Materials";
  const std::string slip = "manual, Modeling, choice of algorithm: what to do against slip";
  return {
      {"solver", "Newton", "same", "same", "XML reference, option"},
      {"integrator", "Euler, semi-implicit", "same", "same", "XML reference, option"},
      {"friction cone", cone(first), cone(second), cone(third), slip, "", of_materials},
      {"impratio [1]", setting_text(first.friction.impedance_ratio),
       setting_text(second.friction.impedance_ratio), "(c_t + dt k_t)/(c + dt k)",
       "Menagerie, unitree_a1/a1.xml (recommended)", "", of_materials},
      {"tolerance [1]", setting_text(first.tolerance), setting_text(second.tolerance),
       setting_text(third.tolerance), slip, "", setting_text(first.tolerance)},
      {"no-slip iterations [1]", number(first.no_slip_iterations),
       number(second.no_slip_iterations), number(third.no_slip_iterations),
       slip + ", its last resort; the number is ours", number(fourth.no_slip_iterations),
       number(first.no_slip_iterations)},
      {"solref", reference, reference, "-d k R, -d/dt; R = 1/(dt (c + dt k))",
       "XML reference, geom; manual, Computation, Constraint model (matched)", "", of_materials},
      {"solimp", impedance, impedance, "d = A/(A + R), constant",
       "as solref; A is the body's inverse weight", "", of_materials},
      {"restitution", "none", "none", "0: the damper's", "MuJoCo has no such coefficient"},
  };
}

}  // namespace hookpoint::reference
