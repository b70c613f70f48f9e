// PhysX and Isaac: a compliant contact is a spring and damper taken implicitly, friction holds each
// anchor where it began (DyContactPrepShared.h, computeCompliantContactCoefficients).
#include <fmt/format.h>

#include <array>

#include "reference/settings.h"
#include "translation/constraint_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_physx{
    Parameter{
        "compliant_contact_stiffness",
        "N/m",
        {{0.}, ""},
        {},
        "k; 0: the contact is rigid. PxMaterial has it as a negative restitution. Of a compliant surface on "
        "a rigid one the compliant one's"},
    Parameter{
        "compliant_contact_damping", "N s/m", {{0.}, ""}, {}, "c; of both surfaces the greater"},
    Parameter{"static_friction",
              "1",
              {{0.5}, ""},
              {},
              "of both surfaces the mean, unless friction_combine_mode says other"},
    Parameter{"dynamic_friction", "1", {{0.5}, ""}, {}, "as static_friction"},
};

Parameters nearest(const DesiredContact& desired, const Situation& /*at*/) {
  Parameters result(parameters_of_physx);
  result.set("compliant_contact_stiffness", desired.stiffness);
  result.set("compliant_contact_damping", desired.damping);
  result.set("static_friction", desired.static_friction);
  result.set("dynamic_friction", desired.kinetic_friction);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const double stiffness = parameters.number("compliant_contact_stiffness");
  const char* shape = "box of mu times the normal force, on up to two anchors a patch";
  if (stiffness == 0.) {
    Behaviour rigid;
    rigid.friction_shape = shape;
    rigid.static_depth = 0.;
    rigid.set_rigid(": it has no compliant_contact_stiffness");
    rigid.set_creep(parameters.number("static_friction"), 0.);
    return rigid;
  }
  const auto spring = reference::implicit_spring(
      stiffness, parameters.number("compliant_contact_damping"), at.deltat);
  return behaviour_of(
      {spring.error_reduction, spring.mixing, 0., parameters.number("static_friction")}, at, shape);
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "# of the ground, Isaac Lab; the feet rigid, with the same frictions; dt = {}\n"
      "sim_utils.RigidBodyMaterialCfg(\n"
      "    static_friction={}, dynamic_friction={}, restitution=0.0,\n"
      "    compliant_contact_stiffness={}, compliant_contact_damping={})",
      numbers_text({at.deltat}), parameters.text("static_friction"),
      parameters.text("dynamic_friction"), parameters.text("compliant_contact_stiffness"),
      parameters.text("compliant_contact_damping"));
}

std::vector<std::string> cannot(const DesiredContact& /*desired*/, const Situation& /*at*/) {
  return {"friction has no compliance: the tangential stiffness and damping have no counterpart",
          "the TGS solver pushes a depth out no faster than max_depenetration_velocity: leave that "
          "at its default, which is no limit"};
}

}  // namespace

const Target physx_target{
    .name = "physx",
    .title = "PhysX, Isaac Sim and Isaac Lab",
    .basis = Basis::formula,
    .source =
        "PhysX 5, physx/source/lowleveldynamics/src/DyContactPrepShared.h, computeCompliantContactCoefficients; "
        "Isaac Lab, physics_materials_cfg.py",
    .parameters = parameters_of_physx,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "static_friction",
    .kinetic_friction = "dynamic_friction",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
