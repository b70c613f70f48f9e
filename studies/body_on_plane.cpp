#include "studies/body_on_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "simulation/kinematics.h"

namespace hookpoint::studies {
namespace {

using simulation::Pose;

/// Part of the weight [N], or of its moment about 1 m [N m], below which gravity does not load a
/// joint: rounding.
constexpr double rounding_load = 1e-9;

/// Whether the scene is one robot on a plane, without forces, that does not turn at the start and
/// touches the ground with points (not balls) of its base.
bool alone_on_plane(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  return experiment.terrain && experiment.robots.size() == 1 && experiment.forces.empty() &&
         moves_as_if_free(context) && norm(context.robot_spec().angular_velocity) == 0. &&
         !context.robot_spec().base.boundary_points.empty() &&
         context.robot_spec().base.boundary_radii.empty() &&
         !std::holds_alternative<contact::GridSurface>(experiment.terrain->surface);
}

/// X_WB of every body at the start.
std::vector<Pose> world_poses(const simulation::RobotSpec& robot) {
  std::vector<Pose> poses = simulation::body_poses(robot);
  for (Pose& pose : poses) pose = Pose{robot.location, robot.orientation} * pose;
  return poses;
}

/// Whether gravity g moves no joint of a robot whose bodies have the poses `X_WB`.
bool unloaded_joints(const simulation::RobotSpec& robot, const Vector3d& g,
                     const std::vector<Pose>& X_WB, double weight) {
  struct Load {
    Vector3d force, moment;  // of all further out, about the body's origin
  };
  std::vector<Load> loads(X_WB.size());
  const std::vector<std::size_t> carriers = simulation::carriers_of(robot);
  bool unloaded = true;
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const simulation::MassSpec& mass = at.link.body.mass;
    const Pose& X_WL = X_WB[at.body];
    const Vector3d center = X_WL.position + rotate(X_WL.orientation, mass.center_of_mass);
    for (std::size_t body = at.body; body > 0; body = carriers[body]) {
      loads[body].force += mass.mass * g;
      loads[body].moment += cross(center - X_WB[body].position, mass.mass * g);
    }
  });
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const simulation::LinkSpec& link = at.link;
    const bool moves = link.rate != 0. || link.torque != 0. || !link.body.boundary_radii.empty();
    const bool springs = link.stiffness != 0. && link.angle != link.rest_angle;
    const bool turns = simulation::joint_type(link.joint).turns;
    const Vector3d axis = rotate(X_WB[at.body].orientation, Vector3d{0., 0., 1.});
    const Load& load = loads[at.body];
    const double along = dot(axis, turns ? load.moment : load.force);
    unloaded = unloaded && !moves && !springs && std::abs(along) <= rounding_load * weight;
  });
  return unloaded;
}

}  // namespace

double BodyOnPlane::slip_acceleration() const {
  return contact::slip_acceleration(gravity, std::atan2(sine, cosine), material.kinetic_friction);
}

double BodyOnPlane::friction_load() const {
  const double pull = mass * gravity * sine / contacts();
  return sticks() ? pull : std::min(pull, material.kinetic_friction * normal_load());
}

bool moves_as_if_free(const RunContext& context) {
  const simulation::RobotSpec& robot = context.robot_spec();
  if (!robot.mobile || !robot.plane_normal) return robot.mobile;
  const auto across = [&](const Vector3d& a) {
    return std::array{a.x, a.y, a.z}[*robot.plane_normal];
  };
  const simulation::Experiment& experiment = *context.experiment;
  return std::abs(across(context.normal)) <= rounding_load &&
         std::abs(across(experiment.gravity)) <= rounding_load * norm(experiment.gravity);
}

bool one_rigid_body(const RunContext& context) {
  return alone_on_plane(context) && context.robot_spec().chains.empty();
}

bool stands_as_one_body(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  const bool level = norm(tangential(experiment.gravity, context.normal)) <=
                     rounding_load * norm(experiment.gravity);
  if (!alone_on_plane(context) || robot.chains.empty() || !level || norm(robot.velocity) > 0. ||
      !experiment.components.empty())
    return false;
  return unloaded_joints(robot, experiment.gravity, world_poses(robot), context.weight);
}

BodyOnPlane body_on_plane(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  BodyOnPlane body;
  body.gravity = norm(experiment.gravity);
  body.cosine = -dot(experiment.gravity, context.normal) / body.gravity;
  body.sine = norm(tangential(experiment.gravity, context.normal)) / body.gravity;
  body.speed = norm(tangential(robot.velocity, context.normal));
  body.peer = experiment.engine != "dts";
  if (!body.peer) body.law = contact::find_force_law(experiment.contact);
  const int material = context.ground->query(context.start).material;
  body.material = experiment.materials[static_cast<std::size_t>(material)].constants;
  // A peer has one coefficient of friction, the kinetic (reference/experiment_checks.h).
  if (body.peer) body.material.static_friction = body.material.kinetic_friction;

  const std::vector<const simulation::BodySpec*> bodies = simulation::bodies_of(robot);
  const std::vector<Pose> poses = world_poses(robot);
  Vector3d moment;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const simulation::MassSpec& mass = bodies[i]->mass;
    body.mass += mass.mass;
    moment += mass.mass * (poses[i].position + rotate(poses[i].orientation, mass.center_of_mass));
    for (const Vector3d& point : bodies[i]->boundary_points)
      points.push_back(poses[i].position + rotate(poses[i].orientation, point));
  }
  const Vector3d center = (1. / body.mass) * moment;
  body.single_point = points.size() == 1;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : points)
    lowest = std::min(lowest, dot(point - robot.location, context.normal));
  for (const Vector3d& point : points) {
    if (dot(point - robot.location, context.normal) - lowest > 1e-6) continue;
    body.footprint.push_back(tangential(point - center, context.normal));
    body.height = dot(center - point, context.normal);
    body.gap = -context.ground->query(point).depth;
  }
  return body;
}

}  // namespace hookpoint::studies
