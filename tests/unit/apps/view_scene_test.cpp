// What stands in the world, as a page is told it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/view/widgets/scene.h"
#include "contact/terrain/terrain.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "text/json.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using simulation::GroundTiles;
using view::Scene;

simulation::Experiment experiment_of(const std::string& text) {
  Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return std::move(loaded.experiment).value();
}

simulation::Experiment config(const std::string& name) {
  Loaded loaded = load_file(std::filesystem::path(testing::source_folder()) / "configs" / name);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return std::move(loaded.experiment).value();
}

TEST(ViewScene, HasTheBodiesOfFigure7) {
  const Scene scene = view::make_scene(config("paper/fig7_two_joint_arm.hook"));
  ASSERT_EQ(scene.bodies.size(), 3u);
  EXPECT_EQ(scene.bodies[1].trail, "SimpleWorld.simplebot.leg1.link1");
  EXPECT_EQ(scene.bodies[0].parent, -1);
  EXPECT_EQ(scene.bodies[1].parent, 0);
  EXPECT_EQ(scene.bodies[2].parent, 1);
  EXPECT_FALSE(scene.bodies[0].joint);
  EXPECT_EQ(scene.bodies[2].joint, simulation::JointKind::revolute);
  EXPECT_EQ(scene.bodies[2].mass.mass, 1.);
  EXPECT_EQ(std::get<simulation::Box>(scene.bodies[0].shapes.at(0).geometry).dimensions,
            (Vector3d{1., 1., 0.3}));
  EXPECT_FALSE(scene.terrain);
  EXPECT_EQ(scene.gravity, (Vector3d{0., 0., -9.81}));
}

