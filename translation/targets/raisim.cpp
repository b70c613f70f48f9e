// RaiSim: rigid contacts, solved one by one on the cone (Hwangbo, Lee & Hutter 2018). No stiffness.
#include <fmt/format.h>

#include <array>

#include "translation/damping.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_raisim{
    Parameter{"friction", "1", {{0.8}, ""}, {}, "coefficient of friction of a pair of materials"},
    Parameter{
        "restitution", "1", {{0.}, ""}, {}, "speed after over speed before, above the threshold"},
    Parameter{"resThreshold", "m/s", {{0.}, ""}, {}, "speed below which nothing rebounds"},
    Parameter{"erp",
              "1",
              {{0.3}, ""},
              {},
              "spring constant of the depth, scaled by the apparent inertia: no stiffness in N/m"},
    Parameter{"erp2", "1", {{0.002}, ""}, {}, "damping constant of the depth, scaled likewise"},
};

Parameters nearest(const Wanted& wanted, const Situation& at) {
  Parameters result(parameters_of_raisim);
  result.set("friction", wanted.kinetic_friction);
  result.set("restitution", wanted_rebound(wanted, at));
  result.set("resThreshold", 0.01);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& /*at*/) {
  Behaviour result;
  result.friction_shape = "cone";
  result.rigid = true;
  result.static_depth = 0.;
  if (holds(parameters.number("friction"))) result.creep = 0.;
  result.rebound = parameters.number("restitution");
  result.unknown = "the contact is rigid, but for an error reduction without units";
  return result;
}

Wanted friction(const Parameters& parameters) {
  return one_friction(parameters.number("friction"));
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  const auto number = [&](const char* name) {
    return numbers_text(parameters.value(name).numbers);
  };
  return fmt::format(
      "world.setTimeStep({});\n"
      "world.setMaterialPairProp(\"ground\", \"foot\", {}, {}, {});  // friction, restitution, threshold\n"
      "world.setERP({}, {});",
      numbers_text({at.deltat}), number("friction"), number("restitution"), number("resThreshold"),
      number("erp"), number("erp2"));
}

std::vector<std::string> cannot(const Wanted& wanted, const Situation& /*at*/) {
  std::vector<std::string> notes;
  add_note(notes, one_friction_note(wanted));
  notes.emplace_back(
      "the contact is rigid: there is no stiffness and no damping; restitution gives the rebound");
  return notes;
}

}  // namespace

const Target raisim_target{"raisim",
                           "RaiSim",
                           Basis::formula,
                           "RaiSim's manual, Material System; raisimLib, World.hpp",
                           parameters_of_raisim,
                           nearest,
                           behaviour,
                           friction,
                           snippet,
                           cannot};

}  // namespace hookpoint::translation
