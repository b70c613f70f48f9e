// One tilted plane, many tilings: a block that slides over hundreds of edges, vertices and
// diagonals goes where it goes on the plane itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

constexpr double degree = std::numbers::pi / 180.;
constexpr double seconds = 0.6;

simulation::Experiment sliding_block(const std::string& law, double azimuth) {
  return testing::load_scene("scenes/sliding_block.hook",
                             {{"azimuth", std::to_string(azimuth) + " deg"}, {"dt", "1 ms"}},
                             {{"world.contact", law}});
}

/// Where the block is, every step.
std::vector<Vector3d> trajectory(const simulation::Experiment& experiment) {
  const auto engine = simulation::make_dts(experiment);
  std::vector<Vector3d> places;
  for (int step = 0; step < seconds / experiment.deltat; ++step) {
    EXPECT_TRUE(engine->step().ok());
    places.push_back(engine->state().bodies[0].position);
  }
  return places;
}

struct Tiling {
  double spacing, offset_x, offset_y;
};
constexpr Tiling tilings[] = {{0.31, 0., 0.}, {0.05, 0.0123, -0.0321}, {0.013, 0.001, 0.0057}};

/// Puts the slope's own heights at the vertices of a grid.
void tile(const Tiling& tiling, simulation::Experiment& experiment) {
  const auto slope = std::get<simulation::SlopeSpec>(experiment.terrain->surface);
  const int side = 2 * static_cast<int>(2. / tiling.spacing) + 1;
  simulation::GridSpec grid{side, side, {}, tiling.offset_x - 2., tiling.offset_y - 2.};
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = grid.origin_x + column * tiling.spacing;
      const double y = grid.origin_y + row * tiling.spacing;
      grid.heights.push_back(-std::tan(slope.angle) *
                             (x * std::cos(slope.azimuth) + y * std::sin(slope.azimuth)));
    }
  }
  experiment.terrain->surface = std::move(grid);
  experiment.terrain->spacing = tiling.spacing;
}

double largest_distance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double largest = 0.;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, norm(a[k] - b[k]));
  return largest;
}

/// What rounding may do. e = 1.1e-16 is the rounding of a number below 1. Six operations give a
/// height: the block is off by as much, and its friction by mu k of it, now one way, now the other.
/// A gradient is off by 2 e/spacing, and gravity along the tiles with it, always the same way on a
/// tile.
double rounding_drift(const simulation::Experiment& experiment, double spacing) {
  constexpr double e = 1.1e-16;
  const auto& ground = experiment.materials[experiment.terrain->material].constants;
  const double mass = experiment.robots[0].base.mass.mass;
  const double friction =
      ground.kinetic_friction * 4. * ground.normal_stiffness * 6. * e / mass;  // [m/s^2]
  const double steps = seconds / experiment.deltat;
  return 6. * e + friction * experiment.deltat * seconds * std::sqrt(steps) +
         0.5 * 9.81 * 2. * e / spacing * seconds * seconds;
}

class TileEdges : public ::testing::TestWithParam<std::string> {};

TEST_P(TileEdges, OnePlaneIsOneTrajectoryHoweverItIsTiled) {
  double largest = 0.;
  for (const double azimuth : {0., 33., 135.}) {
    const simulation::Experiment experiment = sliding_block(GetParam(), azimuth);
    const std::vector<Vector3d> expected = trajectory(experiment);
    EXPECT_GT(norm(expected.back() - expected.front()), 0.2);
    for (const Tiling& tiling : tilings) {
      simulation::Experiment tiled = experiment;
      tile(tiling, tiled);
      const double distance = largest_distance(trajectory(tiled), expected);
      largest = std::max(largest, distance);
      EXPECT_LE(distance, rounding_drift(experiment, tiling.spacing))
          << "azimuth " << azimuth << ", spacing " << tiling.spacing;
    }
  }
  std::ostringstream text;
  text << largest;
  RecordProperty("largest_distance_m", text.str());
}

