// How a peer is set up, and what a report says of it. The constants themselves are each engine's
// own (NAME/settings.h).
#pragma once

#include <string>
#include <string_view>

#include "contact/vocabulary.h"

namespace hookpoint::reference {

/// What `settings =` chooses.
enum class Settings {
  default_,     ///< the library's first example
  recommended,  ///< what its maintainers do
  matched,      ///< nearest to a material's spring and damper
  own,          ///< one more that the engine has beside these (Peer::own_settings)
  second_own    ///< and another
};

/// A setting that one engine has alone.
struct OwnSetting {
  std::string_view name;  ///< as in `settings = noslip`
  std::string_view doc;   ///< what it is, for the manual
};

/// In place of a value that is the default's.
inline constexpr std::string_view same_as_default = "same";

/// One line of the table that a report prints beside a peer's results.
struct SettingRow {
  std::string quantity;     ///< name and unit
  std::string default_;     ///< value at `settings = default`
  std::string recommended;  ///< value at `settings = recommended`
  std::string matched;      ///< value at `settings = matched`
  std::string source;       ///< where the values come from
  std::string own{};        ///< value at the engine's own setting; empty: as recommended
  std::string second_own{};

  /// The value itself, also where the row has same_as_default.
  const std::string& at(Settings settings) const;
};

/// A number as these tables have it: up to six digits.
std::string setting_text(double value);

/// The softness of an engine's contact rows, J v = ERP error / dt - CFM f for a force f. SI.
struct ConstraintConstants {
  /// ERP of the normal row: the part of the depth beyond `surface_layer` that is undone in a step.
  double normal_error_reduction = 0.;
  /// CFM of the normal row [m/(N s)].
  double normal_mixing = 0.;
  /// ERP of the friction rows; 0: they forget displacement.
  double tangential_error_reduction = 0.;
  /// CFM of a friction row [m/(N s)]: a sticking contact creeps at this times f_t.
  double tangential_mixing = 0.;
  /// Penetration that nothing pushes out [m].
  double surface_layer = 0.;
  /// A mixing of impulses that is a part of each row's own diagonal of J M^-1 J^T [1]: a sticking
  /// contact creeps at this times (J M^-1 J^T)_ii dt f_t.
  double relative_mixing = 0.;
};

/// A spring k and a damper c taken implicitly over a step as a constraint row:
/// ERP = dt k/(dt k + c), CFM = 1/(dt k + c) (ODE manual, "How to use ERP and CFM"; the same
/// expressions are in Bullet's contact rows).
struct ImplicitSpring {
  double error_reduction;  ///< ERP [1]
  double mixing;           ///< CFM [m/(N s)]
};
/// `k` [N/m], `c` [N s/m], `dt` [s]; dt k + c > 0.
inline ImplicitSpring implicit_spring(double k, double c, double dt) {
  return {dt * k / (dt * k + c), 1. / (dt * k + c)};
}
/// Of the material along the ground's normal, and along the ground.
inline ImplicitSpring normal_spring(const contact::MaterialConstants<double>& material, double dt) {
  return implicit_spring(material.normal_stiffness, material.normal_damping, dt);
}
inline ImplicitSpring tangential_spring(const contact::MaterialConstants<double>& material,
                                        double dt) {
  return implicit_spring(material.tangential_stiffness, material.tangential_damping, dt);
}

}  // namespace hookpoint::reference
