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

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  Parameters result(parameters_of_raisim);
  result.set("friction", desired.kinetic_friction);
  result.set("restitution", desired_rebound(desired, at));
  result.set("resThreshold", 0.01);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& /*at*/) {
  Behaviour result;
  result.friction_shape = "cone";
  result.static_depth = 0.;
  result.set_rigid(", but for an error reduction without units");
  result.set_creep(parameters.number("friction"), 0.);
  result.rebound = parameters.number("restitution");
  return result;
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "world.setTimeStep({});\n"
      "world.setMaterialPairProp(\"ground\", \"foot\", {}, {}, {});  // friction, restitution, threshold\n"
      "world.setERP({}, {});",
      numbers_text({at.deltat}), parameters.text("friction"), parameters.text("restitution"),
      parameters.text("resThreshold"), parameters.text("erp"), parameters.text("erp2"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.emplace_back(
      "the contact is rigid: there is no stiffness and no damping; restitution gives the rebound");
  return notes;
}

}  // namespace

const Target raisim_target{.name = "raisim",
                           .title = "RaiSim",
                           .basis = Basis::formula,
                           .source = "RaiSim's manual, Material System; raisimLib, World.hpp",
                           .parameters = parameters_of_raisim,
                           .nearest = nearest,
                           .behaviour = behaviour,
                           .static_friction = "friction",
                           .kinetic_friction = "friction",
                           .snippet = snippet,
                           .cannot = cannot};

}  // namespace hookpoint::translation
