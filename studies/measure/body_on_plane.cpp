#include "studies/measure/body_on_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/terrain/footprint.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::studies {
namespace {

using simulation::Pose;

/// Part of the weight [N], or of its moment about 1 m [N m], below which gravity does not load a
/// joint: rounding.
constexpr double rounding_load = 1e-9;

constexpr const char* turns_at_the_start = "the robot turns at the start";

/// X_WB at the start, of a robot that starts in balance before it leaned: closed forms find its
/// lean by themselves.
Pose level_pose(const simulation::RobotSpec& robot) {
  return robot.settled ? Pose{robot.settled->level_location, robot.settled->level_orientation}
                       : Pose{robot.location, robot.orientation};
}

/// X_WB of every body there.
std::vector<Pose> world_poses(const simulation::RobotSpec& robot) {
  const Pose base = level_pose(robot);
  std::vector<Pose> poses = simulation::body_poses(robot);
  for (Pose& pose : poses) pose = base * pose;
  return poses;
}

/// The places at which the bodies of a robot may touch, world axes; `bodies` gets the body of each.
std::vector<contact::Foot> feet_of(const simulation::RobotSpec& robot,
                                   const std::vector<Pose>& X_WB,
                                   std::vector<std::size_t>& bodies) {
  std::vector<contact::Foot> feet;
  std::size_t body = 0;
  simulation::for_each_body(robot, [&](const simulation::BodySpec& spec) {
    const Pose& X_WL = X_WB[body];
    for (std::size_t i = 0; i < spec.boundary_points.size(); ++i) {
      feet.push_back({X_WL.position + rotate(X_WL.orientation, spec.boundary_points[i]),
                      spec.boundary_radius(i), feet.size()});
      bodies.push_back(body);
    }
    ++body;
  });
  return feet;
}

/// What acts on a part of a robot: a force, and its moment about the origin of a body.
struct Load {
  Vector3d force, moment;
};

/// Adds `force` at `point` of `body` to the loads of all joints that carry it.
void add_load(std::vector<Load>& loads, const std::vector<std::size_t>& carriers,
              const std::vector<Pose>& X_WB, std::size_t body, const Vector3d& point,
              const Vector3d& force) {
  for (; body > 0; body = carriers[body]) {
    loads[body].force += force;
    loads[body].moment += cross(point - X_WB[body].position, force);
  }
}

/// Why the joints of a robot that stands on the ground do not rest by themselves; "" where they do.
std::string why_joints_move(const RunContext& context, const std::vector<Pose>& X_WB) {
  const simulation::RobotSpec& robot = context.robot_spec();
  const Vector3d& g = context.experiment->gravity;
  const std::vector<std::size_t> carriers = simulation::carriers_of(robot);
  std::vector<Load> of_gravity(X_WB.size()), of_ground(X_WB.size());
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const simulation::MassSpec& mass = at.link.body.mass;
    const Pose& X_WL = X_WB[at.body];
    add_load(of_gravity, carriers, X_WB, at.body,
             X_WL.position + rotate(X_WL.orientation, mass.center_of_mass), mass.mass * g);
  });
  std::vector<std::size_t> bodies;
  const std::vector<contact::Foot> feet = feet_of(robot, X_WB, bodies);
  for (const contact::Foot& foot : contact::footprint_of(feet, context.normal).feet)
    add_load(of_ground, carriers, X_WB, bodies[foot.index], foot.position,
             context.weight * context.normal);
  std::string why;
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const simulation::LinkSpec& link = at.link;
    const bool turns = simulation::joint_type(link.joint).turns;
    const Vector3d axis = rotate(X_WB[at.body].orientation, Vector3d{0., 0., 1.});
    const auto loaded = [&](const Load& load) {
      return std::abs(dot(axis, turns ? load.moment : load.force)) > rounding_load * context.weight;
    };
    if (!why.empty()) return;
    const std::string joint = "the joint of " + at.chain.name + "." + link.body.name;
    if (link.rate != 0. || link.torque != 0. ||
        (link.stiffness != 0. && link.angle != link.rest_angle))
      why = joint + " moves at the start";
    else if (loaded(of_gravity[at.body]))
      why = "gravity loads " + joint;
    else if (loaded(of_ground[at.body]))
      why = "the ground loads " + joint;
  });
  return why;
}

