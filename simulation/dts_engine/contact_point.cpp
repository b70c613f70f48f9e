#include "simulation/dts_engine/contact_point.h"

#include <algorithm>
#include <limits>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Width of the surface to either side [m]: above the rounding of positions, far below any depth
/// that matters.
constexpr double surface = 1e-11;

}  // namespace

std::vector<BoundaryPoint> boundary_points(const RobotSpec& robot) {
  std::vector<BoundaryPoint> points;
  std::size_t at = 0;
  for_each_body(robot, [&](const BodySpec& body) {
    const std::size_t number = at++;
    if (number == 0 && !robot.mobile) return;
    for (std::size_t i = 0; i < body.boundary_points.size(); ++i)
      points.push_back(
          {number, body.boundary_points[i], body.boundary_radius(i), body.boundary_material(i)});
  });
  return points;
}

ContactKinematics contact_kinematics(const ContactPoint& point, const dts::BodyMotion<double>& body,
                                     const contact::Terrain& ground) {
  const Vector3d center = body.R_WB * point.p_BP;
  ContactKinematics touching{body.p_WB + center, body.v_WB + cross(body.w_WB, center),
                             ground.query(body.p_WB + center)};
  if (point.radius == 0.) return touching;
  const Vector3d to_surface = -point.radius * touching.tile.normal;
  touching.position += to_surface;
  touching.velocity += cross(body.w_WB, to_surface);
  touching.tile.depth += point.radius;
  return touching;
}

double depth_on_side(bool inside, double depth_now, double reach) {
  const double within = depth_now + reach;
  return (inside ? std::max(within, std::numeric_limits<double>::min()) : std::min(within, 0.)) -
         reach;
}

double ContactPoint::side_event(double depth_now, double reach) const {
  return depth_now + reach + (inside ? surface : -surface);
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
