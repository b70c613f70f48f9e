#include "studies/measure/run_context.h"

#include <limits>
#include <span>

#include "simulation/engine_interface/rotors.h"
#include "simulation/experiment/ground.h"
#include "simulation/experiment/kinematics.h"
#include "studies/measure/measured_body.h"

namespace hookpoint::studies {

namespace {

/// Downhill at the start: gravity's part in the plane; on the level the initial velocity's; else x.
Vector3d driven_direction(const Vector3d& normal, const Vector3d& gravity,
                          const Vector3d& velocity) {
  const Vector3d pull = tangential(gravity, normal);
  if (norm(pull) > 1e-9 * norm(gravity)) return (1. / norm(pull)) * pull;
  const Vector3d along = tangential(velocity, normal);
  if (norm(along) > 0.) return (1. / norm(along)) * along;
  const Vector3d x = tangential(Vector3d{1., 0., 0.}, normal);
  return (1. / norm(x)) * x;
}

}  // namespace

RunContext make_context(const simulation::Experiment& experiment, double settle, double duration,
                        std::string_view body) {
  RunContext context;
  context.experiment = &experiment;
  context.ground = simulation::make_ground(experiment);
  context.settle = settle;
  context.duration = duration;
  const MeasuredBody measured = measured_body(experiment, body);
  context.robot = measured.robot;
  context.body = measured.base;
  context.watched = measured.body;
  const simulation::RobotSpec& robot = context.robot_spec();
  const simulation::Pose X_WB = simulation::Pose{robot.location, robot.orientation} *
                                simulation::body_poses(robot)[measured.body - measured.base];
  context.weight = simulation::robot_mass(robot) * norm(experiment.gravity);
  context.start = X_WB.position;
  context.start_orientation = X_WB.orientation;
  context.normal =
      context.ground ? context.ground->query(context.start).normal : Vector3d{0., 0., 1.};
  context.downhill = driven_direction(context.normal, experiment.gravity, robot.velocity);
  return context;
}

double height_over_ground(const RunContext& context, const Vector3d& point) {
  return context.ground ? -context.ground->query(point).depth
                        : std::numeric_limits<double>::infinity();
}

std::optional<double> static_friction(const RunContext& context) {
  if (!context.ground) return std::nullopt;
  const auto material = static_cast<std::size_t>(context.ground->query(context.start).material);
  return context.experiment->materials[material].constants.static_friction;
}

double kinetic_energy(const RunContext& context, const simulation::WorldState& world) {
  double energy = 0.;
  for_each_body(context, world,
                [&](const simulation::BodySpec& spec, const simulation::BodyState& body) {
                  const simulation::MassSpec& mass = spec.mass;
                  const Vector3d p_BC = rotate(body.orientation, mass.center_of_mass);
                  const Vector3d v_WC = body.velocity + cross(body.angular_velocity, p_BC);
                  const Vector3d w_B = rotate(conjugate(body.orientation), body.angular_velocity);
                  energy += 0.5 * mass.mass * dot(v_WC, v_WC) + 0.5 * dot(w_B, mass.inertia * w_B);
                });
  // Each robot ahead has one body more than joints.
  const std::size_t first_joint = context.body - static_cast<std::size_t>(context.robot);
  return energy + simulation::rotor_energy(context.robot_spec(),
                                           std::span(world.joints).subspan(first_joint));
}

double mechanical_energy(const RunContext& context, const simulation::WorldState& world) {
  double energy = kinetic_energy(context, world);
  for_each_body(context, world,
                [&](const simulation::BodySpec& spec, const simulation::BodyState& body) {
                  const Vector3d p_BC = rotate(body.orientation, spec.mass.center_of_mass);
                  energy -= spec.mass.mass * dot(context.experiment->gravity, body.position + p_BC);
                });
  return energy;
}

}  // namespace hookpoint::studies
