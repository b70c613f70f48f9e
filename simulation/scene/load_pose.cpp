#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact/force_law.h"
#include "contact/terrain/terrain.h"
#include "simulation/analysis/resting_state.h"
#include "simulation/analysis/start_depth.h"
#include "simulation/experiment/contact_materials.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

/// Depth at which `count` points bear the robot's weight across the tile: m g cos / n each. A peer,
/// and a law without penetration, starts touching.
double resting_depth(const RobotSpec& robot, int count, int foot_material,
                     const contact::TilePoint& tile, const Experiment& experiment) {
  const contact::LawDescription* law = contact::find_force_law(experiment.contact);
  const double load = -robot_mass(robot) * dot(experiment.gravity, tile.normal) / count;
  if (experiment.engine != "dts" || !law || !(load > 0.)) return 0.;
  const auto material = contact_constants(experiment, foot_material, tile.material);
  return law->static_depth(load + material.adhesion, material);
}

/// How much the robot has to rise for its deepest boundary point to be at `depth` [m]: a point that
/// moves straight up stays over its tile.
double rise_to_depth(const contact::Terrain& ground, const std::vector<RobotPoint>& points,
                     const RobotSpec& robot, double depth) {
  double rise = -std::numeric_limits<double>::infinity();
  for (const RobotPoint& point : points) {
    const contact::TilePoint tile =
        ground.query(robot.location + rotate(robot.orientation, point.p_BP));
    rise = std::max(rise, (tile.depth + point.radius - depth) / tile.normal.z);
  }
  return rise;
}

/// Lays the robot down: its base's z along the tile's normal, so that heights over the tile are z
/// in base axes.
void lay_down(const language::Object& base, const contact::Terrain& ground, RobotSpec& robot,
              Loading& loading) {
  const std::vector<RobotPoint> points = points_in_base(robot);
  if (points.empty()) {
    const bool drawn = std::ranges::any_of(bodies_of(robot), [](const BodySpec* body) {
      return !body->shapes_without_contact.empty();
    });
    return loading.error(
        place_of(base, base_field::rest_on),
        fmt::format("`{}` has no boundary points to rest on; {}", robot.name,
                    drawn
                        ? "none of its shapes touches (`contact = false`): let one touch, or give "
                          "it a ContactPoint"
                        : "give it a shape or a ContactPoint"));
  }
  double lowest = std::numeric_limits<double>::infinity();
  const auto bottom = [](const RobotPoint& point) { return point.p_BP.z - point.radius; };
  int foot_material = no_material;  // of the lowest point
  for (const RobotPoint& point : points) {
    if (bottom(point) >= lowest) continue;
    lowest = bottom(point);
    foot_material = point.material;
  }
  constexpr double coplanar = 1e-9;  // [m]
  const auto count = std::ranges::count_if(
      points, [&](const RobotPoint& point) { return bottom(point) <= lowest + coplanar; });
  const std::vector<double>& at = base.numbers(base_field::at);
  const contact::TilePose pose = ground.pose_on_tile(at[0], at[1], base.number(base_field::yaw));
  const double depth =
      resting_depth(robot, static_cast<int>(count), foot_material, pose.tile, loading.experiment);
  // n . (p_WB + lowest n - p_tile) = -depth, with p_WB straight above p_tile.
  robot.location = pose.position;
  robot.location.z -= (depth + lowest) / pose.tile.normal.z;
  robot.orientation = pose.orientation;
  // Beside its tile uneven ground is higher or lower.
  if (std::holds_alternative<GridSpec>(ground.description().surface)) {
    robot.location.z += rise_to_depth(ground, points, robot, depth);
  }
}

/// What keeps `settled = true` from doing all that it says, although there may be a balance; "" where
/// nothing does.
std::string limit_of_settling(const RobotSpec& robot, const Experiment& experiment) {
  if (experiment.engine != Experiment{}.engine)
    return fmt::format("engine {} starts with contacts that bear nothing yet", experiment.engine);
  if (!contact::find_force_law(experiment.contact))
    return fmt::format("contact law {} has no springs to stretch", experiment.contact);
  const auto index = static_cast<int>(&robot - experiment.robots.data());
  const auto force = std::ranges::find(experiment.forces, index, &ForceSpec::robot);
  if (force != experiment.forces.end())
    return fmt::format("the balance is that of its weight, without Force `{}`", force->name);
  return "";
}

/// Brings the robot from where it was laid into static balance. Where there is none, only a file
/// that says `settled = true` is warned: a slope that is too steep or a ball is meant to move.
void settle(const language::Object& base, const contact::Terrain& ground, RobotSpec& robot,
            Loading& loading) {
  const bool written = base.given(base_field::settled);
  // Joints whose torques start at 0 deflect under the load: a balance of the base alone does not
  // last, and is there only for a file that says so.
  if (!written && !robot.chains.empty()) return;
  const Resting resting = resting_state(loading.experiment, robot, ground);
  if (!resting.problem.empty() && written)
    loading.diagnostics.warning(
        place_of(base, base_field::settled),
        fmt::format("`{}` cannot start settled, and starts level on its points: {}", robot.name,
                    resting.problem));
  const std::string limit = limit_of_settling(robot, loading.experiment);
  if (written && !limit.empty() && !loading.serves_study)
    loading.diagnostics.warning(
        place_of(base, base_field::settled),
        fmt::format("`{}` moves at the start in spite of `settled = true`: {}", robot.name, limit));
  if (!resting.state) return;
  // A law without tangential spring holds by creeping, which is no rest: it starts so only where
  // the file says so.
  if (resting.state->stretch.empty() && !written) return;
  robot.settled = {robot.location, robot.orientation, resting.state->stretch};
  robot.location = resting.state->location;
  robot.orientation = resting.state->orientation;
  robot.velocity = resting.state->velocity;
  robot.angular_velocity = resting.state->angular_velocity;
}

