// DART: rows v + CFM A l = min(ERP depth/dt, speed) for an impulse l, A the row's own 1/mass. A
// spring and damper taken implicitly is ERP = dt k/(dt k + c), CFM = m/(dt (dt k + c)).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reference/dart/settings.h"
#include "translation/constraint_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const reference::DartSettings defaults =
    reference::dart_settings(reference::Settings::default_, 1., {});

const std::array parameters_of_dart{
    Parameter{
        "error_reduction_parameter",
        "1",
        {{defaults.constraint.normal_error_reduction}, ""},
        {},
        "ERP, of all contacts: with CFM the stiffness ERP m/(CFM dt^2) [N/m] and the damping m (1 - "
        "ERP)/(CFM dt) [N s/m] of a mass m",
        1e-9},
    Parameter{
        "max_error_reduction_velocity",
        "m/s",
        {{defaults.correction_speed}, ""},
        {},
        "the fastest at which depth is undone. Below load CFM dt/m the penetration grows without end"},
    Parameter{
        "constraint_force_mixing",
        "1",
        {{defaults.constraint.relative_mixing}, ""},
        {},
        "CFM, of all contacts: a part of each row's own 1/mass, so that softness goes with the mass. A "
        "sticking contact creeps at CFM dt/m per newton"},
    Parameter{
        "slip_compliance",
        "m/(N s)",
        {{0.}, ""},
        {},
        "speed of creep per newton of friction, beside that of CFM: the sum of both surfaces'"},
    Parameter{
        "friction_coeff", "1", {{1.}, ""}, {}, "coefficient of friction: the smaller of both"},
};

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  const auto normal = reference::implicit_spring(desired.stiffness, desired.damping, at.deltat);
  Parameters result(parameters_of_dart);
  result.set("error_reduction_parameter", normal.error_reduction);
  result.set("max_error_reduction_velocity", 1e3);
  result.set("constraint_force_mixing", at.row_mass() * normal.mixing / at.deltat);
  result.set("slip_compliance", std::max(0., desired_mixing(desired, at) - normal.mixing));
  result.set("friction_coeff", desired.kinetic_friction);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const double mixing = parameters.number("constraint_force_mixing") * at.deltat / at.row_mass();
  return behaviour_of(
      {parameters.number("error_reduction_parameter"), mixing,
       mixing + parameters.number("slip_compliance"), parameters.number("friction_coeff"),
       parameters.number("max_error_reduction_velocity")},
      at, "box of mu times the normal force");
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  return fmt::format(
      "using dart::constraint::ContactConstraint;  // of the whole program\n"
      "ContactConstraint::setErrorReductionParameter({});\n"
      "ContactConstraint::setMaxErrorReductionVelocity({});\n"
      "ContactConstraint::setConstraintForceMixing({});\n"
      "world->setTimeStep({});\n"
      "dart::dynamics::DynamicsAspect* surface = ground->getDynamicsAspect();\n"
      "surface->setFrictionCoeff({});  // of the feet too: the smaller counts\n"
      "surface->setPrimarySlipCompliance({});\n"
      "surface->setSecondarySlipCompliance({});",
      parameters.text("error_reduction_parameter"), parameters.text("max_error_reduction_velocity"),
      parameters.text("constraint_force_mixing"), numbers_text({at.deltat}),
      parameters.text("friction_coeff"), parameters.text("slip_compliance"),
      parameters.text("slip_compliance"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& at) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.push_back(fmt::format(
      "a contact has no constants of its own: these hold for all of the program, and for rows that move {} kg and this "
      "step alone",
      numbers_text({at.row_mass()})));
  notes.emplace_back(
      "friction rows are as soft as the normal one or, by the slip compliance, softer: a foot on a slope creeps");
  return notes;
}

}  // namespace

const Target dart_target{
    .name = "dart",
    .title = "DART",
    .basis = Basis::measured,
    .source = "DART 6, dart/constraint/ContactConstraint.cpp, getInformation and getVelocityChange",
    .parameters = parameters_of_dart,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "friction_coeff",
    .kinetic_friction = "friction_coeff",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
