// Closed forms of balls and of what carries a robot.
#include <cmath>
#include <string>
#include <utility>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/measure/body_on_plane.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using Constants = contact::MaterialConstants<double>;

/// The ground's constants of a single body that is alone on a plane, as they hold in its engine.
simulation::ClosedForm<Constants> ground_of_lone_body(const RunContext& context) {
  if (std::string why = not_alone_on_plane(context); !why.empty())
    return NoClosedForm{std::move(why)};
  if (!context.robot_spec().chains.empty()) return NoClosedForm{"the robot has chains"};
  return body_on_plane(context).material;
}

}  // namespace

Prediction rolling_acceleration(const RunContext& context) {
  const auto ground = ground_of_lone_body(context);
  if (!ground) return ground.none();
  const simulation::RobotSpec& robot = context.robot_spec();
  if (!is_ball(context)) return NoClosedForm{"the body is no ball"};
  if (norm(robot.velocity) > 0. || norm(robot.angular_velocity) > 0.)
    return NoClosedForm{"the ball moves at the start"};
  const simulation::MassSpec& mass = robot.base.mass;
  const double radius = robot.base.boundary_radius(0);
  constexpr double alike = 1e-9;
  if (norm(mass.center_of_mass - robot.base.boundary_points[0]) > alike * radius)
    return NoClosedForm{"the ball's centre of mass is not at its centre"};
  const Vector3d axis =
      rotate(conjugate(robot.orientation), cross(context.normal, context.downhill));
  const Vector3d turned = mass.inertia * axis;
  const double inertia = dot(axis, turned);
  if (norm(turned - inertia * axis) > alike * inertia)
    return NoClosedForm{"the ball does not roll about a principal axis"};
  const double gravity = norm(context.experiment->gravity);
  const double cosine = -dot(context.experiment->gravity, context.normal) / gravity;
  const double sine = norm(tangential(context.experiment->gravity, context.normal)) / gravity;
  // About the contact the ball has J + m r^2; friction carries the part of the pull that turns it.
  const double carried = inertia / (inertia + mass.mass * radius * radius);
  if (carried * sine <= ground->static_friction * cosine) return (1. - carried) * gravity * sine;
  return contact::slip_acceleration(gravity, std::atan2(sine, cosine), ground->kinetic_friction);
}

Prediction predicted::rebound(const RunContext& context, const PeerContact&) {
  const auto ground = ground_of_lone_body(context);
  if (!ground) return ground.none();
  const simulation::RobotSpec& robot = context.robot_spec();
  const double approach = -dot(robot.velocity, context.normal);
  if (robot.base.boundary_points.size() != 1)
    return NoClosedForm{"the body has more than one contact point: it turns as it hits"};
  if (!(approach > 0.)) return NoClosedForm{"the body is not thrown at the ground"};
  if (norm(context.experiment->gravity) != 0.)
    return NoClosedForm{"gravity acts during the impact"};
  const simulation::Experiment& experiment = *context.experiment;
  const double mass = robot.base.mass.mass;
  if (experiment.engine == "dts") {
    const auto* const law = contact::find_force_law(experiment.contact);
    return law ? law->restitution(mass, approach, *ground) : ground->restitution;
  }
  if (experiment.settings != "matched") return ground->restitution;
  return contact::kelvin_voigt_restitution(ground->normal_damping /
                                           (2. * std::sqrt(ground->normal_stiffness * mass)));
}

Prediction predicted::support_force(const RunContext& context, const PeerContact&) {
  const simulation::Experiment& experiment = *context.experiment;
  if (!context.ground) return NoClosedForm{"there is no ground"};
  if (!experiment.forces.empty())
    return NoClosedForm{"the Force " + experiment.forces.front().name + " acts"};
  if (context.weight == 0.) return NoClosedForm{"there is no gravity"};
  if (!moves_as_if_free(context))
    return NoClosedForm{"something else than the ground carries the robot's base"};
  const double gravity = norm(experiment.gravity);
  const double load = -dot(experiment.gravity, context.normal) / gravity;
  const double gap = lowest_gap(context);
  if (gap > touching_gap && context.settle < std::sqrt(2. * gap / (load * gravity)))
    return NoClosedForm{"the robot is in the air at `settle`"};
  return load * context.weight;
}

}  // namespace hookpoint::studies
