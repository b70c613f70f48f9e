#include "reference/settings.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace hookpoint::reference {
namespace {

constexpr std::array<std::string_view, 4> names{"default", "recommended", "matched", "noslip"};

std::string text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%g", value);
  return buffer.data();
}

/// A spring k and damper c taken implicitly over dt: ERP = dt k/(dt k + c), CFM = 1/(dt k + c)
/// (ODE manual, "How to use ERP and CFM"; the same expressions are in Bullet's contact rows).
struct ImplicitSpring {
  double error_reduction, mixing;
};
ImplicitSpring implicit_spring(double k, double c, double dt) {
  return {dt * k / (dt * k + c), 1. / (dt * k + c)};
}

// ode/objects.h, dWorldSetERP and dWorldSetCFM: the defaults of the double precision library. A
// mixing of 0 makes the matrix of a four-cornered contact singular, so no setting goes there.
constexpr ConstraintConstants ode_defaults{0.2, 1e-10, 0., 1e-10, 0.};
// btContactSolverInfo.h: m_erp2, m_globalCfm, m_frictionERP (used with anchors only),
// m_frictionCFM.
constexpr ConstraintConstants bullet_defaults{0.2, 0., 0., 0., 0.};

// mjmodel.h, mjMINIMP and 1 - mjMAXIMP: MuJoCo takes no impedance beyond.
constexpr double least_impedance = 1e-4;

std::vector<SettingRow> ode_table(OdeSolver solver) {
  const auto at = [solver](Settings settings) { return ode_settings(settings, solver, 1., {}); };
  const OdeSettings first = at(Settings::default_), second = at(Settings::recommended);
  const OdeSettings third = at(Settings::matched);
  std::vector<SettingRow> rows{
      {"solver", solver == OdeSolver::step ? "dWorldStep" : "dWorldQuickStep", "same", "same",
       "ode/objects.h"},
      {"normal ERP [1]", text(first.constraint.normal_error_reduction),
       text(second.constraint.normal_error_reduction), "dt k/(dt k + c)",
       "ode/objects.h (default); ODE manual, How to use ERP and CFM (matched)"},
      {"normal CFM [m/(N s)]", text(first.constraint.normal_mixing),
       text(second.constraint.normal_mixing), "1/(dt k + c)", "as normal ERP"},
      {"friction CFM [m/(N s)]", text(first.constraint.tangential_mixing),
       text(second.constraint.tangential_mixing), "1/(dt k_t + c_t)",
       "world CFM (default); dContactSlip1/2 (matched): friction rows have no position error"},
      {"friction", "dContactApprox1, directions by the library", "same", "same",
       "ODE manual, Contact: without dContactApprox1 mu is a force"},
      {"contact surface layer [m]", text(first.constraint.surface_layer),
       text(second.constraint.surface_layer), text(third.constraint.surface_layer),
       "ode/objects.h, dWorldSetContactSurfaceLayer"},
      {"restitution", "material's", "material's", "0: the damper's", "dContactBounce"},
  };
  if (solver == OdeSolver::quickstep)
    rows.push_back({"iterations", std::to_string(first.iterations),
                    std::to_string(second.iterations), std::to_string(third.iterations),
                    "ode/objects.h, dWorldSetQuickStepNumIterations (default)"});
  return rows;
}

