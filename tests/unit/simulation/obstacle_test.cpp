// Obstacles: what a file says of them, and their motion, by closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using namespace simulation;

Experiment experiment_of(const std::string& parts) {
  const Loaded loaded = load_text("World w { touch = shapes; deltat = 1 ms; " + parts + " }");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return loaded.experiment.value_or(Experiment{});
}

/// Moves at (0.5, 0, -0.1) m/s and turns about z at 0.3 rad/s.
const std::string moving =
    "Obstacle.Box wall { dimensions = 0.1, 1, 0.5; location = 1, 2, 3; velocity = 0.5, 0, -0.1; "
    "angular_velocity = 0, 0, 0.3; }";

TEST(Obstacle, IsNoRobotUnlessItIsFree) {
  const Experiment experiment =
      experiment_of(moving +
                    "Obstacle.Capsule post { radius = 0.1; length = 0.4; } Obstacle.Sphere ball { "
                    "radius = 0.1; mass = 5; free = true; location = 0, 0, 9; }");
  ASSERT_EQ(experiment.obstacles.size(), 2u);
  EXPECT_EQ(std::get<Capsule>(experiment.obstacles[1].geometry).length, 0.4);
  ASSERT_EQ(experiment.robots.size(), 1u);
  const RobotSpec& ball = experiment.robots[0];
  EXPECT_EQ(ball.name, "ball");
  EXPECT_TRUE(ball.mobile);
  EXPECT_EQ(ball.location, (Vector3d{0., 0., 9.}));
  EXPECT_NEAR(ball.base.mass.inertia.xx, 0.02, 1e-16);  // 2/5 m r^2
  EXPECT_EQ(ball.base.boundary_radius(0), 0.1);
}

TEST(Obstacle, MovesWithItsVelocities) {
  const Experiment experiment = experiment_of(moving);
  World world(experiment, make_dts(experiment));
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(world.step().ok());
  const auto at = [&](const char* port) {
    return *find_port(experiment, world.ports(), port).value;
  };
  EXPECT_NEAR(at("wall.position.x"), 1.1, 1e-12);
  EXPECT_NEAR(at("wall.position.y"), 2., 1e-12);
  EXPECT_NEAR(at("wall.position.z"), 2.98, 1e-12);
  EXPECT_NEAR(at("wall.orientation.w"), std::cos(0.03), 1e-12);
  EXPECT_NEAR(at("wall.orientation.z"), std::sin(0.03), 1e-12);
}

TEST(Obstacle, TakesTheVelocityThatIsSetAndComesBackWithASavedState) {
  const Experiment experiment = experiment_of(moving);
  World world(experiment, make_dts(experiment));
  const Port z = find_port(experiment, world.ports(), "wall.position.z");
  const PortValue faster{"wall.velocity.z", 2.};
  const std::vector<Port> set = world.settable({&faster, 1});
  world.set(set[0], faster.value);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(world.step().ok());
  EXPECT_NEAR(*z.value, 3.2, 1e-12);
  std::vector<double> numbers(world.state_size());
  world.save(numbers);
  World other(experiment, make_dts(experiment));
  other.restore(numbers);
  const Port other_z = find_port(experiment, other.ports(), "wall.position.z");
  EXPECT_EQ(*other_z.value, *z.value);
  ASSERT_TRUE(world.step().ok());
  ASSERT_TRUE(other.step().ok());
  EXPECT_EQ(*other_z.value, *z.value);
}

}  // namespace
}  // namespace hookpoint