/// Where what touches is not what the robot stands on: bodies that lie below the ground.
void warn_of_bodies_below(const language::Object& base, const contact::Terrain& ground,
                          const RobotSpec& robot, Loading& loading) {
  const std::vector<Pose> poses = body_poses(robot);
  const std::vector<const BodySpec*> bodies = bodies_of(robot);
  // What touches penetrates the ground by its static depth: a point of mass lies as deep.
  constexpr double apart = 1e-6;  // [m]
  double deepest = apart;
  for (const RobotPoint& point : points_in_base(robot)) {
    const Vector3d p_WP = robot.location + rotate(robot.orientation, point.p_BP);
    deepest = std::max(deepest, ground.query(p_WP).depth + apart);
  }
  const double touching = deepest;
  std::size_t body = 0, below = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!(bodies[i]->mass.mass > 0.)) continue;
    const Vector3d p_BC =
        poses[i].position + rotate(poses[i].orientation, bodies[i]->mass.center_of_mass);
    const double depth = ground.query(robot.location + rotate(robot.orientation, p_BC)).depth;
    if (depth > touching) ++below;
    if (depth <= deepest) continue;
    deepest = depth;
    body = i;
  }
  if (below == 0) return;
  loading.diagnostics.warning(
      place_of(base, base_field::rest_on),
      fmt::format("`rest_on` puts the lowest point of `{}` that touches on the ground, and {} of "
                  "its {} bodies lie below the ground, `{}` by {:.3g} m: the bodies below have no "
                  "shapes; give them some (of a URDF: meshes = hull or shapes = inertia)",
                  robot.name, below, bodies.size(), body_names(robot)[body], deepest));
}

/// Of a robot whose base is free to fall and that has neither a shape that touches nor a ContactPoint.
void warn_of_none_that_touches(const language::Object& base, const RobotSpec& robot,
                               Loading& loading) {
  const Vector3d& gravity = loading.experiment.gravity;
  std::array weight{gravity.x, gravity.y, gravity.z};
  if (robot.plane_normal) weight[*robot.plane_normal] = 0.;
  if (!robot.mobile || weight == std::array{0., 0., 0.} || !points_in_base(robot).empty()) return;
  loading.diagnostics.warning(
      base.position, fmt::format("`{}` falls through the ground: nothing of it touches; give it a "
                                 "shape or a ContactPoint",
                                 robot.name));
}

/// One error a robot: the first of its boundary points that starts off the terrain.
void check_inside(const language::Object& base, const contact::Terrain& ground,
                  const RobotSpec& robot, Loading& loading) {
  for (const RobotPoint& point : points_in_base(robot)) {
    if (point.body == 0 && !robot.mobile) continue;  // a base held in the world touches nothing
    const Vector3d p_WP = robot.location + rotate(robot.orientation, point.p_BP);
    if (!ground.query(p_WP).outside) continue;
    const char* field = base.given(base_field::rest_on) ? base_field::at : base_field::location;
    return loading.error(
        place_of(base, field),
        fmt::format(
            "`{}` starts off the terrain `{}`: a boundary point of it is at x,y = {:g},{:g}; move "
            "the robot or enlarge the terrain",
            robot.name, loading.experiment.terrain->name, p_WP.x, p_WP.y));
  }
}

}  // namespace

void warn_of_start_depths(Loading& loading) {
  for (const StartDepth& start : start_depths(loading.experiment)) {
    const language::Object& base = *loading.bases[start.robot];
    const char* field =
        base.given(base_field::rest_on) ? base_field::rest_on : base_field::location;
    loading.diagnostics.warning(place_of(base, field), start.message);
  }
}

std::vector<bool> lay_on_terrain(Loading& loading) {
  std::vector<bool> laid(loading.experiment.robots.size());
  if (!loading.experiment.terrain) return laid;
  const contact::Terrain ground(*loading.experiment.terrain);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    const language::Object& base = *loading.bases[i];
    if (!base.given(base_field::rest_on)) continue;
    const std::size_t errors_before = loading.diagnostics.error_count();
    lay_down(base, ground, loading.experiment.robots[i], loading);
    laid[i] = loading.diagnostics.error_count() == errors_before;
  }
  return laid;
}

void settle_on_terrain(const std::vector<bool>& laid, Loading& loading) {
  if (!loading.experiment.terrain) return;
  const contact::Terrain ground(*loading.experiment.terrain);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    RobotSpec& robot = loading.experiment.robots[i];
    const language::Object& base = *loading.bases[i];
    if (laid[i] && base.boolean(base_field::settled)) settle(base, ground, robot, loading);
    if (laid[i]) warn_of_bodies_below(base, ground, robot, loading);
    if (!base.given(base_field::rest_on)) warn_of_none_that_touches(base, robot, loading);
    check_inside(base, ground, robot, loading);
  }
}

}  // namespace hookpoint::simulation
