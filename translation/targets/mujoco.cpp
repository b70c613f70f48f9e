// MuJoCo: rows a = -B v - K d r - R f, R = (1 - d)/d A (reference/mujoco/settings.h). A spring and
// damper taken implicitly is the row with R = 1/(dt (c + dt k)), B = 1/dt, K d = k R.
#include <fmt/format.h>

#include <array>
#include <limits>

#include "reference/mujoco/settings.h"
#include "translation/soft_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

constexpr double any = -std::numeric_limits<double>::infinity();

const reference::MujocoRow default_row;

const std::array parameters_of_mujoco{
    Parameter{
        "solref",
        "s, 1",
        {{default_row.reference.begin(), default_row.reference.end()}, ""},
        {},
        "time constant t and damping ratio z of the error, relative to the mass: K = 1/(dmax "
        "t z)^2 [1/s^2], B = 2/(dmax t) [1/s], dmax the second number of solimp. Both below "
        "0: -K dmax^2 and -B dmax. Stiffness = K d^2 M/(1 - d) [N/m] of a body of M kg, d the "
        "impedance at its depth",
        any},
    Parameter{"solimp",
              "1, 1, m, 1, 1",
              {{default_row.impedance.begin(), default_row.impedance.end()}, ""},
              {},
              "impedance d at the surface; dmax from a depth on (the width); how it goes between. "
              "Force = d of that of a rigid contact; R = (1 - d)/(d M) of acceleration per force"},
    Parameter{"friction",
              "1, m, m",
              {{1., 0.005, 0.0001}, ""},
              {},
              "sliding coefficient; torsion and rolling count from condim 4 on. Of two geoms the "
              "greater"},
    Parameter{"impratio",
              "1",
              {{1.}, ""},
              {},
              "R of the normal row over R of a friction row: a sticking contact creeps at R f_t/(B "
              "impratio) [m/s] (elliptic cone)",
              1e-9},
    Parameter{"cone",
              "",
              {{}, "pyramidal"},
              {"pyramidal", "elliptic"},
              "shape of the set of friction forces: the cone, or a pyramid inside it"},
};

reference::MujocoSettings settings_of(const Parameters& parameters) {
  reference::MujocoSettings settings;
  settings.friction.elliptic = parameters.word("cone") == "elliptic";
  settings.friction.impedance_ratio = parameters.number("impratio");
  return settings;
}

reference::MujocoRow row_of(const Parameters& parameters) {
  reference::MujocoRow row;
  for (std::size_t i = 0; i < 2; ++i) row.reference[i] = parameters.number("solref", i);
  for (std::size_t i = 0; i < 5; ++i) row.impedance[i] = parameters.number("solimp", i);
  if (!contact::is_mujoco_reference(row.reference))
    throw ParameterError(contact::mujoco_reference_rule);
  return row;
}

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  const SoftRow soft = nearest_soft_row(desired, at);
  Parameters result(parameters_of_mujoco);
  result.set("solref", {soft.row.reference.begin(), soft.row.reference.end()});
  result.set("solimp", {soft.row.impedance.begin(), soft.row.impedance.end()});
  result.set("friction", {desired.kinetic_friction, 0.005, 0.0001});
  result.set("impratio", soft.settings.friction.impedance_ratio);
  result.set_word("cone", "elliptic");
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  return behaviour_of(settings_of(parameters), row_of(parameters), parameters.number("friction"),
                      at);
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "<option timestep=\"{}\" cone=\"{}\" impratio=\"{}\"/>\n"
      "<default>\n"
      "  <geom priority=\"1\" condim=\"3\" friction=\"{}\"\n"
      "        solref=\"{}\" solimp=\"{}\"/>\n"
      "</default>",
      numbers_text({at.deltat}), parameters.word("cone"), parameters.text("impratio"),
      parameters.text("friction"), parameters.text("solref"), parameters.text("solimp"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& at) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.push_back(fmt::format(
      "the parameters depend on the mass and the step: these are for a foot with body_invweight0 = {} 1/kg and this "
      "timestep",
      numbers_text({at.foot_inverse_weight()})));
  if (nearest_soft_row(desired, at).at_bound)
    notes.emplace_back("the impedance is at a bound of MuJoCo's: the contact is not this stiff");
  notes.emplace_back(
      "friction has no spring, so a foot on a slope creeps; a greater impratio creeps less");
  return notes;
}

}  // namespace

const Target mujoco_target{
    .name = "mujoco",
    .title = "MuJoCo",
    .basis = Basis::measured,
    .source = "MuJoCo's manual, Computation (Constraint model) and Modeling (Contact parameters)",
    .parameters = parameters_of_mujoco,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "friction",
    .kinetic_friction = "friction",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
