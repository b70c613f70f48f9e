#include "reference/touching_points.h"

#include <algorithm>

namespace hookpoint::reference {

bool touches_by_points(const simulation::Experiment& experiment, int robot) {
  const simulation::RobotSpec& spec = experiment.robots[static_cast<std::size_t>(robot)];
  if (!spec.chains.empty() || spec.base.shapes.empty()) return true;
  return std::ranges::find(experiment.points, robot, &simulation::PointSpec::robot) !=
         experiment.points.end();
}

std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const RobotTree& tree) {
  std::vector<TouchingPoint> points;
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const TreeBody& body = tree.bodies[i];
    if (!body.mobile || !touches_by_points(experiment, body.robot)) continue;
    for (std::size_t k = 0; k < body.body->boundary_points.size(); ++k)
      points.push_back(
          {i, static_cast<int>(k), body.body->boundary_points[k], body.body->boundary_radius(k)});
  }
  return points;
}

Meeting meet(const contact::Terrain& ground, const TouchingPoint& point,
             const simulation::BodyState& body) {
  const Vector3d center = body.position + rotate(body.orientation, point.p_BP);
  const contact::TilePoint tile = ground.query(center);
  return {center - point.radius * tile.normal, tile.normal, tile.depth + point.radius,
          tile.material};
}

simulation::PointState point_state(const Meeting& meeting, const simulation::BodyState& body,
                                   const Vector3d& force) {
  constexpr double slip_speed = 1e-3;
  const Vector3d& n = meeting.normal;
  const Vector3d velocity =
      body.velocity + cross(body.angular_velocity, meeting.position - body.position);
  const bool slides = dot(force, n) > 0. && norm(velocity - dot(velocity, n) * n) > slip_speed;
  return {meeting.position, force, meeting.position, meeting.depth, slides ? 1. : 0.};
}

}  // namespace hookpoint::reference
