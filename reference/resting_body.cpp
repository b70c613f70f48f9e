#include "reference/resting_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "reference/ground.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

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

}  // namespace

std::optional<RestingBody> resting_body(const simulation::Experiment& experiment) {
  if (!experiment.terrain || experiment.robots.size() != 1) return std::nullopt;
  const simulation::RobotSpec& robot = experiment.robots[0];
  if (!robot.mobile || robot.plane_normal || !robot.chains.empty()) return std::nullopt;
  const Ground ground = ground_of(*experiment.terrain);
  const auto* plane = std::get_if<GroundPlane>(&ground);
  if (plane == nullptr) return std::nullopt;
  const Vector3d along = tangential(experiment.gravity, plane->normal);
  const double mass = robot.base.mass.mass, slide = norm(along);
  if (!(slide > 0.)) return std::nullopt;
  RestingBody body{&robot.base.mass,
                   robot.orientation,
                   plane->normal,
                   (1. / slide) * along,
                   (1. / slide) * cross(plane->normal, along),
                   mass * slide,
                   -mass * dot(experiment.gravity, plane->normal),
                   {},
                   -rotate(robot.orientation, robot.base.mass.center_of_mass)};
  const auto height = [&](const Vector3d& point) {
    return dot(rotate(robot.orientation, point), plane->normal);
  };
  const std::vector<Vector3d> points = candidates(experiment);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : points) lowest = std::min(lowest, height(point));
  for (const Vector3d& point : points)
    if (height(point) - lowest < 1e-6)
      body.arms.push_back(rotate(robot.orientation, point - body.mass->center_of_mass));
  if (body.arms.empty()) return std::nullopt;
  return body;
}

std::optional<Vector3d> normal_loads(const RestingBody& body, double friction) {
  if (body.arms.size() < 3) return std::nullopt;
  Symmetric3d sums;
  for (const Vector3d& arm : body.arms) {
    const auto [x, y, z] = body.in_slope(arm);
    sums += Symmetric3d{1., x * x, y * y, x, y, x * y};
  }
  const double height = -body.in_slope(body.arms.front()).z;
  return inverse(sums) * Vector3d{body.press, friction * height, 0.};
}

double load_at(const RestingBody& body, const Vector3d& loads, const Vector3d& arm) {
  const auto [x, y, z] = body.in_slope(arm);
  return loads.x + loads.y * x + loads.z * y;
}

}  // namespace hookpoint::reference
