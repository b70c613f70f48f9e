// Closed forms of balls and of what carries a robot.
#include <cmath>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/body_on_plane.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using Constants = contact::MaterialConstants<double>;

/// The one body of the scene, if it is alone on a plane; its ground's constants.
std::optional<Constants> lone_body_ground(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const bool alone = experiment.robots.size() == 1 && experiment.forces.empty() &&
                     context.robot_spec().chains.empty() && context.ground &&
                     moves_as_if_free(context) &&
                     !std::holds_alternative<contact::GridSurface>(experiment.terrain->surface);
  if (!alone) return std::nullopt;
  const auto material = static_cast<std::size_t>(context.ground->query(context.start).material);
  return experiment.materials[material].constants;
}

}  // namespace

std::optional<double> rolling_acceleration(const RunContext& context) {
  const auto ground = lone_body_ground(context);
  const simulation::RobotSpec& robot = context.robot_spec();
  const bool ball = robot.base.boundary_points.size() == 1 && robot.base.boundary_radius(0) > 0.;
  if (!ground || !ball || norm(robot.velocity) > 0. || norm(robot.angular_velocity) > 0.)
    return std::nullopt;
  const double gravity = norm(context.experiment->gravity);
  const double cosine = -dot(context.experiment->gravity, context.normal) / gravity;
  const double sine = norm(tangential(context.experiment->gravity, context.normal)) / gravity;
  // About the contact the ball has (2/5 + 1) m r^2: friction carries 2/7 of the pull.
  if (2. / 7. * sine <= ground->static_friction * cosine) return 5. / 7. * gravity * sine;
  return contact::slip_acceleration(gravity, std::atan2(sine, cosine), ground->kinetic_friction);
}

std::optional<double> rebound(const RunContext& context) {
  const auto ground = lone_body_ground(context);
  const simulation::RobotSpec& robot = context.robot_spec();
  const double approach = -dot(robot.velocity, context.normal);
  const bool hits_alone = ground && robot.base.boundary_points.size() == 1 && approach > 0. &&
                          norm(context.experiment->gravity) == 0.;
  if (!hits_alone) return std::nullopt;
  const simulation::Experiment& experiment = *context.experiment;
  const double mass = robot.base.mass.mass;
  if (experiment.engine == "dts") {
    const auto law = contact::find_force_law(experiment.contact);
    return law ? contact::restitution(*law, mass, approach, *ground) : ground->restitution;
  }
  if (experiment.settings != "matched") return ground->restitution;
  return contact::kelvin_voigt_restitution(ground->normal_damping /
                                           (2. * std::sqrt(ground->normal_stiffness * mass)));
}

std::optional<double> support_force(const RunContext& context) {
  if (!context.ground || !context.experiment->forces.empty() || context.weight == 0. ||
      !moves_as_if_free(context))
    return std::nullopt;
  return -dot(context.experiment->gravity, context.normal) / norm(context.experiment->gravity) *
         context.weight;
}

}  // namespace hookpoint::studies
