// Bullet and PyBullet: contacts with a stiffness and a damping, taken implicitly (ERP and CFM of the
// row, btSequentialImpulseConstraintSolver.cpp and btMultiBodyConstraintSolver.cpp), and friction
// anchored where the contact began.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reference/settings.h"
#include "translation/impact.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

constexpr std::string_view stiffness_text =
    "k [N/m]; 0: not set on either surface, the contact is rigid. Two surfaces are in series, 1/(1/k1 + "
    "1/k2); one without has 1e18";
constexpr std::string_view damping_text = "c [N s/m]. Of two surfaces the sum; one without has 0.1";
constexpr std::string_view friction_text = "coefficient of friction: the product of both surfaces'";

const std::array parameters_of_bullet{
    Parameter{"contactStiffness", "N/m", {{0.}, ""}, {}, stiffness_text},
    Parameter{"contactDamping", "N s/m", {{0.1}, ""}, {}, damping_text},
    Parameter{"friction", "1", {{0.5}, ""}, {}, friction_text},
    Parameter{"frictionAnchor",
              "",
              {{}, "0"},
              {"0", "1"},
              "1: a sticking contact is drawn back to where it began; 0: it forgets"},
};
const std::array parameters_of_pybullet{
    Parameter{"contactStiffness", "N/m", {{0.}, ""}, {}, stiffness_text},
    Parameter{"contactDamping", "N s/m", {{0.1}, ""}, {}, damping_text},
    Parameter{"lateralFriction", "1", {{0.5}, ""}, {}, friction_text},
    Parameter{"frictionAnchor",
              "",
              {{}, "0"},
              {"0", "1"},
              "1: a sticking contact is drawn back to where it began; 0: it forgets"},
};

Parameters nearest_of(std::span<const Parameter> rows, const char* friction, const Wanted& wanted) {
  Parameters result(rows);
  result.set("contactStiffness", wanted.stiffness);
  result.set("contactDamping", wanted.damping);
  result.set(friction, wanted.kinetic_friction);
  result.set_word("frictionAnchor", "1");
  return result;
}

/// Depth that nothing pushes out [m], and the ERP of a contact without a stiffness of its own [1].
struct World {
  double slop, error_reduction;
};
// btContactSolverInfo.h.
constexpr World bullet_world{0., 0.2};
// PyBullet's server (PhysicsServerCommandProcessor.cpp, createEmptyDynamicsWorld).
constexpr World pybullet_world{1e-5, 0.08};

/// Both libraries find a contact before it is made, and let no step go beyond the surface but as
/// the row gives.
Behaviour behaviour_of(const Parameters& parameters, const char* friction, const Situation& at,
                       const World& world, const char* shape) {
  const double stiffness = parameters.number("contactStiffness");
  const reference::ImplicitSpring spring =
      stiffness > 0.
          ? reference::implicit_spring(stiffness, parameters.number("contactDamping"), at.deltat)
          : reference::ImplicitSpring{world.error_reduction, 0.};
  Behaviour result;
  result.friction_shape = shape;
  result.rigid = stiffness == 0.;
  result.static_depth = world.slop;
  if (result.rigid) {
    result.unknown = "the contact is rigid: it has no contactStiffness";
  } else {
    *result.static_depth += at.load / stiffness;
    result.damping = parameters.number("contactDamping");
  }
  if (holds(parameters.number(friction))) {
    result.creep = 0.;
  } else {
    result.unknown = slides_text;
  }
  result.rebound = rebound(at.mass, at.deltat, [&](double depth, double approach) {
    const double inside = depth - world.slop;
    const double part = inside > 0. ? spring.error_reduction : 1.;
    return (approach + part * inside / at.deltat) / (spring.mixing + at.deltat / at.mass);
  });
  return result;
}

std::vector<std::string> notes_of(const Wanted& wanted) {
  std::vector<std::string> notes;
  add_note(notes, one_friction_note(wanted));
  notes.emplace_back(
      "friction has no compliance: the tangential stiffness and damping have no counterpart");
  notes.emplace_back("restitution must be 0: it would add to what the damper leaves");
  return notes;
}

Parameters nearest_bullet(const Wanted& wanted, const Situation& /*at*/) {
  return nearest_of(parameters_of_bullet, "friction", wanted);
}
Parameters nearest_pybullet(const Wanted& wanted, const Situation& /*at*/) {
  return nearest_of(parameters_of_pybullet, "lateralFriction", wanted);
}
Behaviour behaviour_of_bullet(const Parameters& parameters, const Situation& at) {
  return behaviour_of(parameters, "friction", at, bullet_world,
                      "along the slip, mu times the normal force");
}
Behaviour behaviour_of_pybullet(const Parameters& parameters, const Situation& at) {
  return behaviour_of(parameters, "lateralFriction", at, pybullet_world,
                      "cone over two directions");
}
Wanted friction_of_bullet(const Parameters& parameters) {
  return one_friction(parameters.number("friction"));
}
Wanted friction_of_pybullet(const Parameters& parameters) {
  return one_friction(parameters.number("lateralFriction"));
}

std::string bullet_snippet(const Parameters& parameters, const Situation& at) {
  const auto number = [&](const char* name) {
    return numbers_text(parameters.value(name).numbers);
  };
  return fmt::format(
      "// of the ground, with friction 1 of the feet; world->stepSimulation(dt, 0) with dt = {}\n"
      "ground->setFriction({});\n"
      "ground->setRestitution(0);\n"
      "ground->setContactStiffnessAndDamping({}, {});\n"
      "{}"
      "world->getSolverInfo().m_splitImpulse = 0;  // it would bypass the spring\n"
      "world->getSolverInfo().m_numIterations = 50;",
      numbers_text({at.deltat}), number("friction"), number("contactStiffness"),
      number("contactDamping"),
      parameters.word("frictionAnchor") == "1"
          ? "ground->setCollisionFlags(ground->getCollisionFlags() |\n"
            "                          btCollisionObject::CF_HAS_FRICTION_ANCHOR);\n"
          : "");
}

std::string pybullet_snippet(const Parameters& parameters, const Situation& at) {
  const auto number = [&](const char* name) {
    return numbers_text(parameters.value(name).numbers);
  };
  return fmt::format(
      "# of the ground, with lateralFriction=1 of the feet\n"
      "pybullet.setTimeStep({})\n"
      "pybullet.changeDynamics(ground, -1, lateralFriction={}, restitution=0,\n"
      "                        contactStiffness={}, contactDamping={}, frictionAnchor={})",
      numbers_text({at.deltat}), number("lateralFriction"), number("contactStiffness"),
      number("contactDamping"), parameters.word("frictionAnchor"));
}

std::vector<std::string> cannot_bullet(const Wanted& wanted, const Situation& /*at*/) {
  return notes_of(wanted);
}

}  // namespace

const Target bullet_target{
    "bullet",
    "Bullet",
    Basis::measured,
    "bullet3, btSequentialImpulseConstraintSolver.cpp, setupContactConstraint; btManifoldResult.cpp",
    parameters_of_bullet,
    nearest_bullet,
    behaviour_of_bullet,
    friction_of_bullet,
    bullet_snippet,
    cannot_bullet};

const Target pybullet_target{
    "pybullet",
    "PyBullet",
    Basis::measured,
    "PyBullet quickstart guide, changeDynamics; bullet3, btMultiBodyConstraintSolver.cpp, "
    "setupMultiBodyContactConstraint",
    parameters_of_pybullet,
    nearest_pybullet,
    behaviour_of_pybullet,
    friction_of_pybullet,
    pybullet_snippet,
    cannot_bullet};

}  // namespace hookpoint::translation
