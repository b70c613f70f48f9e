// Open Dynamics Engine: a contact joint with ERP = dt k/(dt k + c), CFM = 1/(dt k + c) (ODE manual,
// How to use ERP and CFM) and a slip 1/(dt k_t + c_t) of its friction rows.
#include <fmt/format.h>

#include <array>

#include "reference/ode/settings.h"
#include "translation/constraint_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const reference::ConstraintConstants defaults =
    reference::ode_settings(reference::Settings::default_, reference::OdeSolver::step, 1., {})
        .constraint;

const std::array parameters_of_ode{
    Parameter{"mu", "1", {{1.}, ""}, {}, "coefficient of friction of this contact"},
    Parameter{"soft_erp",
              "1",
              {{defaults.normal_error_reduction}, ""},
              {},
              "part of the depth that a step undoes: with CFM the stiffness ERP/(dt CFM) [N/m] and "
              "the damping (1 - ERP)/CFM [N s/m]",
              1e-9},
    Parameter{
        "soft_cfm",
        "m/(N s)",
        {{defaults.normal_mixing}, ""},
        {},
        "speed by which the contact yields per newton; the default is that of double precision"},
    Parameter{"slip1",
              "m/(N s)",
              {{defaults.tangential_mixing}, ""},
              {},
              "speed of creep per newton of friction; without dContactSlip1 it is the world's CFM"},
};

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  const auto normal = reference::implicit_spring(desired.stiffness, desired.damping, at.deltat);
  Parameters result(parameters_of_ode);
  result.set("mu", desired.kinetic_friction);
  result.set("soft_erp", normal.error_reduction);
  result.set("soft_cfm", normal.mixing);
  result.set("slip1", desired_mixing(desired, at));
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  return behaviour_of({parameters.number("soft_erp"), parameters.number("soft_cfm"),
                       parameters.number("slip1"), parameters.number("mu")},
                      at, "box of mu times the normal force (dContactApprox1)");
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "dContact contact;  // of each pair that touches, for dWorldStep(world, {})\n"
      "contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM | dContactSlip1 | "
      "dContactSlip2;\n"
      "contact.surface.mu = {};\n"
      "contact.surface.soft_erp = {};\n"
      "contact.surface.soft_cfm = {};\n"
      "contact.surface.slip1 = contact.surface.slip2 = {};",
      numbers_text({at.deltat}), parameters.text("mu"), parameters.text("soft_erp"),
      parameters.text("soft_cfm"), parameters.text("slip1"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.emplace_back(
      "friction has no spring, so a foot on a slope creeps; a smaller slip creeps less");
  notes.emplace_back(
      "all four depend on the step: translate again when it changes; dWorldQuickStep comes to them "
      "with 100 iterations");
  return notes;
}

}  // namespace

const Target ode_target{.name = "ode",
                        .title = "Open Dynamics Engine",
                        .basis = Basis::measured,
                        .source = "ODE manual, How to use ERP and CFM, and Contact",
                        .parameters = parameters_of_ode,
                        .nearest = nearest,
                        .behaviour = behaviour,
                        .static_friction = "mu",
                        .kinetic_friction = "mu",
                        .snippet = snippet,
                        .cannot = cannot};

}  // namespace hookpoint::translation