// Six legs of three links on a base; the second robot's begin behind them.
TEST(ViewScene, CountsTheBodiesOfSeveralRobots) {
  const std::string arm =
      "{ Base.mobile { mass = 1; Shape.Sphere radius = 0.1; }"
      "  Chain a { Link l { mass = 1; Shape.Sphere radius = 0.1; } } "
      "  Chain b { Link l { mass = 1; Shape.Sphere radius = 0.1; } "
      "            Link m { mass = 1; Shape.Sphere radius = 0.1; } } }";
  const Scene scene =
      view::make_scene(experiment_of("World w { Robot one " + arm + " Robot two " + arm + " }"));
  std::vector<int> parents, robots;
  for (const view::SceneBody& body : scene.bodies) {
    parents.push_back(body.parent);
    robots.push_back(body.robot);
  }
  EXPECT_EQ(parents, (std::vector<int>{-1, 0, 0, 2, -1, 4, 4, 6}));
  EXPECT_EQ(robots, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
}

/// Every corner is on the ground, every tile's material is the ground's in its middle, and the
/// corners go about it counter-clockwise.
void expect_on_ground(const GroundTiles& tiles, const simulation::Experiment& experiment) {
  const contact::Terrain ground(*experiment.terrain);
  double highest = 0.;
  for (const Vector3d& vertex : tiles.vertices) {
    highest = std::max(highest, std::abs(vertex.z));
    // At the far edge of a grid the cell inside is asked.
    EXPECT_NEAR(ground.query(vertex).height, vertex.z, 1e-9) << vertex.x << ", " << vertex.y;
  }
  for (const GroundTiles::Tile& tile : tiles.tiles) {
    Vector3d middle;
    double area = 0.;
    for (int i = 0; i < tile.corner_count; ++i) {
      const Vector3d& a = tiles.vertices[static_cast<std::size_t>(tile.corners[i])];
      const Vector3d& b =
          tiles.vertices[static_cast<std::size_t>(tile.corners[(i + 1) % tile.corner_count])];
      middle += (1. / tile.corner_count) * a;
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    EXPECT_GT(area, 0.);
    if (tile.corner_count == 3) {
      EXPECT_EQ(ground.query(middle).material, tile.material);
    }
  }
}

struct Extent {
  double from_x = 1e9, to_x = -1e9, from_y = 1e9, to_y = -1e9;
};
Extent extent_of(const GroundTiles& tiles) {
  Extent extent;
  for (const Vector3d& vertex : tiles.vertices) {
    extent.from_x = std::min(extent.from_x, vertex.x);
    extent.to_x = std::max(extent.to_x, vertex.x);
    extent.from_y = std::min(extent.from_y, vertex.y);
    extent.to_y = std::max(extent.to_y, vertex.y);
  }
  return extent;
}

std::string block_at(const std::string& x) {
  return " Robot b { Base.mobile { mass = 1; Shape.Cube dimensions = 0.1,0.1,0.1; location = " + x +
         ",0,3; } } }";
}
const std::string block = block_at("2"), block_in_the_middle = block_at("0");

TEST(ViewScene, ShowsAPlaneWithoutAnEndAroundTheRobots) {
  const auto experiment = experiment_of(
      "World w { Terrain.Slope ground { angle = 0.3; azimuth = 0.7; spacing = 0.5; }" + block);
  const GroundTiles tiles = *view::make_scene(experiment).terrain;
  expect_on_ground(tiles, experiment);
  const Extent extent = extent_of(tiles);
  EXPECT_EQ(extent.from_x, -3.);
  EXPECT_EQ(extent.to_x, 7.);
  EXPECT_EQ(extent.from_y, -5.);
  EXPECT_EQ(extent.to_y, 5.);
  EXPECT_EQ(tiles.tiles.size(), 400u);
  EXPECT_EQ(tiles.tiles[0].corner_count, 4);
}

// 1.25 m of half a metre are three tiles, the last one cut.
TEST(ViewScene, EndsWhereAPlaneEnds) {
  const auto experiment = experiment_of(
      "World w { Terrain.Flat ground { height = 0.25; size = 1.25,1; spacing = 0.5; }" +
      block_in_the_middle);
  const GroundTiles tiles = *view::make_scene(experiment).terrain;
  expect_on_ground(tiles, experiment);
  EXPECT_EQ(tiles.vertices.size(), 12u);
  EXPECT_EQ(tiles.tiles.size(), 6u);
  EXPECT_EQ(extent_of(tiles).to_x, 0.625);
}

TEST(ViewScene, PaintsPatches) {
  const auto experiment = experiment_of(
      "World w { Material mud { } Material ice { } Terrain.Flat ground { material = mud; size = "
      "4,4; Patch { from = 0.1,0.1; to = 2,2; material = ice; } }" +
      block_in_the_middle);
  const Scene scene = view::make_scene(experiment);
  expect_on_ground(*scene.terrain, experiment);
  EXPECT_EQ(scene.materials, (std::vector<std::string>{"mud", "ice"}));
  // The patch holds the centroids of both halves of 2 x 2 cells of 1 m.
  EXPECT_EQ(std::ranges::count(scene.terrain->tiles, 1, &GroundTiles::Tile::material), 4);
}

TEST(ViewScene, ShowsGrids) {
  for (const char* name : {"scenes/walking_rough.hook", "scenes/tile_edges.hook"}) {
    const auto experiment = config(name);
    const GroundTiles tiles = simulation::visible_ground(experiment);
    expect_on_ground(tiles, experiment);
    EXPECT_GT(tiles.tiles.size(), 1u);
  }
}

TEST(ViewScene, DrawsNoMoreThanIsAskedFor) {
  const auto fine = experiment_of("World w { Terrain.Flat ground spacing = 0.01;" + block);
  const GroundTiles squares = simulation::visible_ground(fine, 100);
  EXPECT_LE(squares.tiles.size(), 150u);
  EXPECT_LE(extent_of(squares).from_x, -3.);
  auto grid = fine;
  simulation::GridSpec heights{300, 200, std::vector<double>(60000, 0.), -1., -1.};
  for (std::size_t i = 0; i < heights.heights.size(); ++i)
    heights.heights[i] = std::sin(0.37 * static_cast<double>(i));
  grid.terrain->surface = heights;
  grid.terrain->spacing = 0.1;
  const GroundTiles part = simulation::visible_ground(grid, 100);
  EXPECT_EQ(part.tiles.size(), 200u);
  expect_on_ground(part, grid);
  // Ten cells, the robot at x = 2 m in the middle one.
  EXPECT_NEAR(extent_of(part).from_x, 1.5, 0.11);
  EXPECT_NEAR(extent_of(part).to_x, 2.5, 0.11);
}

// 1 m to the first riser, two steps, 2 m beyond: treads and risers are one tile each, in the colour of
// what they are made of.
TEST(ViewScene, StairsHaveTreadsAndUprightRisers) {
  const auto stairs = [](const std::string& fields, const std::string& patch = "") {
    return experiment_of(
        "World w { Material mud { } Material ice { } " + fields +
        " Terrain.Steps ground { height = 0.2; run = 0.5; from = 0; count = 2; size = 2, "
        "1; material = mud; spacing = 0.1; " +
        patch + " }" + block_in_the_middle);
  };
  const GroundTiles shown = simulation::visible_ground(stairs(""));
  ASSERT_EQ(shown.tiles.size(), 5u);
  std::vector<double> levels, risers;
  for (const GroundTiles::Tile& tile : shown.tiles) {
    ASSERT_EQ(tile.corner_count, 4);
    const auto at = [&](int corner) {
      return shown
          .vertices[static_cast<std::size_t>(tile.corners[static_cast<std::size_t>(corner)])];
    };
    const Vector3d normal = cross(at(1) - at(0), at(2) - at(0));
    if (normal.z > 0.) {
      levels.push_back(at(0).z);
      EXPECT_EQ(at(0).z, at(2).z);
    } else {
      risers.push_back(at(0).x);
      EXPECT_LT(normal.x, 0.) << "seen from below the stairs";
      EXPECT_NEAR(norm(normal), 0.2 * 1., 1e-12);
      EXPECT_EQ(at(0).x, at(2).x);
    }
  }
  EXPECT_EQ(levels, (std::vector<double>{0., 0.2, 0.4}));
  EXPECT_EQ(risers, (std::vector<double>{0., 0.5}));
  // A patch that is the second half of the first tread: that tread is two tiles, and riser 1 is of ice.
  const auto patched = stairs("", "Patch { from = 0.25, -1; to = 0.5, 1; material = ice; }");
  const GroundTiles painted = simulation::visible_ground(patched);
  double ice = 0.;
  for (const GroundTiles::Tile& tile : painted.tiles) {
    for (int i = 2; tile.material == 1 && i < tile.corner_count; ++i) {
      const auto at = [&](int corner) {
        return painted
            .vertices[static_cast<std::size_t>(tile.corners[static_cast<std::size_t>(corner)])];
      };
      ice += 0.5 * cross(at(i - 1) - at(0), at(i) - at(0)).z;
    }
  }
  // From the centroids between 0.25 and 0.5 on: those of lower tiles at x = 0.2667 to 0.4667, of
  // upper ones at 0.3333 and 0.4333, ten rows of halves of 0.01 m^2.
  EXPECT_NEAR(ice, 10. * 0.005 * (3. + 2.), 1e-12);
  // Points meet ramps, one cell wide.
  const GroundTiles ramps = simulation::visible_ground(stairs("touch = points;"));
  EXPECT_EQ(ramps.tiles.size(), 2u * 20u * 10u);
}

// Stairs at 45 degrees whose riser cuts a corner off a square, sqrt 2 from its middle to the corner.
TEST(ViewScene, StairsAreCutWhereTheirGroundEnds) {
  const auto experiment = experiment_of(
      "World w { Terrain.Steps ground { height = -0.2; run = 5; from = 0.5; azimuth = 45 deg; size = 2, 2; "
      "spacing = 0.1; }" +
      block_in_the_middle);
  const GroundTiles shown = simulation::visible_ground(experiment);
  ASSERT_EQ(shown.tiles.size(), 3u);
  std::vector<int> corners;
  for (const GroundTiles::Tile& tile : shown.tiles) corners.push_back(tile.corner_count);
  EXPECT_EQ(corners, (std::vector<int>{5, 4, 3}));
  const auto& riser = shown.tiles[1].corners;
  const auto at = [&](std::size_t corner) {
    return shown.vertices[static_cast<std::size_t>(riser[corner])];
  };
  EXPECT_NEAR(norm(at(1) - at(0)), 2. * (std::sqrt(2.) - 0.5), 1e-9);
  EXPECT_GT(cross(at(1) - at(0), at(2) - at(0)).x, 0.) << "stairs that go down face downhill";
}

TEST(ViewScene, HasObstaclesBehindTheRobotsAndTheGroundThatMoves) {
  const std::string scene =
      "World w { Material mud { } Material ice { } Terrain.Flat ground { material = mud; %s } "
      "Obstacle.Box wall { dimensions = 0.1, 1, 0.5; location = 1, 2, 3; material = ice; } "
      "Obstacle.Capsule gate { radius = 0.1; length = 0.4; location = 0, 0, 2; velocity = 0.5, 0, 0; } "
      "Obstacle.Sphere ball { radius = 0.1; mass = 5; free = true; location = 0, 0, 9; } ";
  const auto with = [&](const std::string& motion) {
    std::string text = scene;
    return experiment_of(text.replace(text.find("%s"), 2, motion) + block);
  };
  const Scene shown = view::make_scene(with("frame_velocity = 0, 0, 1;"));
  std::vector<std::string> trails;
  std::vector<int> robots;
  for (const view::SceneBody& body : shown.bodies) {
    trails.push_back(body.trail);
    robots.push_back(body.robot);
  }
  EXPECT_EQ(trails,
            (std::vector<std::string>{"w.b.base", "w.ball.base", "w.wall", "w.gate", "w.ground"}));
  EXPECT_EQ(robots, (std::vector<int>{0, 1, -1, -1, -1}));
  EXPECT_EQ(shown.materials[static_cast<std::size_t>(shown.bodies[2].material.value())], "ice");
  EXPECT_EQ(shown.bodies[2].start.position, (Vector3d{1., 2., 3.}));
  EXPECT_EQ(std::get<simulation::Capsule>(shown.bodies[3].shapes.at(0).geometry).length, 0.4);
  EXPECT_EQ(std::get<simulation::Sphere>(shown.bodies[1].shapes.at(0).geometry).radius, 0.1);
  EXPECT_FALSE(shown.bodies[1].material) << "a free obstacle is a robot";
  EXPECT_TRUE(shown.bodies[4].shapes.empty());
  EXPECT_EQ(shown.terrain_body, 4);
  const Scene still = view::make_scene(with("velocity = 1, 0, 0;"));
  EXPECT_EQ(still.bodies.size(), 5u) << "a belt may move as a whole, by a wire";
  const Scene fixed = view::make_scene(with(""));
  EXPECT_EQ(fixed.bodies.size(), 4u);
  EXPECT_EQ(fixed.terrain_body, -1);
}

TEST(ViewScene, KnowsWhereSensorsAre) {
  const Scene scene = view::make_scene(
      experiment_of("World w { Robot b { Base.mobile { mass = 1; Shape.Sphere radius = 0.1; }"
                    " Chain c { Link l { mass = 1; Shape.Sphere radius = 0.1; } } } }"
                    "Sensor.IMU imu body = w.b.base; Sensor.Position place body = w.b.c.l;"
                    "Sensor.Position wired { Wire FROM w.b.c.l.location TO location; }"));
  ASSERT_EQ(scene.sensors.size(), 3u);
  EXPECT_EQ(scene.sensors[0].type, "Sensor.IMU");
  EXPECT_EQ(scene.sensors[0].body, 0);
  EXPECT_EQ(scene.sensors[1].body, 1);
  EXPECT_EQ(scene.sensors[2].trail, "wired");
  EXPECT_EQ(scene.sensors[2].body, 1);
}

TEST(ViewScene, IsTheSceneOfTheProtocol) {
  const auto experiment =
      experiment_of("World w { Terrain.Flat ground { size = 1,1; }" + block_in_the_middle);
  text::JsonWriter json;
  view::write_scene(view::make_scene(experiment), json);
  const auto leaves = text::json_leaves(json.text());
  ASSERT_TRUE(leaves);
  const auto value = [&](const std::string& path) {
    const auto found =
        std::ranges::find(*leaves, path, &std::pair<std::string, std::string>::first);
    return found == leaves->end() ? "none at " + path : found->second;
  };
  EXPECT_EQ(value("bodies[0].trail"), "w.b.base");
  EXPECT_EQ(value("bodies[0].joint"), "null");
  EXPECT_EQ(value("bodies[0].shapes[0].kind"), "box");
  EXPECT_EQ(value("bodies[0].points[7][2]"), "0.050000000000000003");
  EXPECT_EQ(value("terrain.tiles[0][4]"), "2");
  EXPECT_EQ(value("terrain.vertices[0]"), "-0.5");
  EXPECT_EQ(value("gravity[2]"), "-9.8100000000000005");
}

}  // namespace
}  // namespace hookpoint