// All diagonals run one way; in the mirror they run the other. The mirrored slope's trajectory is
// the mirror image.
TEST_P(TileEdges, NorDoesTheDiagonalsDirectionMatter) {
  simulation::Experiment experiment = sliding_block(GetParam(), 33.);
  simulation::Experiment mirrored = sliding_block(GetParam(), -33.);
  const double tolerance = rounding_drift(experiment, tilings[1].spacing);
  tile(tilings[1], experiment);
  tile(tilings[1], mirrored);
  const std::vector<Vector3d> expected = trajectory(experiment);
  std::vector<Vector3d> image = trajectory(mirrored);
  for (Vector3d& place : image) place.y = -place.y;
  EXPECT_LE(largest_distance(image, expected), tolerance);
}

std::vector<std::string> force_laws() {
  std::vector<std::string> names;
  for (const contact::LawDescription& law : contact::law_table()) {
    if (!law.is_impulse_law) names.emplace_back(law.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Laws, TileEdges, ::testing::ValuesIn(force_laws()),
                         [](const auto& tested) { return tested.param; });

/// A hexapod that falls on its side, rolls over and comes to rest: bodies come to the ground and
/// leave it. All that is published of its bodies, every step.
std::vector<double> tumbling_hexapod(
    const std::string& law, const std::string& integrator,
    const std::function<void(contact::TerrainDescription&)>& change) {
  simulation::Experiment experiment =
      testing::load_scene("scenes/walking_hexapod.hook", {{"dt", "0.25 ms"}},
                          {{"world.contact", law}, {"world.integrator", integrator}});
  change(*experiment.terrain);
  experiment.robots[0].location.z = 0.3;
  experiment.robots[0].angular_velocity = {12., 3., 0.};
  const auto engine = simulation::make_dts(experiment);
  std::vector<double> published;
  for (int step = 0; step < 4000; ++step) {
    EXPECT_TRUE(engine->step().ok());
    for (const simulation::BodyState& body : engine->state().bodies) {
      for (const Vector3d& v :
           {body.position, body.velocity, body.angular_velocity, body.contact_force})
        published.insert(published.end(), {v.x, v.y, v.z});
      published.push_back(body.contacts);
    }
  }
  return published;
}

// Bodies far above a plane without edges are passed over; one that ends 1 km away is asked about
// every point. Nothing may differ.
TEST(EndlessPlane, BodiesPassedOverChangeNoBit) {
  for (const char* integrator : {"semi_implicit_euler", "rk4"}) {
    for (const char* law : {"hookpoint", "exponential"}) {
      const auto with_extent = [](double extent) {
        return
            [extent](contact::TerrainDescription& plane) { plane.size_x = plane.size_y = extent; };
      };
      const auto passed_over = tumbling_hexapod(law, integrator, with_extent(0.));
      EXPECT_EQ(passed_over, tumbling_hexapod(law, integrator, with_extent(2000.)))
          << integrator << law;
    }
  }
}

// As are those that hang over all of a grid; over one with a tower in a far corner none does.
TEST(Grid, BodiesPassedOverChangeNoBit) {
  const auto with_tower = [](double tower) {
    return [tower](contact::TerrainDescription& ground) {
      contact::GridSurface grid{161, 161, {}, -20., -20.};
      for (int i = 0; i < grid.columns * grid.rows; ++i)
        grid.heights.push_back(2e-3 * std::sin(0.7 * i));
      grid.heights.front() = tower;
      ground.surface = std::move(grid);
      ground.spacing = 0.25;
    };
  };
  for (const char* law : {"hookpoint", "exponential"})
    EXPECT_EQ(tumbling_hexapod(law, "semi_implicit_euler", with_tower(0.)),
              tumbling_hexapod(law, "semi_implicit_euler", with_tower(100.)))
        << law;
}

}  // namespace
}  // namespace hookpoint