/// Where the measured robot touches its plane at the start.
contact::Footprint footprint_at_start(const RunContext& context) {
  std::vector<std::size_t> bodies;
  const std::vector<contact::Foot> feet =
      feet_of(context.robot_spec(), world_poses(context.robot_spec()), bodies);
  return contact::footprint_of(feet, context.normal);
}

/// What carries a robot that has come to rest on its plane.
struct Stand {
  contact::Footprint footprint;
  bool uneven = false;  ///< contacts are not level: the robot tilts as it comes to rest
};

/// Of contacts at different heights those that carry a rigid body, each on the same linear spring:
/// depths d_i = a + b x_i + c y_i - h_i, x along the fall and y across it from the centre of mass,
/// at the least of sum k max(0, d_i)^2/2 - N a - M b, M the moment of the friction that holds the
/// body. Empty where it tips over.
contact::Footprint carrying(const RunContext& context, const contact::Footprint& near) {
  const simulation::RobotSpec& robot = context.robot_spec();
  const Vector3d& n = context.normal;
  const Vector3d across = cross(n, context.downhill);
  const Pose X_WB = level_pose(robot);
  const Vector3d center = X_WB.position + rotate(X_WB.orientation, robot.base.mass.center_of_mass);
  double lowest = std::numeric_limits<double>::infinity();
  for (const contact::Foot& foot : near.feet) lowest = std::min(lowest, dot(foot.position, n));
  struct Spring {
    double x, y, height;
  };
  std::vector<Spring> springs;
  double size = 0., load = 0.;
  for (const contact::Foot& foot : near.feet) {
    const Vector3d arm = foot.position - center;
    springs.push_back(
        {dot(arm, context.downhill), dot(arm, across), dot(foot.position, n) - lowest});
    size = std::max(size, norm(tangential(arm, n)));
  }
  const Vector3d weight = robot.base.mass.mass * context.experiment->gravity;
  load = -dot(weight, n);
  const double rise = dot(center, n) - lowest;
  const Vector3d wanted{load, norm(tangential(weight, n)) * rise, 0.};
  const auto* const law = contact::find_force_law(context.experiment->contact);
  const int material = context.ground->query(context.start).material;
  const bool ours = context.experiment->engine == "dts" && law;
  constexpr double rigid = 1e-6;  // [m]
  const double depth =
      ours ? law->static_depth(
                 load, context.experiment->materials[static_cast<std::size_t>(material)].constants)
           : rigid;
  const double stiffness = load / depth;
  const auto depth_of = [](const Spring& spring, const Vector3d& plane) {
    return plane.x + plane.y * spring.x + plane.z * spring.y - spring.height;
  };
  const auto energy = [&](const Vector3d& plane) {
    double sum = -dot(wanted, plane);
    for (const Spring& spring : springs) {
      const double d = std::max(0., depth_of(spring, plane));
      sum += 0.5 * stiffness * d * d;
    }
    return sum;
  };
  Vector3d plane{depth, 0., 0.};
  constexpr int most_steps = 200;
  for (int i = 0; i < most_steps; ++i) {
    // One point or two leave a direction without curvature: enough is added to invert it.
    constexpr double added = 1e-6;
    Symmetric3d curvature{added, added * size * size, added * size * size, 0., 0., 0.};
    Vector3d left = wanted;
    for (const Spring& spring : springs) {
      const double d = depth_of(spring, plane);
      if (!(d > 0.)) continue;
      left -= stiffness * d * Vector3d{1., spring.x, spring.y};
      curvature += Symmetric3d{1.,       spring.x * spring.x, spring.y * spring.y, spring.x,
                               spring.y, spring.x * spring.y};
    }
    const bool rests =
        std::abs(left.x) <= 1e-9 * load && std::hypot(left.y, left.z) <= 1e-9 * load * size;
    if (rests) {
      constexpr double steepest = 0.02;  // [rad]: beyond, the body stands otherwise
      if (std::hypot(plane.y, plane.z) > steepest) return {};
      contact::Footprint footprint;
      for (std::size_t k = 0; k < springs.size(); ++k)
        if (depth_of(springs[k], plane) > 0.) footprint.feet.push_back(near.feet[k]);
      return footprint;
    }
    Vector3d step = (1. / stiffness) * (inverse(curvature) * left);
    // Near the least energy a step changes it by less than its rounding.
    const double before = energy(plane);
    const double most = before + 1e-12 * (std::abs(before) + load * depth);
    for (int halved = 0; halved < 60 && energy(plane + step) > most; ++halved) step = 0.5 * step;
    plane += step;
  }
  return {};
}

