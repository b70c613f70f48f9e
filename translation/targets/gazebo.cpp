// Gazebo classic with ODE: kp and kd of a surface become ERP and CFM of the contact joint, slip1
// and slip2 the CFM of its friction rows (ODEPhysics.cc, Collide).
#include <fmt/format.h>

#include <array>

#include "reference/settings.h"
#include "translation/constraint_row.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_gazebo{
    Parameter{"kp",
              "N/m",
              {{1e12}, ""},
              {},
              "stiffness: of two surfaces in series, 1/(1/kp1 + 1/kp2)",
              1e-9},
    Parameter{"kd", "N s/m", {{1.}, ""}, {}, "damping: of two surfaces the sum"},
    Parameter{
        "max_vel",
        "m/s",
        {{0.01}, ""},
        {},
        "the fastest at which depth is undone. Below load/(dt kp + kd) the penetration grows without end"},
    Parameter{"min_depth", "m", {{0.}, ""}, {}, "depth that nothing pushes out"},
    Parameter{
        "mu", "1", {{1.}, ""}, {}, "coefficient of friction, and mu2 across: the smaller of both"},
    Parameter{
        "slip1",
        "m/(N s)",
        {{0.}, ""},
        {},
        "speed of creep per newton of friction on each contact point, and slip2 across: the smaller of both"},
};

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  Parameters result(parameters_of_gazebo);
  result.set("kp", desired.stiffness);
  result.set("kd", desired.damping);
  result.set("max_vel", 1e3);
  result.set("mu", desired.kinetic_friction);
  result.set("slip1", desired_mixing(desired, at));
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const auto spring =
      reference::implicit_spring(parameters.number("kp"), parameters.number("kd"), at.deltat);
  Behaviour result =
      behaviour_of({spring.error_reduction, spring.mixing, parameters.number("slip1"),
                    parameters.number("mu"), parameters.number("max_vel")},
                   at, "box of mu times the normal force");
  if (result.static_depth) *result.static_depth += parameters.number("min_depth");
  return result;
}

std::string snippet(const Parameters& parameters, const Situation& /*at*/) {
  return fmt::format(
      "<!-- in the <collision> of the ground; in those of the feet max_vel and <friction> alike -->\n"
      "<surface>\n"
      "  <contact><ode><kp>{}</kp><kd>{}</kd><max_vel>{}</max_vel><min_depth>{}</min_depth></ode></contact>\n"
      "  <friction><ode><mu>{}</mu><mu2>{}</mu2><slip1>{}</slip1><slip2>{}</slip2></ode></friction>\n"
      "</surface>",
      parameters.text("kp"), parameters.text("kd"), parameters.text("max_vel"),
      parameters.text("min_depth"), parameters.text("mu"), parameters.text("mu"),
      parameters.text("slip1"), parameters.text("slip1"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.emplace_back(
      "friction has no spring, so a foot on a slope creeps; a smaller slip creeps less");
  notes.emplace_back(
      "of these the later Gazebo with DART reads mu, mu2, slip1 and slip2 alone, with Bullet mu and mu2: "
      "there the contact is as stiff as the engine has it");
  return notes;
}

}  // namespace

const Target gazebo_target{
    .name = "gazebo",
    .title = "Gazebo (SDF)",
    .basis = Basis::formula,
    .source = "gazebo-classic, gazebo/physics/ode/ODEPhysics.cc, Collide; SDFormat 1.7, surface",
    .parameters = parameters_of_gazebo,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "mu",
    .kinetic_friction = "mu",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
