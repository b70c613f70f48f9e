#include "reference/simbody/settings.h"

#include <string>

namespace hookpoint::reference {

SimbodySettings simbody_settings(Settings settings) {
  SimbodySettings result;
  if (settings == Settings::recommended) result.transition_velocity = 1e-3;
  result.penalty = settings == Settings::matched;
  return result;
}

std::vector<SettingRow> simbody_settings_table() {
  const SimbodySettings first = simbody_settings(Settings::default_);
  const SimbodySettings second = simbody_settings(Settings::recommended);
  const SimbodySettings third = simbody_settings(Settings::matched);
  const std::string playground = "simbody examples/ExampleContactPlayground.cpp";
  return {
      {"integrator", "RungeKuttaMerson, steps of its own", "same", "same",
       "CPodes clashes with SUNDIALS (docs/reference_engines.md)"},
      {"accuracy [1]", setting_text(first.accuracy), setting_text(second.accuracy),
       setting_text(third.accuracy), "ours: at the library's 1e-3 a contact at rest chatters"},
      {"contact", "CompliantContactSubsystem: Hertz, Hunt and Crossley", "same",
       "a ContactForceGenerator of ours", playground},
      {"normal stiffness of each surface [Pa]", setting_text(first.stiffness),
       setting_text(second.stiffness), "k [N/m]", playground + ", its floor"},
      {"normal dissipation [s/m]", setting_text(first.dissipation),
       setting_text(second.dissipation), "c [N s/m], linear",
       "ours: at the example's 0.09 a contact at rest rings for seconds"},
      {"transition velocity [m/s]", setting_text(first.transition_velocity),
       setting_text(second.transition_velocity), "none: a damper c_t up to mu N",
       "what getTransitionVelocity() says at first (default); " + playground + " (recommended)"},
      {"friction", "material's, static and kinetic", "same", "kinetic", "ContactSurface.h"},
      {"restitution", "none: the dissipation's", "same", "0: the damper's", "ContactSurface.h"},
  };
}

}  // namespace hookpoint::reference
