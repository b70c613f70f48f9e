// What players of records are given to draw: shapes where the language puts them, and the ground's
// tiles by material, worked out by hand.
#include "simulation/run/shown_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "simulation/experiment/ground.h"

namespace hookpoint::simulation {
namespace {

Experiment on(contact::TerrainDescription terrain) {
  Experiment experiment;
  experiment.world = "w";
  experiment.materials = {{"clay", {}}, {"ice", {}}};
  experiment.terrain = TerrainSpec{std::move(terrain), "ground", {}, {}, {}};
  return experiment;
}

/// Seen from above, > 0 where it is counter-clockwise.
double area(const output::SceneSurface& surface, const std::array<std::uint32_t, 3>& triangle) {
  const Vector3d &a = surface.vertices[triangle[0]], &b = surface.vertices[triangle[1]],
                 &c = surface.vertices[triangle[2]];
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/// Of each material; every triangle is counter-clockwise.
std::map<std::string, double> areas(const std::vector<output::SceneSurface>& surfaces) {
  std::map<std::string, double> sums;
  for (const output::SceneSurface& surface : surfaces) {
    for (const auto& triangle : surface.triangles) {
      EXPECT_GT(area(surface, triangle), 0.);
      sums[surface.material] += area(surface, triangle);
    }
  }
  return sums;
}

/// Every triangle lies within tiles of its material, whom the ground itself is asked.
void expect_painted(const Experiment& experiment, const std::vector<output::SceneSurface>& shown) {
  const contact::Terrain ground = *make_ground(experiment);
  for (const output::SceneSurface& surface : shown) {
    EXPECT_EQ(surface.name, "w.ground");
    for (const auto& triangle : surface.triangles) {
      const Vector3d &a = surface.vertices[triangle[0]], &b = surface.vertices[triangle[1]],
                     &c = surface.vertices[triangle[2]];
      const Vector3d center{(a.x + b.x + c.x) / 3., (a.y + b.y + c.y) / 3., 0.};
      const auto material = static_cast<std::size_t>(ground.query(center).material);
      EXPECT_EQ(experiment.materials[material].name, surface.material);
      for (const Vector3d& vertex : {a, b, c})
        EXPECT_NEAR(vertex.z, ground.query(vertex).height, 1e-12);
    }
  }
}

TEST(ShownGround, PlaneWithAnEdgeIsTwoTriangles) {
  const auto shown = shown_ground(on({.surface = contact::SlopeSurface{.angle = std::atan(0.5)},
                                      .size_x = 4.,
                                      .size_y = 3.,
                                      .patches = {}}));
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].material, "clay");
  ASSERT_EQ(shown[0].triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(areas(shown)["clay"], 12.);
  for (const Vector3d& vertex : shown[0].vertices) {
    EXPECT_EQ(std::abs(vertex.x), 2.);
    EXPECT_EQ(std::abs(vertex.y), 1.5);
    EXPECT_NEAR(vertex.z, -0.5 * vertex.x, 1e-15);
  }
}

TEST(ShownGround, PlaneWithoutAnEdgeReachesTwentyMetresBeyondTheRobots) {
  Experiment experiment =
      on({.surface = contact::FlatSurface{.height = 0.25}, .spacing = 0.5, .patches = {}});
  experiment.robots.resize(2);
  experiment.robots[0].location = {-3., 0., 1.};
  experiment.robots[1].location = {5., 1., 1.};
  const auto shown = shown_ground(experiment);
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_DOUBLE_EQ(areas(shown)["clay"], 48. * 41.);
  for (const Vector3d& vertex : shown[0].vertices) EXPECT_EQ(vertex.z, 0.25);
}

// The tiles' centroids are at thirds of a cell: this patch holds that of one lower tile, at
// (2/3, 1/3), and of nothing else.
TEST(ShownGround, PatchOnOneTilePaintsOneTriangle) {
  const Experiment experiment = on({.surface = contact::FlatSurface{},
                                    .size_x = 4.,
                                    .size_y = 4.,
                                    .patches = {{0.6, 0.3, 0.7, 0.4, 1}}});
  const auto shown = shown_ground(experiment);
  ASSERT_EQ(shown.size(), 2u);
  ASSERT_EQ(shown[1].material, "ice");
  ASSERT_EQ(shown[1].triangles.size(), 1u);
  const auto& [a, b, c] = shown[1].triangles[0];
  EXPECT_EQ(shown[1].vertices[a], (Vector3d{0., 0., 0.}));
  EXPECT_EQ(shown[1].vertices[b], (Vector3d{1., 0., 0.}));
  EXPECT_EQ(shown[1].vertices[c], (Vector3d{1., 1., 0.}));
  EXPECT_DOUBLE_EQ(areas(shown)["clay"], 15.5);
  expect_painted(experiment, shown);
}

// From x = -1 to 1.5 and y = -1 to 0.5 there are the centroids of cells whole up to x = 1 and
// y = 0, of the upper tiles in the column from x = 1 (at 4/3), of the lower ones in the row from
// y = 0 (at 1/3): 2 + 1/2 + 2/2, and none in the corner cell, whose upper centroid is at y = 2/3
// and whose lower one at x = 5/3.
TEST(ShownGround, EdgesOfPatchesRunAlongTiles) {
  const Experiment experiment = on({.surface = contact::SlopeSurface{.angle = 0.3, .azimuth = 0.7},
                                    .patches = {{-1., -1., 1.5, 0.5, 1}}});
  const auto shown = shown_ground(experiment);
  std::map<std::string, double> sums = areas(shown);
  EXPECT_DOUBLE_EQ(sums["ice"], 3.5);
  // 20 m beyond the patch, in whole cells.
  EXPECT_DOUBLE_EQ(sums["clay"] + sums["ice"], (22. + 21.) * (21. + 21.));
  expect_painted(experiment, shown);
}

TEST(ShownGround, LastCellsAreCutWhereThePlaneEnds) {
  const Experiment experiment = on({.surface = contact::FlatSurface{},
                                    .size_x = 2.5,
                                    .size_y = 1.25,
                                    .patches = {{-5., -5., 5., 5., 1}, {1., -5., 1.1, 5., 0}}});
  const auto shown = shown_ground(experiment);
  std::map<std::string, double> sums = areas(shown);
  EXPECT_DOUBLE_EQ(sums["clay"] + sums["ice"], 2.5 * 1.25);
  EXPECT_GT(sums["clay"], 0.);
  expect_painted(experiment, shown);
}

TEST(ShownGround, PatchesThatChangeNothingCutNothing) {
  const auto shown =
      shown_ground(on({.surface = contact::FlatSurface{},
                       .size_x = 4.,
                       .size_y = 4.,
                       .patches = {{-5., -5., 5., 5., 1}, {0.2, -1.3, 0.3, 0.7, 1}}}));
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].material, "ice");
  EXPECT_EQ(shown[0].triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(areas(shown)["ice"], 16.);
}

TEST(ShownGround, GridIsItsTilesByMaterial) {
  contact::GridSurface grid{.columns = 3, .rows = 2, .heights = {0., 1., 2., 10., 11., 12.}};
  grid.origin_x = 5.;
  grid.origin_y = -1.;
  const Experiment experiment =
      on({.surface = grid, .spacing = 0.5, .patches = {{5., -1., 5.5, -0.5, 1}}});
  const auto shown = shown_ground(experiment);
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].triangles.size(), 2u);
  EXPECT_EQ(shown[1].triangles.size(), 2u);
  EXPECT_EQ(shown[1].vertices[0], (Vector3d{5., -1., 0.}));
  EXPECT_EQ(shown[1].vertices[2], (Vector3d{5.5, -0.5, 11.}));
  expect_painted(experiment, shown);
}

