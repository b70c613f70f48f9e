#include "reference/dart/settings.h"

#include <limits>
#include <string>

namespace hookpoint::reference {
namespace {

// dart/constraint/ContactConstraint.hpp: what its getters say at first, an ERP of 0.01, no faster
// than 1 mm/s, and a CFM of 1e-5 of each row's own diagonal.
constexpr ConstraintConstants dart_defaults{0.01, 0., 0., 0., 0., 1e-5};

}  // namespace

DartSettings dart_settings(Settings settings, double dt,
                           const contact::MaterialConstants<double>& material) {
  DartSettings result;
  result.constraint = dart_defaults;
  // FCLCollisionDetector.hpp, PrimitiveShape, recommends meshes until FCL finds all contacts of
  // primitives. A detector starts with them too; at `default` they are off all the same, because a
  // ball that is a mesh of 16 sides does not roll.
  result.tessellated = settings == Settings::recommended;
  if (settings != Settings::matched) return result;
  const ImplicitSpring normal = normal_spring(material, dt);
  const ImplicitSpring tangential = tangential_spring(material, dt);
  constexpr double least_relative_mixing = 1e-9;  // ContactConstraint.hpp
  result.constraint = {normal.error_reduction, normal.mixing, 0., tangential.mixing, 0.,
                       least_relative_mixing};
  result.correction_speed = std::numeric_limits<double>::max();
  result.own_mixing = true;
  result.restitution = false;
  return result;
}

std::vector<SettingRow> dart_settings_table() {
  const auto at = [](Settings settings) { return dart_settings(settings, 1., {}); };
  const DartSettings first = at(Settings::default_), second = at(Settings::recommended);
  const DartSettings third = at(Settings::matched);
  const std::string contact = "dart/constraint/ContactConstraint.hpp";
  return {
      {"solver", "boxed LCP: Dantzig, then Gauss-Seidel", "same", "same",
       "dart/constraint/BoxedLcpConstraintSolver.hpp"},
      {"spheres and cylinders collide", "as such", "as meshes", "as such",
       "FCLCollisionDetector.hpp recommends meshes (recommended), and has them by itself"},
      {"normal ERP [1]", setting_text(first.constraint.normal_error_reduction),
       setting_text(second.constraint.normal_error_reduction), "dt k/(dt k + c)",
       contact + " (default); ODE manual, How to use ERP and CFM (matched)"},
      {"error reduction speed, at most [m/s]", setting_text(first.correction_speed),
       setting_text(second.correction_speed), "none", contact},
      {"CFM, part of each row's diagonal [1]", setting_text(first.constraint.relative_mixing),
       setting_text(second.constraint.relative_mixing),
       setting_text(third.constraint.relative_mixing), contact},
      {"normal CFM [m/(N s)]", setting_text(first.constraint.normal_mixing),
       setting_text(second.constraint.normal_mixing), "1/(dt k + c)",
       "a BoxedLcpSolver of ours before the library's (matched)"},
      {"friction CFM [m/(N s)]", setting_text(first.constraint.tangential_mixing),
       setting_text(second.constraint.tangential_mixing), "1/(dt k_t + c_t)", "as normal CFM"},
      {"friction directions", "horizontal, and along the fall", "same", "same",
       "DART_DEFAULT_FRICTION_DIR, the world's z"},
      {"restitution", "material's", "material's", "0: the damper's",
       "dart/dynamics/ShapeFrame.hpp"},
  };
}

}  // namespace hookpoint::reference