std::vector<SettingRow> bullet_table() {
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
      {"early stop, squared residual", text(first.residual_threshold),
       text(second.residual_threshold), text(third.residual_threshold), server},
      {"normal ERP [1]", text(first.constraint.normal_error_reduction),
       text(second.constraint.normal_error_reduction), "dt k/(dt k + c)", server},
      {"normal CFM [m/(N s)]", text(first.constraint.normal_mixing),
       text(second.constraint.normal_mixing), "1/(dt k + c)",
       "setContactStiffnessAndDamping (matched)"},
      {"friction CFM [m/(N s)]", "0", "0", "0: no compliance to be had", "btContactSolverInfo.h"},
      {"friction anchor, ERP [1]", "off", "off", "on, dt k_t/(dt k_t + c_t)",
       "CF_HAS_FRICTION_ANCHOR"},
      {"linear slop [m]", text(first.constraint.surface_layer),
       text(second.constraint.surface_layer), text(third.constraint.surface_layer), server},
      {"warm starting [1]", text(first.warmstarting), text(second.warmstarting),
       text(third.warmstarting), server},
      {"split impulse", "on", "none: multibodies have no such", "off: it would bypass the spring",
       "btContactSolverInfo.h"},
      {"friction directions", "one, along the slip", "two, with a cone over both",
       "one, along the slip", "btContactSolverInfo.h, m_solverMode; btMultiBodyDynamicsWorld.cpp"},
      {"restitution", "material's", "material's", "0: the damper's", "btCollisionObject.h"},
      {"sleeping", "off", "off", "off", "a resting body is what is measured"},
      {"linear and angular damping", "0", "0", "0", "btRigidBodyConstructionInfo"},
  };
}

std::vector<SettingRow> mujoco_table() {
  const auto at = [](Settings settings) { return mujoco_settings(settings, 1., {}); };
  const MujocoSettings first = at(Settings::default_), second = at(Settings::recommended);
  const MujocoSettings third = at(Settings::matched), fourth = at(Settings::noslip);
  const auto cone = [](const MujocoSettings& settings) {
    return std::string(settings.elliptic ? "elliptic" : "pyramidal");
  };
  const auto number = [](int value) { return std::to_string(value); };
  const MujocoRow row;
  const std::string reference = text(row.reference[0]) + ", " + text(row.reference[1]);
  const std::string impedance =
      text(row.impedance[0]) + ", " + text(row.impedance[1]) + ", " + text(row.impedance[2]);
  const std::string slip = "manual, Modeling, choice of algorithm: what to do against slip";
  return {
      {"solver", "Newton", "same", "same", "XML reference, option"},
      {"integrator", "Euler, semi-implicit", "same", "same", "XML reference, option"},
      {"friction cone", cone(first), cone(second), cone(third), slip},
      {"impratio [1]", text(first.friction_impedance), text(second.friction_impedance),
       "(c_t + dt k_t)/(c + dt k)", "Menagerie, unitree_a1/a1.xml (recommended)"},
      {"tolerance [1]", text(first.tolerance), text(second.tolerance), text(third.tolerance), slip},
      {"no-slip iterations [1]", number(first.no_slip_iterations),
       number(second.no_slip_iterations), number(third.no_slip_iterations),
       slip + ", its last resort; the number is ours", number(fourth.no_slip_iterations)},
      {"solref", reference, reference, "-d k R, -d/dt; R = 1/(dt (c + dt k))",
       "XML reference, geom; manual, Computation, Constraint model (matched)"},
      {"solimp", impedance, impedance, "d = A/(A + R), constant",
       "as solref; A is the body's inverse weight"},
      {"restitution", "none", "none", "0: the damper's", "MuJoCo has no such coefficient"},
  };
}

// dart/constraint/ContactConstraint.hpp: what its getters say at first, an ERP of 0.01, no faster
// than 1 mm/s, and a CFM of 1e-5 of each row's own diagonal.
constexpr ConstraintConstants dart_defaults{0.01, 0., 0., 0., 0., 1e-5};

