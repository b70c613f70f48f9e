// Metrics of walking on motions whose answers are known by hand: a body with one leg of one link is
// moved over a slope; no engine runs here.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "studies/measure/metric.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;
using simulation::WorldState;

constexpr double pi = std::numbers::pi;
constexpr double height = 0.2;

/// Rises by `angle` along x; the base `height` over it, parallel to it. Two legs of one link with
/// two boundary points, at its origin and 1 cm further in z.
Experiment walker(double angle) {
  Experiment experiment;
  experiment.materials.resize(1);
  experiment.deltat = 0.01;
  simulation::TerrainSpec terrain;
  terrain.surface = contact::SlopeSurface{angle, pi};
  experiment.terrain = terrain;
  simulation::RobotSpec robot;
  robot.mobile = true;
  robot.base.mass = {1., {}, {1., 1., 1., 0., 0., 0.}};
  robot.orientation = exponential(Vector3d{0., -angle, 0.});
  robot.location = height * rotate(robot.orientation, Vector3d{0., 0., 1.});
  simulation::ChainSpec chain;
  chain.links.resize(1);
  chain.links[0].body.boundary_points = {{0., 0., 0.}, {0., 0., 0.01}};
  robot.chains = {chain, chain};
  experiment.robots.push_back(robot);
  return experiment;
}

/// Directions of the slope.
struct Axes {
  Vector3d along, normal;
  explicit Axes(const RunContext& context)
      : along(rotate(context.robot_spec().orientation, Vector3d{1., 0., 0.})),
        normal(rotate(context.robot_spec().orientation, Vector3d{0., 0., 1.})) {}
};

using Move = std::function<void(const Axes&, WorldState&)>;

/// Which of the two legs are to stand at a step; none: no gait tells.
using Command = std::function<std::array<double, 2>(std::int64_t step)>;

/// Shows `metric` the states that `move` writes at every step; feet are in the air unless it says
/// otherwise.
std::optional<double> measure(std::string_view name, double angle, const Move& move,
                              const Command& command = {}) {
  const Experiment experiment = walker(angle);
  const RunContext context = make_context(experiment, 1., 3.);
  const auto metric = find_metric(name)->make(context);
  Observer observer(context, false, true);
  const Axes axes(context);
  WorldState world;
  world.bodies.resize(3);
  world.joints.resize(2);
  std::array<double, 2> stands{};
  const std::array<const double*, 2> stance{stands.data(), stands.data() + 1};
  for (int step = 0; step <= 300; ++step) {
    world.step = step;
    world.time = step * experiment.deltat;
    world.bodies[0].position = context.start;
    for (auto& body : world.bodies) body.orientation = experiment.robots[0].orientation;
    for (std::size_t leg : {1, 2}) world.bodies[leg].position = 0.1 * axes.normal;
    move(axes, world);
    Observation observation = observer.observe(world);
    if (command) stands = command(step);
    if (command) observation.stance = stance;
    metric->observe(observation);
  }
  return metric->value();
}

/// 0.3 m/s up the slope and 0.1 m/s sideways.
void stroll(const Axes& axes, WorldState& world) {
  world.bodies[0].position += world.time * (0.3 * axes.along + Vector3d{0., 0.1, 0.});
}

/// From 2 s on the base is lowered along the slope's normal to this part of its height.
Move lowered(double share) {
  return [share](const Axes& axes, WorldState& world) {
    stroll(axes, world);
    if (world.time >= 2.) world.bodies[0].position += (share - 1.) * height * axes.normal;
  };
}

/// From 2 s on the base leans about its y.
Move leaning(double angle) {
  return [angle](const Axes& axes, WorldState& world) {
    stroll(axes, world);
    if (world.time >= 2.)
      world.bodies[0].orientation =
          world.bodies[0].orientation * exponential(Vector3d{0., angle, 0.});
  };
}

