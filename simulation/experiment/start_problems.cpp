#include "simulation/experiment/start_problems.h"

#include <fmt/format.h>

namespace hookpoint::simulation {
namespace {

constexpr const char* fixed_base =
    "a Base.fixed does not move; make it a Base.mobile or leave this out";

std::array<double, 3> parts(const Vector3d& a) { return {a.x, a.y, a.z}; }

}  // namespace

std::string velocity_problem(const RobotSpec& robot) {
  if (!robot.mobile) return robot.velocity == Vector3d{} ? "" : fixed_base;
  if (!robot.plane_normal || parts(robot.velocity)[*robot.plane_normal] == 0.) return "";
  return fmt::format("this leads out of the plane {} that the base is kept in",
                     planes[*robot.plane_normal]);
}

std::string angular_velocity_problem(const RobotSpec& robot) {
  if (!robot.mobile) return robot.angular_velocity == Vector3d{} ? "" : fixed_base;
  if (!robot.plane_normal) return "";
  const std::size_t normal = *robot.plane_normal;
  std::array turning = parts(robot.angular_velocity);
  turning[normal] = 0.;
  if (turning == std::array{0., 0., 0.}) return "";
  return fmt::format("a base in the plane {} turns about {} alone", planes[normal], "xyz"[normal]);
}

std::string angle_problem(const LinkSpec& link) {
  const bool below = link.lower_limit && link.angle < *link.lower_limit;
  const bool above = link.upper_limit && link.angle > *link.upper_limit;
  if (!below && !above) return "";
  return fmt::format("the joint starts at angle {:g}, {} of {:g}; start it within its limits",
                     link.angle, below ? "below its lower_limit" : "above its upper_limit",
                     below ? *link.lower_limit : *link.upper_limit);
}

}  // namespace hookpoint::simulation
