// Obstacles and ground that move, in the window: live and from a movie they are where their
// velocities have taken them, and a run that is watched leaves the bytes of one that is not.
// ctest: clock
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/window_client.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::WindowClient;
using testing::Workplace;

constexpr double g = 9.81, dt = 1e-3;

/// A lift that turns about z, a post, a gate that turns about z, and a ball in free fall.
constexpr const char* yard = R"(
World w {
  gravity = 9.81; deltat = 1 ms; duration = 1 s;
  Material clay { normal_stiffness = 20 kN/m; }
  Terrain.Flat floor { material = clay; size = 2, 2; frame_velocity = 0, 0, -0.5; frame_angular_velocity = 0, 0, 0.4; }
  Obstacle.Box post { dimensions = 0.1, 0.1, 1; location = 1, 2, 3; orientation = 0, 0, pi/2; material = clay; }
  Obstacle.Cylinder gate { radius = 0.1; length = 1; location = -1, 0, 1; velocity = 0, 0.5, 0; angular_velocity = 0, 0, 0.6; }
  Obstacle.Sphere ball { radius = 0.1; mass = 1; free = true; location = 0, 0, 20; }
}
)";

class MovingScene : public ::testing::Test {
 protected:
  MovingScene() { place.file("yard.hook", yard); }

  void open(const std::vector<std::string>& words) {
    program = std::make_unique<ChildProcess>(place.folder(), words);
    ASSERT_TRUE(program->wait_until([&] { return program->out().find('\n') != std::string::npos; }))
        << program->err();
    const std::string out = program->out();
    client = std::make_unique<WindowClient>(out.substr(0, out.find('\n')));
    ASSERT_TRUE(client->connected()) << out;
  }
  /// Poses of ball, post, gate and floor in the next snapshot at `step`.
  void expect_poses(std::int64_t step) {
    std::vector<double> snapshot;
    do {
      snapshot = client->snapshot();
      ASSERT_GT(snapshot.size(), 11u);
    } while (snapshot[3] != static_cast<double>(step));
    const std::size_t poses = 13 + static_cast<std::size_t>(snapshot[10]);
    ASSERT_GE(snapshot.size(), poses + 4 * 7 + 1);
    const double t = static_cast<double>(step) * dt;
    const double r = std::sqrt(0.5);
    // Semi-implicit Euler is ahead of g t^2/2 by g t dt/2.
    const std::vector<std::vector<double>> expected{
        {0., 0., 20. - 0.5 * g * t * (t + dt), 1., 0., 0., 0.},
        {1., 2., 3., r, 0., 0., r},
        {-1., 0.5 * t, 1., std::cos(0.3 * t), 0., 0., std::sin(0.3 * t)},
        {0., 0., -0.5 * t, std::cos(0.2 * t), 0., 0., std::sin(0.2 * t)}};
    for (std::size_t frame = 0; frame < expected.size(); ++frame)
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(snapshot[poses + 7 * frame + i], expected[frame][i], 1e-11)
            << "frame " << frame << ", number " << i << ", step " << step;
  }

  Workplace place;
  std::unique_ptr<ChildProcess> program;
  std::unique_ptr<WindowClient> client;
};

TEST_F(MovingScene, IsLiveWhereItIs) {
  open({"view", "yard.hook", "--no-open", "--for", "100 s", "--out", "live", "--record", "w.**"});
  const std::string description = client->wait_for("\"tell\": \"description\"");
  std::size_t at = 0;
  for (const char* trail : {"\"w.ball.base\"", "\"w.post\"", "\"w.gate\"", "\"w.floor\""}) {
    const std::size_t found = description.find(std::string("\"trail\": ") + trail);
    ASSERT_NE(found, std::string::npos) << trail << " in " << description;
    EXPECT_GT(found, at) << trail;
    at = found;
  }
  EXPECT_NE(description.find("\"body\": 3"), std::string::npos) << "the ground's own axes";
  client->ask("pause");
  client->ask("reset");
  expect_poses(0);
  client->ask("step", "\"count\": 400");
  expect_poses(400);
  // There and back again.
  client->ask("seek", "\"time\": 0.15");
  expect_poses(150);
  client->ask("seek", "\"time\": 0.4");
  expect_poses(400);
  client->ask("quit");
  client.reset();
  EXPECT_EQ(program->wait(), 0);
}

TEST_F(MovingScene, AMovieHasItWhereItWas) {
  for (const char* rate : {"1000 Hz", "7 Hz"}) {
    place.file("filmed.hook", std::string(yard) + "Movie film { rate = " + rate + "; }\n");
    const auto run = place.hookpoint("run filmed.hook --out run");
    ASSERT_EQ(run.status, 0) << run.err;
    open({"replay", "run/film.h5", "--no-open"});
    for (const std::int64_t step : {500, 0, 1000, 333}) {
      client->ask("seek", "\"time\": " + std::to_string(static_cast<double>(step) * dt));
      expect_poses(step);
    }
  }
}

TEST_F(MovingScene, WatchedOrNotItLeavesTheSameBytes) {
  open({"view", "yard.hook", "--no-open", "--out", "watched", "--record", "w.**"});
  client->ask("speed", "\"factor\": 0");
  client->ask("run");
  EXPECT_NE(client->wait_for("come to its end"), "");
  client->ask("quit");
  client.reset();
  EXPECT_EQ(program->wait(), 0);
  const auto alone = place.hookpoint("run yard.hook --out alone --record 'w.**'");
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_FALSE(place.read("alone/trace.csv").empty());
  EXPECT_EQ(place.read("watched/trace.csv"), place.read("alone/trace.csv"));
}

}  // namespace
}  // namespace hookpoint