Stand stand_of(const RunContext& context) {
  const contact::Footprint lowest = footprint_at_start(context);
  if (!lowest.in_line()) return {lowest, false};
  std::vector<std::size_t> bodies;
  const std::vector<contact::Foot> feet =
      feet_of(context.robot_spec(), world_poses(context.robot_spec()), bodies);
  double size = 0.;
  for (const contact::Foot& foot : feet)
    size = std::max(size, norm(tangential(foot.position - feet.front().position, context.normal)));
  constexpr double slight = 0.02;  // of the size: what a small tilt brings down
  const contact::Footprint near = contact::footprint_of(feet, context.normal, slight * size);
  if (near.feet.size() == lowest.feet.size()) return {lowest, false};
  contact::Footprint carried = carrying(context, near);
  if (carried.feet.empty()) return {lowest, false};
  return {std::move(carried), true};
}

/// "contact point d": the last part of its trail; "a corner" of a shape that has no name.
std::string name_of_point(const RunContext& context, std::size_t point) {
  for (const simulation::PointSpec& named : context.experiment->points)
    if (named.robot == context.robot && named.body == 0 && named.point == static_cast<int>(point))
      return "contact point " + named.trail.substr(named.trail.rfind('.') + 1);
  return "a boundary point";
}

/// Why a single body can roll on its ground; "" where it cannot.
std::string why_it_rolls(const RunContext& context) {
  const contact::Footprint footprint = stand_of(context).footprint;
  if (!footprint.rolls()) return "";
  const auto ball = std::ranges::find_if(
      footprint.feet, [](const contact::Foot& foot) { return foot.radius > 0.; });
  const std::string name = name_of_point(context, ball->index);
  if (footprint.feet.size() == 1) return "the body rolls: " + name + " is a ball";
  return "the body rolls: " + name + " is a ball, and all contacts lie on one line";
}

}  // namespace

double BodyOnPlane::slip_acceleration() const {
  return contact::slip_acceleration(gravity, std::atan2(sine, cosine), material.kinetic_friction);
}

bool BodyOnPlane::friction_drops() const {
  if (!(material.static_friction > material.kinetic_friction)) return false;
  // A law with Stribeck's curve has friction fall with speed instead.
  return !peer && !(law && law->reads(&contact::Constants::stribeck_speed));
}

bool BodyOnPlane::linear_normal_force() const {
  const double once = law->static_depth(normal_load(), material);
  const double twice = law->static_depth(2. * normal_load(), material);
  return std::abs(twice - 2. * once) <= 1e-12 * once;
}

double BodyOnPlane::tangential_stiffness() const {
  return law ? contacts() * law->linearise(normal_load(), material).tangential_stiffness : 0.;
}

double BodyOnPlane::overshoot() const {
  if (settled) return 1.;
  const double stiffness = tangential_stiffness();
  if (stiffness == 0.) return 1.;
  // Of x'' + 2 zeta w x' + w^2 x = w^2 from rest, x + 2 zeta x'/w is at most 1 + e, e the rebound
  // of the same spring and damper: both are exp(-2 zeta acos(zeta)/sqrt(1 - zeta^2)).
  const double damping = contacts() * law->linearise(normal_load(), material).tangential_damping;
  return 1. + contact::kelvin_voigt_restitution(damping / (2. * std::sqrt(stiffness * mass)));
}

