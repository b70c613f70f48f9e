// What metrics see of a ball foot on stairs and on a slab, by hand: no engine runs here.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "studies/measure/metric.h"
#include "tests/support/load_text.h"

namespace hookpoint::studies {
namespace {

using simulation::WorldState;

constexpr double dt = 0.01, radius = 0.02;

/// Risers at x = 0.5 and 0.8 m; a slab about y = 0.5 m whose top is 50 mm over the floor and that goes
/// along x at 0.1 m/s; a robot of one leg whose foot is its link's origin.
class Stair : public ::testing::Test {
 protected:
  Stair()
      : loaded(load_text(R"(
World world {
  deltat = 10 ms;
  duration = 1 s;
  touch = shapes;
  Terrain.Steps stairs { height = 100 mm; run = 0.3 m; from = 0.5 m; count = 2; spacing = 50 mm; size = 4; }
  Obstacle.Box slab { dimensions = 0.3, 0.3, 0.1; location = 0, 0.5, 0; velocity = 0.1, 0, 0; }
  Robot walker {
    Base.mobile { location = 0, 0, 0.3; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; }
    Chain leg { Link shank { mass = 1 kg; Shape.Sphere { radius = 20 mm; } } }
  }
})")),
        context(make_context(*loaded.experiment, 0., 1.)),
        inputs(simulation::initial_inputs(*loaded.experiment)),
        observer(context, true, true) {
    state.bodies.resize(2);
    state.joints.resize(1);
    state.bodies[0].position = context.start;
  }
  const FootObservation& look(const Vector3d& foot, const Vector3d& base = {0., 0., 0.3}) {
    state.bodies[0].position = base;
    state.bodies[1].position = foot;
    state.time = dt * static_cast<double>(state.step++);
    seen.emplace(observer.observe(state, &inputs));
    return seen->feet[0];
  }

  Loaded loaded;
  RunContext context;
  simulation::WorldInputs inputs;
  Observer observer;
  WorldState state;
  std::optional<Observation> seen;
};

TEST_F(Stair, ABallBeforeARiserTouchesTheRiser) {
  const FootObservation& foot = look({0.485, 0., 0.05});
  EXPECT_NEAR(foot.depth, radius - 0.015, 1e-12);
  EXPECT_NEAR(norm(foot.normal - Vector3d{-1., 0., 0.}), 0., 1e-12);
  // Past the riser the tile below is 100 mm up; the ball is 1 mm behind the riser's face.
  EXPECT_NEAR(look({0.501, 0., 0.05}).depth, radius + 0.001, 1e-12);
  double deepest = 0.;
  for (const PointObservation& point : seen->points) deepest = std::max(deepest, point.depth);
  EXPECT_NEAR(deepest, radius + 0.001, 1e-12);
}

TEST_F(Stair, ABallOverANosingIsAsFarAsItsEdge) {
  const double away = radius - 0.002;
  const FootObservation& foot = look({0.5 - 0.6 * away, 0., 0.1 + 0.8 * away});
  EXPECT_NEAR(foot.depth, 0.002, 1e-12);
  EXPECT_NEAR(norm(foot.normal - Vector3d{-0.6, 0., 0.8}), 0., 1e-12);
}

TEST_F(Stair, ABallOnASlabTouchesTheSlab) {
  EXPECT_NEAR(look({0., 0.5, 0.05 + 0.018}).depth, 0.002, 1e-12);
  EXPECT_LT(look({0., 0.5, 0.05 + 0.021}).depth, 0.);
}

TEST_F(Stair, SlipIsAgainstWhatIsTouched) {
  look({0., 0.5, 0.068});
  EXPECT_NEAR(look({0., 0.5, 0.068}).slip.x, -0.1 * dt, 1e-12);
  EXPECT_NEAR(look({0.1 * dt, 0.5, 0.068}).slip.x, 0., 1e-12);
  // Of a ball that rolls the lowest place stays.
  state.bodies[1].orientation = exponential(Vector3d{0., 0.01, 0.});
  EXPECT_NEAR(look({0.2 * dt + radius * std::sin(0.01), 0.5, 0.068}).slip.x, 0., 1e-12);
}

TEST_F(Stair, ARobotBeforeAStepHasNotFallen) {
  const auto fell = [&](const Vector3d& base, const Vector3d& foot) {
    const auto metric = find_metric("fell")->make(context);
    look(foot, base);
    metric->observe(*seen);
    return *metric->value();
  };
  // Its base started at 0.3 m; over the tread it is 0.12 m, over the floor that its foot is on 0.22 m.
  EXPECT_EQ(fell({0.6, 0., 0.22}, {0.4, 0., 0.02}), 0.);
  EXPECT_EQ(fell({0.6, 0., 0.22}, {0.7, 0., 0.12}), 1.);
  EXPECT_EQ(fell({0.4, 0., 0.12}, {0.3, 0., 0.02}), 1.);
}

}  // namespace
}  // namespace hookpoint::studies
