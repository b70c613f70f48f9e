// DART: rows v + CFM A l = min(ERP depth/dt, speed) for an impulse l, A the row's own 1/mass. A
// spring and damper taken implicitly is ERP = dt k/(dt k + c), CFM = m/(dt (dt k + c)).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reference/settings.h"
#include "translation/constraint_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_dart{
    Parameter{
        "error_reduction_parameter",
        "1",
        {{0.01}, ""},
        {},
        "ERP, of all contacts: with CFM the stiffness ERP m/(CFM dt^2) [N/m] and the damping m (1 - "
        "ERP)/(CFM dt) [N s/m] of a mass m",
        1e-9},
    Parameter{
        "max_error_reduction_velocity",
        "m/s",
        {{1e-3}, ""},
        {},
        "the fastest at which depth is undone. Below load CFM dt/m the contact sinks without end"},
    Parameter{
        "constraint_force_mixing",
        "1",
        {{1e-5}, ""},
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

Parameters nearest(const Wanted& wanted, const Situation& at) {
  const auto normal = reference::implicit_spring(wanted.stiffness, wanted.damping, at.deltat);
  Parameters result(parameters_of_dart);
  result.set("error_reduction_parameter", normal.error_reduction);
  result.set("max_error_reduction_velocity", 1e3);
  result.set("constraint_force_mixing", at.mass * normal.mixing / at.deltat);
  result.set("slip_compliance", std::max(0., wanted_mixing(wanted, at) - normal.mixing));
  result.set("friction_coeff", wanted.kinetic_friction);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const double mixing = parameters.number("constraint_force_mixing") * at.deltat / at.mass;
  return behaviour_of(
      {parameters.number("error_reduction_parameter"), mixing,
       mixing + parameters.number("slip_compliance"), parameters.number("friction_coeff"),
       parameters.number("max_error_reduction_velocity")},
      at, "box of mu times the normal force");
}

Wanted friction(const Parameters& parameters) {
  return one_friction(parameters.number("friction_coeff"));
}

std::string snippet(const Parameters& parameters, const Situation& at) {
  const auto number = [&](const char* name) {
    return numbers_text(parameters.value(name).numbers);
  };
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
      number("error_reduction_parameter"), number("max_error_reduction_velocity"),
      number("constraint_force_mixing"), numbers_text({at.deltat}), number("friction_coeff"),
      number("slip_compliance"), number("slip_compliance"));
}

std::vector<std::string> cannot(const Wanted& wanted, const Situation& at) {
  std::vector<std::string> notes;
  add_note(notes, one_friction_note(wanted));
  notes.push_back(fmt::format(
      "a contact has no constants of its own: these hold for all of the program, and for rows that move {} kg and this "
      "step alone",
      numbers_text({at.mass})));
  notes.emplace_back(
      "friction rows are as soft as the normal one or, by the slip compliance, softer: a foot on a slope creeps");
  return notes;
}

}  // namespace

const Target dart_target{
    "dart",
    "DART",
    Basis::measured,
    "DART 6, dart/constraint/ContactConstraint.cpp, getInformation and getVelocityChange",
    parameters_of_dart,
    nearest,
    behaviour,
    friction,
    snippet,
    cannot};

}  // namespace hookpoint::translation
