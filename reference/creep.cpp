#include "reference/creep.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "reference/experiment_checks.h"
#include "reference/ground.h"
#include "reference/settings.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

/// A rigid body that lies on a slope.
struct RestingBody {
  const simulation::MassSpec* mass;
  Quaterniond orientation;
  Vector3d downhill;             ///< unit, along the fall
  double pull = 0., press = 0.;  ///< parts of m g along the fall and into the ground [N]
  std::vector<Vector3d> arms;    ///< of the touching points from the centre of mass, world axes [m]
};

/// Points of the body that may touch: those of touching_points.h, or the corners of its one box.
std::vector<Vector3d> candidates(const simulation::Experiment& experiment) {
  const simulation::BodySpec& base = experiment.robots[0].base;
  if (touches_by_points(experiment, 0)) return base.boundary_points;
  if (base.shapes.size() != 1) return {};
  const auto* box = std::get_if<simulation::Box>(&base.shapes[0].geometry);
  if (box == nullptr) return {};
  std::vector<Vector3d> corners;
  const Vector3d half = 0.5 * box->dimensions;
  for (const double x : {-half.x, half.x})
    for (const double y : {-half.y, half.y})
      for (const double z : {-half.z, half.z})
        corners.push_back(base.shapes[0].location +
                          rotate(base.shapes[0].orientation, Vector3d{x, y, z}));
  return corners;
}

std::optional<RestingBody> resting_body(const simulation::Experiment& experiment) {
  if (!experiment.terrain || experiment.robots.size() != 1) return std::nullopt;
  const simulation::RobotSpec& robot = experiment.robots[0];
  if (!robot.mobile || !robot.chains.empty()) return std::nullopt;
  const Ground ground = ground_of(*experiment.terrain);
  const auto* plane = std::get_if<GroundPlane>(&ground);
  if (plane == nullptr) return std::nullopt;
  const Vector3d along = tangential(experiment.gravity, plane->normal);
  const double mass = robot.base.mass.mass, slide = norm(along);
  if (!(slide > 0.)) return std::nullopt;
  RestingBody body{&robot.base.mass,
                   robot.orientation,
                   (1. / slide) * along,
                   mass * slide,
                   -mass * dot(experiment.gravity, plane->normal),
                   {}};
  const auto height = [&](const Vector3d& point) {
    return dot(rotate(robot.orientation, point), plane->normal);
  };
  const std::vector<Vector3d> points = candidates(experiment);
  double lowest = INFINITY;
  for (const Vector3d& point : points) lowest = std::min(lowest, height(point));
  for (const Vector3d& point : points)
    if (height(point) - lowest < 1e-6)
      body.arms.push_back(rotate(robot.orientation, point - body.mass->center_of_mass));
  if (body.arms.empty()) return std::nullopt;
  return body;
}

/// (J M^-1 J^T)_tt of the row along the fall at the end of `arm` [1/kg].
double row_diagonal(const RestingBody& body, const Vector3d& arm) {
  const Vector3d moment = rotate(conjugate(body.orientation), cross(arm, body.downhill));
  return 1. / body.mass->mass + dot(moment, inverse(body.mass->inertia) * moment);
}

/// x with 10 x^3 - 15 x^4 + 6 x^5 = `share`, which is within 0 and 1.
double stiction_speed(double share) {
  double low = 0., high = 1.;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (x * x * x * (10. + x * (6. * x - 15.)) < share ? low : high) = x;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<double> dart_friction_mixing(const simulation::Experiment& experiment) {
  const Settings kind = settings_of(experiment, "dart");
  const DartSettings settings = dart_settings(kind, experiment.deltat, ground_material(experiment));
  if (settings.own_mixing) return settings.constraint.tangential_mixing;
  const auto body = resting_body(experiment);
  if (!body || (settings.tessellated && !touches_by_points(experiment, 0))) return std::nullopt;
  const double diagonal = row_diagonal(*body, body->arms[0]);
  for (const Vector3d& arm : body->arms)
    if (std::abs(row_diagonal(*body, arm) - diagonal) > 1e-6 * diagonal) return std::nullopt;
  return settings.constraint.relative_mixing * diagonal * experiment.deltat;
}

std::optional<double> simbody_friction_mixing(const simulation::Experiment& experiment) {
  const SimbodySettings settings = simbody_settings(settings_of(experiment, "simbody"));
  const auto material = ground_material(experiment);
  if (settings.penalty) return 1. / material.tangential_damping;
  const auto body = resting_body(experiment);
  if (!body || !(body->pull < material.static_friction * body->press)) return std::nullopt;
  const double speed = settings.transition_velocity *
                       stiction_speed(body->pull / (material.static_friction * body->press));
  return speed * static_cast<double>(body->arms.size()) / body->pull;
}

}  // namespace hookpoint::reference