TEST(WalkedDistance, IsAlongTheHeadingSinceSettle) {
  EXPECT_NEAR(*measure("walked_distance", 0.3, stroll), 0.6, 1e-12);
  EXPECT_NEAR(*measure("walking_speed", 0.3, stroll), 0.3, 1e-12);
}

TEST(Fell, BelowHalfTheHeightOverTheSlope) {
  EXPECT_EQ(*measure("fell", 0.3, stroll), 0.);
  EXPECT_EQ(*measure("fell", 0.3, lowered(0.51)), 0.);
  EXPECT_EQ(*measure("fell", 0.3, lowered(0.49)), 1.);
}

TEST(Fell, BeyondSixtyDegrees) {
  EXPECT_EQ(*measure("fell", 0.3, leaning(59. * pi / 180.)), 0.);
  EXPECT_EQ(*measure("fell", 0.3, leaning(61. * pi / 180.)), 1.);
  EXPECT_EQ(*measure("fell", 0.3, leaning(-61. * pi / 180.)), 1.);
}

TEST(Fell, EndsTheWalk) {
  // The last step before the fall is at 1.99 s.
  EXPECT_NEAR(*measure("walked_distance", 0.3, lowered(0.4)), 0.3 * 0.99, 1e-12);
  EXPECT_FALSE(measure("walking_speed", 0.3, lowered(0.4)));
  EXPECT_FALSE(measure("foot_slip", 0.3, lowered(0.4)));
  EXPECT_NEAR(*measure("body_height_min", 0.3, lowered(0.4)), height, 1e-12);
}

TEST(BodyHeightMin, IsAlongTheNormal) {
  EXPECT_NEAR(*measure("body_height_min", 0.3, lowered(0.75)), 0.75 * height, 1e-12);
}

TEST(TiltMax, IsFromTheAttitudeAtTheStart) {
  EXPECT_NEAR(*measure("tilt_max", 0.3, leaning(0.2)), 0.2, 1e-12);
  EXPECT_NEAR(*measure("tilt_max", 0.3, stroll), 0., 1e-12);
}

TEST(FootSlip, IsThePathInTheGroundPerWayWalked) {
  // One foot is 1 mm in the ground for half of each 0.1 s and shuffles to and fro by 2 mm a step
  // there: 4 steps a stance, 20 stances after settle. The other foot drags all the way, at 0.3 m/s
  // over 2 s, 5 cm over the ground: no slip.
  const auto shuffling = [](const Axes& axes, WorldState& world) {
    stroll(axes, world);
    const bool stands = world.step % 10 < 5;
    // Each stance is 5 cm further on, which is no slip.
    const double shift = (world.step % 2 == 0 ? 0. : 0.002) + 0.05 * double(world.step / 10);
    world.bodies[1].position = (stands ? -0.001 : 0.05) * axes.normal + shift * axes.along;
    world.bodies[2].position = 0.05 * axes.normal + 0.3 * world.time * axes.along;
  };
  // Of the two boundary points the foot's is the one that is in the ground.
  EXPECT_NEAR(*measure("foot_slip", 0.3, shuffling), 20. * 4. * 0.002 / 2. / 0.6, 1e-12);
  EXPECT_EQ(*measure("foot_slip", 0.3, stroll), 0.);
}

TEST(FootSlip, NeedsAWay) {
  EXPECT_FALSE(measure("foot_slip", 0.3, [](const Axes&, WorldState&) {}));
}

/// Leg 0 is to stand in the first 20 of each 40 steps, leg 1 never.
std::array<double, 2> stand_and_swing(std::int64_t step) { return {step % 40 < 20 ? 1. : 0., 0.}; }