std::optional<NormalLoads> BodyOnPlane::normal_loads(double moment, const Vector3d& along,
                                                     const Vector3d& normal) const {
  if (uneven) return std::nullopt;
  contact::Footprint places;
  for (const Vector3d& point : footprint) places.feet.push_back({point});
  const double weight = normal_load() * contacts();
  if (footprint.size() == 1) {
    // Its body has to balance on it: the load's moment about the point, over the weight, is an arm.
    constexpr double balanced = 1e-9;  // [m]
    const bool stands =
        norm(footprint.front() - moment / weight * along) <= balanced + 1e-9 * std::abs(height);
    return stands ? std::optional(NormalLoads{{weight}, 0.}) : std::nullopt;
  }
  if (places.in_line()) return std::nullopt;
  const Vector3d across = cross(normal, along);
  Symmetric3d sums;
  for (const Vector3d& point : footprint) {
    const double x = dot(point, along), y = dot(point, across);
    sums += Symmetric3d{1., x * x, y * y, x, y, x * y};
  }
  const Vector3d plane = inverse(sums) * Vector3d{weight, moment, 0.};
  NormalLoads loads{{}, plane.z};
  for (const Vector3d& point : footprint) {
    loads.at_points.push_back(plane.x + plane.y * dot(point, along) + plane.z * dot(point, across));
    if (!(loads.at_points.back() > 0.)) return std::nullopt;
  }
  return loads;
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

std::string not_alone_on_plane(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  if (!experiment.terrain) return "there is no ground";
  if (std::holds_alternative<contact::GridSurface>(experiment.terrain->surface))
    return "the ground is a grid of heights, no plane";
  if (experiment.robots.size() != 1) return "the scene has more than one robot";
  if (!experiment.forces.empty()) return "the Force " + experiment.forces.front().name + " acts";
  if (!robot.mobile) return "the robot's base is fixed";
  if (!moves_as_if_free(context))
    return "the plane that keeps the robot's base does not hold gravity and the ground's normal";
  if (robot.base.boundary_points.empty()) return "the robot's base has nothing that touches";
  return "";
}

std::string not_one_rigid_body(const RunContext& context) {
  if (std::string why = not_alone_on_plane(context); !why.empty()) return why;
  if (!context.robot_spec().chains.empty()) return "the robot has chains";
  if (norm(context.robot_spec().angular_velocity) > 0.) return turns_at_the_start;
  return why_it_rolls(context);
}

bool is_ball(const RunContext& context) {
  const simulation::RobotSpec& robot = context.robot_spec();
  return robot.chains.empty() && robot.base.boundary_points.size() == 1 &&
         robot.base.boundary_radius(0) > 0.;
}

std::string not_resting_as_one_body(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  if (std::string why = not_alone_on_plane(context); !why.empty()) return why;
  if (norm(robot.angular_velocity) > 0.) return turns_at_the_start;
  const bool level = norm(tangential(experiment.gravity, context.normal)) <=
                     rounding_load * norm(experiment.gravity);
  const bool single = robot.chains.empty();
  if (!level) return single ? why_it_rolls(context) : "the robot has chains and the ground slopes";
  if (norm(robot.velocity) > 0.)
    return single ? why_it_rolls(context) : "the robot has chains and moves at the start";
  if (single) return "";
  if (!experiment.components.empty()) return "controllers may move the joints";
  return why_joints_move(context, world_poses(robot));
}

double lowest_gap(const RunContext& context) {
  const contact::Footprint footprint = footprint_at_start(context);
  return footprint.feet.empty() ? 0. : height_over_ground(context, footprint.feet.front().position);
}

BodyOnPlane body_on_plane(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::RobotSpec& robot = context.robot_spec();
  BodyOnPlane body;
  body.gravity = norm(experiment.gravity);
  body.cosine = -dot(experiment.gravity, context.normal) / body.gravity;
  body.sine = norm(tangential(experiment.gravity, context.normal)) / body.gravity;
  body.settled = robot.settled.has_value();
  body.speed = body.settled ? 0. : norm(tangential(robot.velocity, context.normal));
  body.peer = experiment.engine != "dts";
  if (!body.peer) body.law = contact::find_force_law(experiment.contact);
  const int material = context.ground->query(context.start).material;
  body.material = experiment.materials[static_cast<std::size_t>(material)].constants;
  if (context.one_friction) body.material.static_friction = body.material.kinetic_friction;

  const std::vector<const simulation::BodySpec*> bodies = simulation::bodies_of(robot);
  const std::vector<Pose> poses = world_poses(robot);
  Vector3d moment;
  std::size_t points = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const simulation::MassSpec& mass = bodies[i]->mass;
    body.mass += mass.mass;
    moment += mass.mass * (poses[i].position + rotate(poses[i].orientation, mass.center_of_mass));
    points += bodies[i]->boundary_points.size();
  }
  const Vector3d center = (1. / body.mass) * moment;
  body.single_point = points == 1;
  const Stand stand = stand_of(context);
  body.uneven = stand.uneven;
  for (const contact::Foot& foot : stand.footprint.feet) {
    body.footprint.push_back(tangential(foot.position - center, context.normal));
    body.height = dot(center - foot.position, context.normal);
    body.gap = -context.ground->query(foot.position).depth;
  }
  return body;
}

}  // namespace hookpoint::studies
