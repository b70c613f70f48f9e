// Boundary points as places on the ground: points, and balls that roll (docs/contact.md).
#include "simulation/engine/dts_robot.h"
#include "simulation/kinematics.h"

namespace hookpoint::simulation {

std::vector<ContactPoint> boundary_points(const RobotSpec& robot) {
  std::vector<ContactPoint> points;
  const std::vector<const BodySpec*> bodies = bodies_of(robot);
  std::size_t count = 0;
  for (const BodySpec* body : bodies) count += body->boundary_points.size();
  points.reserve(count);
  // A fixed base cannot be moved by the ground.
  for (std::size_t body = robot.mobile ? 0 : 1; body < bodies.size(); ++body) {
    for (std::size_t i = 0; i < bodies[body]->boundary_points.size(); ++i) {
      ContactPoint& point = points.emplace_back();
      point.body = body;
      point.p_BP = bodies[body]->boundary_points[i];
      point.radius = bodies[body]->boundary_radius(i);
    }
  }
  return points;
}

TouchingPlace touching_place(const ContactPoint& point, const dts::BodyMotion<double>& body,
                             const contact::Terrain& ground) {
  const Vector3d center = body.R_WB * point.p_BP;
  TouchingPlace touching{body.p_WB + center, body.v_WB + cross(body.w_WB, center),
                         ground.query(body.p_WB + center)};
  if (point.radius == 0.) return touching;
  const Vector3d to_surface = -point.radius * touching.tile.normal;
  touching.position += to_surface;
  touching.velocity += cross(body.w_WB, to_surface);
  touching.tile.depth += point.radius;
  return touching;
}

contact::Memory<double> ContactPoint::carried(const contact::BallFrame& now) const {
  contact::Memory<double> memory = committed;
  if (radius > 0. && memory.attached)
    memory.hook += contact::rolling_displacement(committed_frame, now, radius);
  return memory;
}

contact::BallFrame ball_frame(const ContactPoint& point, const dts::BodyMotion<double>& body,
                              const contact::TilePoint& tile) {
  if (point.radius == 0.) return {};
  return {quaternion_from(body.R_WB), tile.normal};
}

}  // namespace hookpoint::simulation
