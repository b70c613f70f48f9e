#include "reference/bullet/settings.h"

#include <string>

namespace hookpoint::reference {
namespace {

// btContactSolverInfo.h: m_erp2, m_globalCfm, m_frictionERP (used with anchors only),
// m_frictionCFM.
constexpr ConstraintConstants bullet_defaults{0.2, 0., 0., 0., 0.};

}  // namespace

BulletSettings bullet_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material) {
  BulletSettings result;
  result.constraint = bullet_defaults;
  if (settings == Settings::default_) return result;
  // The maintainers' set-up for robotics (PyBullet's server, createEmptyDynamicsWorld in
  // examples/SharedMemory/PhysicsServerCommandProcessor.cpp).
  result.iterations = 50;
  if (settings == Settings::recommended) {
    result.multibodies = true;
    result.constraint.normal_error_reduction = 0.08;
    result.residual_threshold = 1e-7;
    result.constraint.surface_layer = 1e-5;
    result.warmstarting = 0.1;
    return result;
  }
  const ImplicitSpring normal = normal_spring(material, dt);
  const ImplicitSpring tangential = tangential_spring(material, dt);
  // The friction anchor is the nearest thing to a hook, with the spring's ERP but no compliance:
  // m_frictionCFM enters a row without being divided by the step or scaled by the effective mass,
  // so no value of it is 1/(dt k_t + c_t).
  result.constraint = {normal.error_reduction, normal.mixing, tangential.error_reduction, 0., 0.};
  result.contact_stiffness = result.friction_anchor = true;
  result.restitution = false;
  return result;
}

std::vector<SettingRow> bullet_settings_table() {
  const auto at = [](Settings settings) { return bullet_settings(settings, 1., {}); };
  const BulletSettings first = at(Settings::default_), second = at(Settings::recommended);
  const BulletSettings third = at(Settings::matched);
  const std::string server = "bullet3 examples/SharedMemory/PhysicsServerCommandProcessor.cpp";
  return {
      {"world", "btDiscreteDynamicsWorld", "btMultiBodyDynamicsWorld", "btDiscreteDynamicsWorld",
       "HelloWorld.cpp; " + server + "; robots with chains are multibodies at every setting"},
      {"solver", "btSequentialImpulseConstraintSolver", "btMultiBodyConstraintSolver",
       "btSequentialImpulseConstraintSolver", "as world"},
      {"ground of shapes", "static box, 20 km wide", "same", "same",
       "HelloWorld.cpp; on a btStaticPlaneShape a box has one contact a step"},
      {"iterations", std::to_string(first.iterations), std::to_string(second.iterations),
       std::to_string(third.iterations), "btContactSolverInfo.h (default); " + server},
      {"early stop, squared residual", setting_text(first.residual_threshold),
       setting_text(second.residual_threshold), setting_text(third.residual_threshold), server},
      {"normal ERP [1]", setting_text(first.constraint.normal_error_reduction),
       setting_text(second.constraint.normal_error_reduction), "dt k/(dt k + c)", server},
      {"normal CFM [m/(N s)]", setting_text(first.constraint.normal_mixing),
       setting_text(second.constraint.normal_mixing), "1/(dt k + c)",
       "setContactStiffnessAndDamping (matched)"},
      {"friction CFM [m/(N s)]", "0", "0", "0: no compliance to be had", "btContactSolverInfo.h"},
      {"friction anchor, ERP [1]", "off", "off", "on, dt k_t/(dt k_t + c_t)",
       "CF_HAS_FRICTION_ANCHOR"},
      {"linear slop [m]", setting_text(first.constraint.surface_layer),
       setting_text(second.constraint.surface_layer), setting_text(third.constraint.surface_layer),
       server},
      {"warm starting [1]", setting_text(first.warmstarting), setting_text(second.warmstarting),
       setting_text(third.warmstarting), server},
      {"split impulse", "on", "none: multibodies have no such", "off: it would bypass the spring",
       "btContactSolverInfo.h"},
      {"friction directions", "one, along the slip", "two, with a cone over both",
       "one, along the slip", "btContactSolverInfo.h, m_solverMode; btMultiBodyDynamicsWorld.cpp"},
      {"restitution", "material's", "material's", "0: the damper's", "btCollisionObject.h"},
      {"sleeping", "off", "off", "off", "a resting body is what is measured"},
      {"linear and angular damping", "0", "0", "0", "btRigidBodyConstructionInfo"},
  };
}

}  // namespace hookpoint::reference