TEST(ShownGround, LargeGridKeepsEveryFewVerticesAndItsEdges) {
  contact::GridSurface grid{.columns = 1000, .rows = 3, .heights = {}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 1000; ++column) grid.heights.push_back(column);
  const auto shown = shown_ground(on({.surface = grid, .spacing = 0.1, .patches = {}}));
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].vertices.size(), 3u * 251u) << "0, 4, ... 996, 999";
  EXPECT_NEAR(areas(shown)["clay"], 99.9 * 0.2, 1e-9);
}

TEST(ShownGround, NoTerrainNoSurface) { EXPECT_TRUE(shown_ground(Experiment{}).empty()); }

TEST(ShownScene, CapsuleIsACylinderAndTwoBallsAHullItsTriangles) {
  Experiment experiment;
  RobotSpec robot;
  const Hull corner{{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  robot.base.shapes = {{Capsule{0.1, 0.4}, {1., 2., 3.}, {}}, {corner, {}, {}}};
  experiment.robots = {robot};
  const output::Scene scene = shown_scene(experiment);
  ASSERT_EQ(scene.bodies[0].shapes.size(), 4u);
  EXPECT_EQ(std::get<output::SceneCone>(scene.bodies[0].shapes[0].geometry).length, 0.4);
  EXPECT_EQ(scene.bodies[0].shapes[1].location, (Vector3d{1., 2., 2.8}));
  EXPECT_EQ(scene.bodies[0].shapes[2].location, (Vector3d{1., 2., 3.2}));
  EXPECT_EQ(std::get<output::SceneSphere>(scene.bodies[0].shapes[2].geometry).radius, 0.1);
  const auto& mesh = std::get<output::SceneMesh>(scene.bodies[0].shapes[3].geometry);
  EXPECT_EQ(mesh.vertices, corner.vertices);
  EXPECT_EQ(mesh.triangles.size(), 4u);
}

// What records have poses of: robots' bodies, obstacles, the ground. A capsule that is an obstacle is
// drawn as one that a robot carries.
TEST(ShownScene, ObstaclesAndGroundThatMovesHaveFrames) {
  Experiment experiment =
      on({.surface = contact::FlatSurface{}, .size_x = 2., .size_y = 2., .patches = {}});
  RobotSpec robot;
  robot.name = "bot";
  robot.base.name = "base";
  experiment.robots = {robot};
  ObstacleSpec post;
  post.name = "post";
  post.geometry = Capsule{0.1, 0.4};
  experiment.obstacles = {post};
  const output::Scene still = shown_scene(experiment);
  ASSERT_EQ(still.bodies.size(), 2u);
  EXPECT_EQ(still.bodies[1].name, "w.post");
  EXPECT_EQ(still.bodies[1].shapes.size(), 3u);
  EXPECT_EQ(still.ground.at(0).frame, "");
  experiment.terrain->frame_angular_velocity = {0., 0.1, 0.};
  const output::Scene tilting = shown_scene(experiment);
  ASSERT_EQ(tilting.bodies.size(), 3u);
  EXPECT_EQ(tilting.bodies[2].name, "w.ground");
  EXPECT_EQ(tilting.ground.at(0).frame, "w.ground");
}

// A legcone runs along +x from its origin; a cone of a scene along z about its own.
TEST(ShownScene, LegconeIsACentredConeTurnedToX) {
  Experiment experiment;
  experiment.world = "w";
  RobotSpec robot;
  robot.name = "bot";
  robot.base.name = "base";
  // Turned by 90 degrees about z: its x is the body's y.
  const double half = 0.5 * std::numbers::sqrt2;
  robot.base.shapes = {{Legcone{0.4, 0.03, 0.01}, {1., 2., 3.}, {half, 0., 0., half}}};
  experiment.robots = {robot};
  const output::Scene scene = shown_scene(experiment);
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "w.bot.base");
  ASSERT_EQ(scene.bodies[0].shapes.size(), 1u);
  const output::SceneShape& shape = scene.bodies[0].shapes[0];
  const auto& cone = std::get<output::SceneCone>(shape.geometry);
  EXPECT_EQ(cone.length, 0.4);
  EXPECT_EQ(cone.bottom_radius, 0.03);
  EXPECT_EQ(cone.top_radius, 0.01);
  EXPECT_NEAR(shape.location.x, 1., 1e-15);
  EXPECT_NEAR(shape.location.y, 2.2, 1e-15);
  EXPECT_NEAR(shape.location.z, 3., 1e-15);
  const Vector3d axis = rotate(shape.orientation, Vector3d{0., 0., 1.});
  EXPECT_NEAR(axis.x, 0., 1e-15);
  EXPECT_NEAR(axis.y, 1., 1e-15);
  EXPECT_NEAR(axis.z, 0., 1e-15);
}

}  // namespace
}  // namespace hookpoint::simulation