std::vector<SettingRow> dart_table() {
  const auto at = [](Settings settings) { return dart_settings(settings, 1., {}); };
  const DartSettings first = at(Settings::default_), second = at(Settings::recommended);
  const DartSettings third = at(Settings::matched);
  const std::string contact = "dart/constraint/ContactConstraint.hpp";
  return {
      {"solver", "boxed LCP: Dantzig, then Gauss-Seidel", "same", "same",
       "dart/constraint/BoxedLcpConstraintSolver.hpp"},
      {"spheres and cylinders collide", "as such", "as meshes", "as such",
       "FCLCollisionDetector.hpp recommends meshes (recommended), and has them by itself"},
      {"normal ERP [1]", text(first.constraint.normal_error_reduction),
       text(second.constraint.normal_error_reduction), "dt k/(dt k + c)",
       contact + " (default); ODE manual, How to use ERP and CFM (matched)"},
      {"error reduction speed, at most [m/s]", text(first.correction_speed),
       text(second.correction_speed), "none", contact},
      {"CFM, part of each row's diagonal [1]", text(first.constraint.relative_mixing),
       text(second.constraint.relative_mixing), text(third.constraint.relative_mixing), contact},
      {"normal CFM [m/(N s)]", text(first.constraint.normal_mixing),
       text(second.constraint.normal_mixing), "1/(dt k + c)",
       "a BoxedLcpSolver of ours before the library's (matched)"},
      {"friction CFM [m/(N s)]", text(first.constraint.tangential_mixing),
       text(second.constraint.tangential_mixing), "1/(dt k_t + c_t)", "as normal CFM"},
      {"friction directions", "horizontal, and along the fall", "same", "same",
       "DART_DEFAULT_FRICTION_DIR, the world's z"},
      {"restitution", "material's", "material's", "0: the damper's",
       "dart/dynamics/ShapeFrame.hpp"},
  };
}

std::vector<SettingRow> simbody_table() {
  const SimbodySettings first = simbody_settings(Settings::default_);
  const SimbodySettings second = simbody_settings(Settings::recommended);
  const SimbodySettings third = simbody_settings(Settings::matched);
  const std::string playground = "simbody examples/ExampleContactPlayground.cpp";
  return {
      {"integrator", "RungeKuttaMerson, steps of its own", "same", "same",
       "CPodes clashes with SUNDIALS (docs/reference_engines.md)"},
      {"accuracy [1]", text(first.accuracy), text(second.accuracy), text(third.accuracy),
       "ours: at the library's 1e-3 a contact at rest chatters"},
      {"contact", "CompliantContactSubsystem: Hertz, Hunt and Crossley", "same",
       "a ContactForceGenerator of ours", playground},
      {"normal stiffness of each surface [Pa]", text(first.stiffness), text(second.stiffness),
       "k [N/m]", playground + ", its floor"},
      {"normal dissipation [s/m]", text(first.dissipation), text(second.dissipation),
       "c [N s/m], linear", "ours: at the example's 0.09 a contact at rest rings for seconds"},
      {"transition velocity [m/s]", text(first.transition_velocity),
       text(second.transition_velocity), "none: a damper c_t up to mu N",
       "what getTransitionVelocity() says at first (default); " + playground + " (recommended)"},
      {"friction", "material's, static and kinetic", "same", "kinetic", "ContactSurface.h"},
      {"restitution", "none: the dissipation's", "same", "0: the damper's", "ContactSurface.h"},
  };
}

}  // namespace

std::vector<std::string> settings_names(std::string_view engine) {
  return {names.begin(), names.end() - (engine == "mujoco" ? 0 : 1)};
}

Settings settings_of(const simulation::Experiment& experiment, std::string_view engine) {
  const std::vector<std::string> known = settings_names(engine);
  std::string choice;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (experiment.settings == known[i]) return static_cast<Settings>(i);
    choice += (i == 0 ? "" : i + 1 < known.size() ? ", " : " or ") + known[i];
  }
  throw simulation::ExperimentError("engine " + std::string(engine) + " has no settings '" +
                                    experiment.settings + "': choose " + choice);
}

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
  const ImplicitSpring normal =
      implicit_spring(material.normal_stiffness, material.normal_damping, dt);
  const ImplicitSpring tangential =
      implicit_spring(material.tangential_stiffness, material.tangential_damping, dt);
  result.constraint = {normal.error_reduction, normal.mixing, 0., tangential.mixing, 0.};
  result.soft_normal = result.tangential_slip = true;
  result.restitution = false;
  return result;
}

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
  const ImplicitSpring normal =
      implicit_spring(material.normal_stiffness, material.normal_damping, dt);
  const ImplicitSpring tangential =
      implicit_spring(material.tangential_stiffness, material.tangential_damping, dt);
  // The friction anchor is the nearest thing to a hook, with the spring's ERP but no compliance:
  // m_frictionCFM enters a row without being divided by the step or scaled by the effective mass,
  // so no value of it is 1/(dt k_t + c_t).
  result.constraint = {normal.error_reduction, normal.mixing, tangential.error_reduction, 0., 0.};
  result.contact_stiffness = result.friction_anchor = true;
  result.restitution = false;
  return result;
}

