#include "reference/resting_body.h"

#include <string>
#include <utility>
#include <variant>

#include "contact/terrain/footprint.h"
#include "reference/ground.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

/// What of a body may touch a plane, in body axes: its points, or the corners of its one box. Empty
/// for other shapes, and for both together.
std::vector<contact::Foot> candidates(const simulation::Experiment& experiment) {
  const simulation::BodySpec& base = experiment.robots[0].base;
  const auto shapes = touching_shapes(experiment, base);
  std::vector<contact::Foot> points;
  for (const TouchingPoint& point : touching_points(experiment, base, 0))
    points.push_back({point.p_BP, point.radius, static_cast<std::size_t>(point.point)});
  if (shapes.empty()) return points;
  if (shapes.size() != 1 || !points.empty()) return {};
  const simulation::ShapeSpec& shape = *shapes.front();
  const auto* box = std::get_if<simulation::Box>(&shape.geometry);
  if (box == nullptr) return {};
  const Vector3d half = 0.5 * box->dimensions;
  for (const double x : {-half.x, half.x})
    for (const double y : {-half.y, half.y})
      for (const double z : {-half.z, half.z})
        points.push_back({shape.location + rotate(shape.orientation, Vector3d{x, y, z})});
  return points;
}

/// How much higher than the lowest contact others may come to carry [m].
constexpr double unlevel = 5e-3;

/// Why the experiment is no single body on a plane; "" where it is.
std::string not_alone_on_plane(const simulation::Experiment& experiment) {
  if (!experiment.terrain) return "there is no ground";
  if (experiment.robots.size() != 1) return "the scene has more than one robot";
  const simulation::RobotSpec& robot = experiment.robots[0];
  if (!robot.mobile) return "the robot's base is fixed";
  if (robot.plane_normal) return "the robot's base is kept in a plane";
  if (!robot.chains.empty()) return "the robot has chains";
  if (!std::holds_alternative<GroundPlane>(ground_of(*experiment.terrain)))
    return "the ground is no plane";
  return "";
}

}  // namespace

simulation::ClosedForm<RestingBody> resting_body(const simulation::Experiment& experiment) {
  using simulation::NoClosedForm;
  if (std::string why = not_alone_on_plane(experiment); !why.empty())
    return NoClosedForm{std::move(why)};
  const simulation::RobotSpec& robot = experiment.robots[0];
  const auto plane = std::get<GroundPlane>(ground_of(*experiment.terrain));
  const Vector3d along = tangential(experiment.gravity, plane.normal);
  const double mass = robot.base.mass.mass, slide = norm(along);
  if (!(slide > 0.)) return NoClosedForm{"the ground is level: nothing pulls the body along it"};
  RestingBody body{&robot.base.mass,
                   robot.orientation,
                   plane.normal,
                   (1. / slide) * along,
                   (1. / slide) * cross(plane.normal, along),
                   mass * slide,
                   -mass * dot(experiment.gravity, plane.normal),
                   {},
                   {},
                   -rotate(robot.orientation, robot.base.mass.center_of_mass)};
  std::vector<contact::Foot> feet = candidates(experiment);
  if (feet.empty())
    return NoClosedForm{"engine " + experiment.engine +
                        " alone knows where the shapes of the body meet the ground"};
  for (contact::Foot& foot : feet)
    foot.position = rotate(robot.orientation, foot.position - body.mass->center_of_mass);
  const contact::Footprint footprint = contact::footprint_of(feet, plane.normal);
  if (footprint.in_line() &&
      contact::footprint_of(feet, plane.normal, unlevel).feet.size() > footprint.feet.size())
    return NoClosedForm{"the contacts are not level: which of them carry the body is not known"};
  if (footprint.rolls()) return NoClosedForm{"the body rolls"};
  for (const contact::Foot& foot : footprint.feet) {
    body.arms.push_back(foot.position);
    body.radii.push_back(foot.radius);
  }
  return body;
}

simulation::ClosedForm<Vector3d> normal_loads(const RestingBody& body, double friction) {
  contact::Footprint footprint;
  for (const Vector3d& arm : body.arms) footprint.feet.push_back({arm});
  if (footprint.in_line())
    return simulation::NoClosedForm{
        "the body touches in fewer than three places, or along a line: it may tip"};
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