/// Foot 0 in stance: 1 mm in the ground, but for the steps 5 to 7, 3 mm over it, and step 12, 1 mm
/// over it. It goes on by 4 mm while it is over it for the first time, by 0.5 mm back at step 10,
/// and sways sideways by 2 mm and back in steps 14 and 15. In the swing it is in the ground too,
/// then goes 8 cm on.
void hop(const Axes& axes, WorldState& world) {
  stroll(axes, world);
  const auto at = static_cast<int>(world.step % 40);
  double depth = 0.001, along = 0.08 * double(world.step / 40), sideways = 0.;
  if (at >= 5 && at < 8) depth = -0.003;
  if (at == 12) depth = -0.001;
  if (at >= 6) along += 0.004;
  if (at >= 10) along -= 0.0005;
  if (at == 14) sideways = 0.002;
  if (at >= 25) depth = -0.02;
  world.bodies[1].position = -depth * axes.normal + along * axes.along + Vector3d{0., sideways, 0.};
}

TEST(Stance, LossesLiftSlipAndDepthAreOfWholeStances) {
  EXPECT_EQ(*measure("hook_losses", 0.3, hop, stand_and_swing), 2.);
  EXPECT_NEAR(*measure("stance_lift", 0.3, hop, stand_and_swing), 0.003, 1e-12);
  EXPECT_NEAR(*measure("stance_slip", 0.3, hop, stand_and_swing), 0.0035, 1e-12);
  EXPECT_NEAR(*measure("stance_depth", 0.3, hop, stand_and_swing), 0.001, 1e-12);
}

TEST(Stance, AFootThatCarriesForceTouches) {
  // As a peer holds it: never in the ground, 10 um over it, without force in step 9 of the stance.
  const auto held = [](const Axes& axes, WorldState& world) {
    hop(axes, world);
    world.bodies[1].position = 1e-5 * axes.normal;
    world.bodies[1].contacts = world.step % 40 == 9 ? 0 : 1;
  };
  EXPECT_EQ(*measure("hook_losses", 0.3, held, stand_and_swing), 1.);
  EXPECT_EQ(*measure("stance_slip", 0.3, held, stand_and_swing), 0.);
}

TEST(Stance, CountsAStanceWithATouchOnly) {
  // From 2 s on the foot is over the ground all the time: of five whole stances two are left.
  const auto over = [](const Axes& axes, WorldState& world) {
    hop(axes, world);
    if (world.time >= 2.) world.bodies[1].position = 0.05 * axes.normal;
  };
  EXPECT_EQ(*measure("hook_losses", 0.3, over, stand_and_swing), 2.);
  EXPECT_FALSE(measure("hook_losses", 0.3, stroll, stand_and_swing));
}

TEST(Stance, NeedsAGait) { EXPECT_FALSE(measure("hook_losses", 0.3, hop)); }

TEST(CostOfTransport, IsTheWorkWhicheverWayPerWeightAndWay) {
  // One joint turns to and fro by 0.01 rad a step against 3 N m: 200 steps after settle, 6 J. The
  // other exerts 5 N m and does not turn. 1 kg goes 0.6 m.
  const auto working = [](const Axes& axes, WorldState& world) {
    stroll(axes, world);
    world.joints[0].angle = world.step % 2 == 0 ? 0. : 0.01;
    world.joints[0].torque = 3.;
    world.joints[1].torque = 5.;
  };
  EXPECT_NEAR(*measure("cost_of_transport", 0.3, working), 6. / (9.81 * 0.6), 1e-12);
  EXPECT_FALSE(measure("cost_of_transport", 0.3, [](const Axes&, WorldState&) {}));
}

TEST(Points, AreThoseOfTheLinksToo) {
  const Experiment experiment = walker(0.);
  const RunContext context = make_context(experiment, 0., 1.);
  Observer observer(context, true);
  WorldState world;
  world.bodies.resize(3);
  world.bodies[1].position = {0., 0., -0.002};
  world.bodies[2].position = {0., 0., 1.};
  const Observation observation = observer.observe(world);
  ASSERT_EQ(observation.points.size(), 4U);
  EXPECT_NEAR(observation.points[0].depth, 0.002, 1e-15);
  EXPECT_NEAR(observation.points[1].depth, -0.008, 1e-15);
  EXPECT_NEAR(observation.points[3].position.z, 1.01, 1e-15);
}

}  // namespace
}  // namespace hookpoint::studies
