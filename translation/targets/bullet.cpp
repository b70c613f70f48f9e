// Bullet and PyBullet: contacts with a stiffness and a damping, taken implicitly (ERP and CFM of the
// row, btSequentialImpulseConstraintSolver.cpp and btMultiBodyConstraintSolver.cpp), and friction
// anchored where the contact began.
#include <fmt/format.h>

#include <array>

#include "reference/bullet/settings.h"
#include "translation/impact.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

std::array<Parameter, 4> parameters_with(std::string_view friction) {
  return {
      {{"contactStiffness",
        "N/m",
        {{0.}, ""},
        {},
        "k [N/m]; 0: not set on either surface, the contact is rigid. Two surfaces are in series, 1/(1/k1 + "
        "1/k2); one without has 1e18"},
       {"contactDamping",
        "N s/m",
        {{0.1}, ""},
        {},
        "c [N s/m]. Of two surfaces the sum; one without has 0.1"},
       {friction, "1", {{0.5}, ""}, {}, "coefficient of friction: the product of both surfaces'"},
       {"frictionAnchor",
        "",
        {{}, "0"},
        {"0", "1"},
        "1: a sticking contact is pulled back to where it began; 0: its position is not corrected"}}};
}

/// What differs between the two.
struct Library {
  std::string_view friction;     ///< name of the parameter
  reference::Settings settings;  ///< of its world (reference/bullet/settings.h)
  const char* friction_shape;
  std::array<Parameter, 4> parameters = parameters_with(friction);
};
const Library bullet{"friction", reference::Settings::default_,
                     "along the slip, mu times the normal force"};
/// A world as PyBullet's server sets it up.
const Library pybullet{"lateralFriction", reference::Settings::recommended,
                       "cone over two directions"};

template <const Library& library>
Parameters nearest(const DesiredContact& desired, const Situation& /*at*/) {
  Parameters result(library.parameters);
  result.set("contactStiffness", desired.stiffness);
  result.set("contactDamping", desired.damping);
  result.set(library.friction, desired.kinetic_friction);
  result.set_word("frictionAnchor", "1");
  return result;
}

/// Both find a contact before it is made, and let no step go beyond the surface but as the row
/// gives.
template <const Library& library>
Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const auto world = reference::bullet_settings(library.settings, at.deltat, {}).constraint;
  const double stiffness = parameters.number("contactStiffness");
  const reference::ImplicitSpring spring =
      stiffness > 0.
          ? reference::implicit_spring(stiffness, parameters.number("contactDamping"), at.deltat)
          : reference::ImplicitSpring{world.normal_error_reduction, 0.};
  Behaviour result;
  result.friction_shape = library.friction_shape;
  result.static_depth = world.surface_layer;
  if (stiffness > 0.) {
    *result.static_depth += at.load / stiffness;
    result.damping = parameters.number("contactDamping");
  } else {
    result.set_rigid(": it has no contactStiffness");
  }
  result.set_creep(parameters.number(library.friction), 0.);
  predict_rebound(result, at, [&](double depth, double approach) {
    const double inside = depth - world.surface_layer;
    const double part = inside > 0. ? spring.error_reduction : 1.;
    return (approach + part * inside / at.deltat) / (spring.mixing + at.deltat / at.mass);
  });
  return result;
}

std::string bullet_snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "// of the ground, with friction 1 of the feet; world->stepSimulation(dt, 0) with dt = {}\n"
      "ground->setFriction({});\n"
      "ground->setRestitution(0);\n"
      "ground->setContactStiffnessAndDamping({}, {});\n"
      "{}"
      "world->getSolverInfo().m_splitImpulse = 0;  // it would bypass the spring\n"
      "world->getSolverInfo().m_numIterations = 50;",
      numbers_text({at.deltat}), parameters.text("friction"), parameters.text("contactStiffness"),
      parameters.text("contactDamping"),
      parameters.word("frictionAnchor") == "1"
          ? "ground->setCollisionFlags(ground->getCollisionFlags() |\n"
            "                          btCollisionObject::CF_HAS_FRICTION_ANCHOR);\n"
          : "");
}

std::string pybullet_snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "# of the ground, with lateralFriction=1 of the feet\n"
      "pybullet.setTimeStep({})\n"
      "pybullet.changeDynamics(ground, -1, lateralFriction={}, restitution=0,\n"
      "                        contactStiffness={}, contactDamping={}, frictionAnchor={})",
      numbers_text({at.deltat}), parameters.text("lateralFriction"),
      parameters.text("contactStiffness"), parameters.text("contactDamping"),
      parameters.word("frictionAnchor"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.emplace_back(
      "friction has no compliance: the tangential stiffness and damping have no counterpart");
  notes.emplace_back("restitution must be 0: it would add to what the damper leaves");
  return notes;
}

}  // namespace

const Target bullet_target{
    .name = "bullet",
    .title = "Bullet",
    .basis = Basis::measured,
    .source =
        "bullet3, btSequentialImpulseConstraintSolver.cpp, setupContactConstraint; "
        "btManifoldResult.cpp",
    .parameters = bullet.parameters,
    .nearest = nearest<bullet>,
    .behaviour = behaviour<bullet>,
    .static_friction = "friction",
    .kinetic_friction = "friction",
    .snippet = bullet_snippet,
    .cannot = cannot};

const Target pybullet_target{
    .name = "pybullet",
    .title = "PyBullet",
    .basis = Basis::measured,
    .source =
        "PyBullet quickstart guide, changeDynamics; bullet3, btMultiBodyConstraintSolver.cpp, "
        "setupMultiBodyContactConstraint",
    .parameters = pybullet.parameters,
    .nearest = nearest<pybullet>,
    .behaviour = behaviour<pybullet>,
    .static_friction = "lateralFriction",
    .kinetic_friction = "lateralFriction",
    .snippet = pybullet_snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
