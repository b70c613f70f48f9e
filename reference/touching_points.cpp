#include "reference/touching_points.h"

namespace hookpoint::reference {

bool touches_as_it_is(const simulation::Experiment& experiment,
                      const simulation::ShapeSpec& shape) {
  return experiment.touch == "shapes" && shape.boundary_points == 0;
}

std::vector<const simulation::ShapeSpec*> touching_shapes(const simulation::Experiment& experiment,
                                                          const simulation::BodySpec& body) {
  std::vector<const simulation::ShapeSpec*> shapes;
  for (const simulation::ShapeSpec& shape : body.shapes)
    if (touches_as_it_is(experiment, shape)) shapes.push_back(&shape);
  return shapes;
}

std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const simulation::BodySpec& spec, std::size_t body) {
  std::vector<bool> of_shape(spec.boundary_points.size(), false);
  for (const simulation::ShapeSpec* shape : touching_shapes(experiment, spec))
    for (std::size_t i = 0; i < shape->point_count; ++i) of_shape[shape->first_point + i] = true;
  std::vector<TouchingPoint> points;
  for (std::size_t i = 0; i < spec.boundary_points.size(); ++i)
    if (!of_shape[i])
      points.push_back({body, static_cast<int>(i), spec.boundary_points[i], spec.boundary_radius(i),
                        spec.boundary_material(i)});
  return points;
}

std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const RobotTree& tree) {
  std::vector<TouchingPoint> points;
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const TreeBody& body = tree.bodies[i];
    if (!body.mobile) continue;
    const auto own = touching_points(experiment, *body.body, i);
    points.insert(points.end(), own.begin(), own.end());
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
  const double load = dot(force, n);
  const bool slides = load > 0. && norm(velocity - dot(velocity, n) * n) > slip_speed;
  return {meeting.position, force, meeting.position,      meeting.depth,
          slides ? 1. : 0., load,  norm(force - load * n)};
}

}  // namespace hookpoint::reference