MujocoSettings mujoco_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material) {
  MujocoSettings result;
  if (settings == Settings::default_) return result;
  // The manual's advice where slip matters (Modeling, choice of algorithm): elliptic cones, a large
  // impratio, Newton's method with a tolerance such as 1e-10. The impratio is that of the
  // maintainers' legged robots (MuJoCo Menagerie, unitree_a1/a1.xml).
  result.elliptic = true;
  result.tolerance = 1e-10;
  result.friction_impedance = 100.;
  if (settings == Settings::noslip) result.no_slip_iterations = 10;
  if (settings != Settings::matched) return result;
  result.spring = true;
  result.friction_impedance = (material.tangential_damping + dt * material.tangential_stiffness) /
                              (material.normal_damping + dt * material.normal_stiffness);
  return result;
}

MujocoRow mujoco_row(const MujocoSettings& settings, double dt,
                     const contact::MaterialConstants<double>& material, double inverse_weight) {
  MujocoRow row;
  if (!settings.spring) return row;
  // The spring and damper taken implicitly, f = -k (r + dt (v + dt a)) - c (v + dt a), is a row
  // with R = 1/(dt (c + dt k)), B = 1/dt and K d = k R.
  const double softness = 1. / (dt * (material.normal_damping + dt * material.normal_stiffness));
  const double d = std::clamp(inverse_weight / (inverse_weight + softness), least_impedance,
                              1. - least_impedance);
  row.reference = {-d * material.normal_stiffness * softness, -d / dt};
  row.impedance = {d, d, 0., 0.5, 1.};
  return row;
}

DartSettings dart_settings(Settings settings, double dt,
                           const contact::MaterialConstants<double>& material) {
  DartSettings result;
  result.constraint = dart_defaults;
  // FCLCollisionDetector.hpp on its PrimitiveShape: meshes until FCL has all contacts of
  // primitives. They are what a detector starts with too, but a ball of 16 sides does not roll.
  result.tessellated = settings == Settings::recommended;
  if (settings != Settings::matched) return result;
  const ImplicitSpring normal =
      implicit_spring(material.normal_stiffness, material.normal_damping, dt);
  const ImplicitSpring tangential =
      implicit_spring(material.tangential_stiffness, material.tangential_damping, dt);
  constexpr double least_relative_mixing = 1e-9;  // ContactConstraint.hpp
  result.constraint = {normal.error_reduction, normal.mixing, 0., tangential.mixing, 0.,
                       least_relative_mixing};
  result.correction_speed = std::numeric_limits<double>::max();
  result.own_mixing = true;
  result.restitution = false;
  return result;
}

SimbodySettings simbody_settings(Settings settings) {
  SimbodySettings result;
  if (settings == Settings::recommended) result.transition_velocity = 1e-3;
  result.penalty = settings == Settings::matched;
  return result;
}

std::vector<SettingRow> settings_table(std::string_view engine) {
  if (engine == "ode") return ode_table(OdeSolver::step);
  if (engine == "ode_quickstep") return ode_table(OdeSolver::quickstep);
  if (engine == "bullet") return bullet_table();
  if (engine == "dart") return dart_table();
  if (engine == "simbody") return simbody_table();
  if (engine == "mujoco") return mujoco_table();
  throw std::invalid_argument("no peer called '" + std::string(engine) + "'");
}

}  // namespace hookpoint::reference
