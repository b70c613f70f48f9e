// Genesis: MuJoCo's rows with a time constant and a damping ratio. A spring and damper taken
// implicitly, B = 1/dt and K d = k R, is t = 2 dt/d and z = sqrt(d/(k R))/(2 dt).
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "translation/soft_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_genesis{
    Parameter{
        "sol_params",
        "s, 1, 1, 1, m, 1, 1",
        {{0.01, 1., 0.9, 0.95, 1e-3, 0.5, 2.}, ""},
        {},
        "MuJoCo's solref and solimp in a row, the mean of both surfaces'. A time constant of 0 "
        "is constraint_timeconst, 0.01 s; it is two substeps at least"},
    Parameter{"friction",
              "1",
              {{1.}, ""},
              {},
              "coefficient of friction: the greater of both, 0.01 at least"},
    Parameter{"impratio",
              "1",
              {{1.}, ""},
              {},
              "as MuJoCo's; without one it is 1 of a pyramid and 100 of an elliptic cone",
              1e-9},
    Parameter{"friction_cone",
              "",
              {{}, "pyramidal"},
              {"pyramidal", "elliptic"},
              "shape of the set of friction forces"},
};

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  const SoftRow soft = nearest_soft_row(desired, at);
  const double d = soft.row.impedance[0];
  const double softness = (1. - d) / d * at.foot_inverse_weight();
  const double time = 2. * at.deltat / d;
  const double ratio = std::sqrt(d / (desired.stiffness * softness)) / (2. * at.deltat);
  Parameters result(parameters_of_genesis);
  result.set("sol_params", {time, ratio, d, d, 1e-3, 0.5, 1.});
  result.set("friction", desired.kinetic_friction);
  result.set("impratio", soft.settings.friction.impedance_ratio);
  result.set_word("friction_cone", "elliptic");
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  reference::MujocoSettings settings;
  settings.friction.elliptic = parameters.word("friction_cone") == "elliptic";
  settings.friction.impedance_ratio = parameters.number("impratio");
  const auto number = [&](std::size_t i) { return parameters.number("sol_params", i); };
  constexpr double default_time = 0.01;  // constraint_timeconst
  reference::MujocoRow row;
  row.reference = {number(0) > 0. ? number(0) : default_time, number(1)};
  for (std::size_t i = 0; i < 5; ++i) row.impedance[i] = number(i + 2);
  return behaviour_of(settings, row, parameters.number("friction"), at);
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "rigid_options = gs.options.RigidOptions(dt={}, friction_cone=\"{}\", impratio={})\n"
      "for geom in (*ground.geoms, *robot.geoms):  # the mean of both surfaces counts\n"
      "    geom.set_sol_params([{}])\n"
      "    geom.set_friction({})",
      numbers_text({at.deltat}), parameters.word("friction_cone"), parameters.text("impratio"),
      numbers_text(parameters.value("sol_params").numbers, ", "), parameters.text("friction"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& at) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.push_back(fmt::format(
      "the parameters depend on the mass and the step, as in MuJoCo: these are for a foot of inverse weight {} 1/kg",
      numbers_text({at.foot_inverse_weight()})));
  if (nearest_soft_row(desired, at).at_bound)
    notes.emplace_back("the impedance is at a bound: the contact is not this stiff");
  notes.emplace_back(
      "friction has no spring, so a foot on a slope creeps; a greater impratio creeps less");
  return notes;
}

}  // namespace

const Target genesis_target{
    .name = "genesis",
    .title = "Genesis",
    .basis = Basis::formula,
    .source =
        "Genesis, genesis/engine/solvers/rigid/constraint/solver.py and genesis/utils/geom.py (imp_aref)",
    .parameters = parameters_of_genesis,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "friction",
    .kinetic_friction = "friction",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
