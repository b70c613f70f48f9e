// The tiling against analytic planes and a search over all triangles; materials, edges, poses,
// files, boundary points.
#include "contact/terrain/terrain.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "contact/terrain/boundary_points.h"

namespace hookpoint::contact {
namespace {

constexpr double degree = std::numbers::pi / 180.;

TerrainDescription slope(double angle, double azimuth) {
  TerrainDescription description;
  description.surface = SlopeSurface{angle, azimuth};
  return description;
}

GridSurface random_grid(int columns, int rows) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> height(-0.3, 0.3);
  GridSurface grid{columns, rows, {}, -1.3, 0.4};
  for (int i = 0; i < columns * rows; ++i) grid.heights.push_back(height(generator));
  return grid;
}

/// A box that `deepest` bounds has no point deeper than it says, by a search over its corners and
/// faces; and a box over all of the grid is bounded.
TEST(Terrain, NoPointOfABoxOverAGridIsDeeperThanSaid) {
  TerrainDescription description;
  description.surface = random_grid(9, 7);
  description.spacing = 0.25;
  const Terrain ground(description);
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(-1., 1.);
  int bounded = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d center{-0.3 + 1.3 * unit(generator), 1.15 + 1. * unit(generator),
                          0.5 + 0.4 * unit(generator)};
    const Quaterniond turn =
        exponential(Vector3d{3. * unit(generator), 3. * unit(generator), 3. * unit(generator)});
    const Vector3d half{0.12, 0.05, 0.08};
    const double bound = ground.deepest(center, rotation_matrix(turn), half);
    if (std::isinf(bound)) continue;
    ++bounded;
    EXPECT_LT(bound, 0.);
    for (int corner = 0; corner < 27; ++corner) {
      const Vector3d share{corner % 3 - 1., corner / 3 % 3 - 1., corner / 9 - 1.};
      const Vector3d point =
          center + rotate(turn, Vector3d{share.x * half.x, share.y * half.y, share.z * half.z});
      const TilePoint tile = ground.query(point);
      EXPECT_LE(tile.depth, bound + 1e-12);
      EXPECT_FALSE(tile.outside);
    }
  }
  EXPECT_GT(bounded, 500);
  const Matrix3d level = Matrix3d::identity();
  EXPECT_TRUE(std::isinf(ground.deepest({-0.3, 1.1, 0.3}, level, {0.1, 0.1, 0.1})))
      << "in reach of the highest vertex";
  EXPECT_TRUE(std::isinf(ground.deepest({-1.25, 1.1, 3.}, level, {0.1, 0.1, 0.1})))
      << "over the edge, where the edge's plane goes on";
}

TEST(Terrain, DepthIsAlongTheNormalOfAPlane) {
  const Terrain flat(TerrainDescription{FlatSurface{0.25}, 1., 0., 0., 0, {}});
  EXPECT_EQ(flat.query(3., -700., 0.2).normal, (Vector3d{0., 0., 1.}));
  EXPECT_NEAR(flat.query(3., -700., 0.2).depth, 0.05, 1e-15);

  const double angle = 25. * degree;
  const double azimuth = 40. * degree;
  const Terrain ground(slope(angle, azimuth));
  const Vector3d normal{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                        std::cos(angle)};
  for (const Vector3d point :
       {Vector3d{0.3, 0.2, -5.}, Vector3d{-8., 3., 1.}, Vector3d{1e3, 2e3, 0.}}) {
    const TilePoint tile = ground.query(point);
    EXPECT_LE(norm(tile.normal - normal), 1e-15);
    EXPECT_NEAR(tile.depth, -dot(point, normal), 1e-12);
    EXPECT_FALSE(tile.outside);
  }
  EXPECT_LT(ground.query(std::cos(azimuth), std::sin(azimuth), 0.).height,
            0.);  // falls along its azimuth
}

TEST(Terrain, GridOfASlopesHeightsIsThatSlope) {
  const Terrain plane(slope(20. * degree, 1.1));
  TerrainDescription description;
  GridSurface grid{6, 5, {}, -1., -2.};
  description.spacing = 0.5;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 6; ++column) {
      grid.heights.push_back(plane.query(-1. + 0.5 * column, -2. + 0.5 * row, 0.).height);
    }
  }
  description.surface = grid;
  const Terrain tiled(description);
  for (double x = -0.97; x < 1.5; x += 0.13) {
    for (double y = -1.99; y < 0.; y += 0.11) {
      const TilePoint a = plane.query(x, y, 0.1);
      const TilePoint b = tiled.query(x, y, 0.1);
      EXPECT_NEAR(a.depth, b.depth, 1e-14);
      EXPECT_LE(norm(a.normal - b.normal), 1e-14);
    }
  }
}

/// The height and normal of the triangle a b c over (x, y), when it is over it: by barycentric
/// coordinates.
std::optional<TilePoint> over_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                       double x, double y) {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  const double at_b = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
  const double at_c = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
  const double at_a = 1. - at_b - at_c;
  if (at_a < 0. || at_b < 0. || at_c < 0.) return std::nullopt;
  TilePoint found;
  found.height = at_a * a.z + at_b * b.z + at_c * c.z;
  const Vector3d normal = cross(b - a, c - a);
  found.normal = (1. / norm(normal)) * normal;
  return found;
}

TEST(Terrain, FindsTheTriangleThatASearchOverAllFinds) {
  const GridSurface grid = random_grid(7, 5);
  const double spacing = 0.3;
  const Terrain terrain(TerrainDescription{grid, spacing, 0., 0., 0, {}});
  const auto vertex = [&](int i, int j) {
    return Vector3d{grid.origin_x + spacing * i, grid.origin_y + spacing * j,
                    grid.heights[j * grid.columns + i]};
  };
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> along(0., 1.);
  for (int trial = 0; trial < 2000; ++trial) {
    const double x = grid.origin_x + spacing * 6. * along(generator);
    const double y = grid.origin_y + spacing * 4. * along(generator);
    std::optional<TilePoint> expected;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 6; ++i) {
        const auto lower =
            over_triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), x, y);
        const auto upper =
            over_triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1), x, y);
        if (lower) expected = lower;
        if (upper) expected = upper;
      }
    }
    ASSERT_TRUE(expected.has_value());
    const TilePoint found = terrain.query(x, y, -1.);
    EXPECT_NEAR(found.height, expected->height, 1e-14);
    EXPECT_LE(norm(found.normal - expected->normal), 1e-13);
    EXPECT_NEAR(found.depth, (found.height + 1.) * expected->normal.z, 1e-13);
    EXPECT_FALSE(found.outside);
  }
}

TEST(Terrain, ContinuesTheEdgeTileOutsideAndSaysSo) {
  TerrainDescription description{GridSurface{2, 2, {0., 1., 0., 1.}, 0., 0.}, 1., 0., 0., 0, {}};
  const Terrain grid(description);
  EXPECT_FALSE(grid.query(1., 1., 0.).outside);
  const TilePoint far = grid.query(3., 0.5, 0.);
  EXPECT_TRUE(far.outside);
  EXPECT_NEAR(far.height, 3., 1e-15);
  EXPECT_TRUE(grid.query(0.5, -1e-9, 0.).outside);
  EXPECT_NE(grid.outside_message({3., 0.5, 0.}).find("from 0 to 1 m"), std::string::npos);

  const Terrain plate(TerrainDescription{FlatSurface{0.}, 0.3, 2., 4., 0, {}});
  EXPECT_FALSE(plate.query(0.999, -1.999, 0.).outside);
  EXPECT_TRUE(plate.query(1.001, 0., 0.).outside);
  EXPECT_TRUE(plate.query(0., -2.001, 0.).outside);
  EXPECT_EQ(plate.query(50., 0., -1.).depth, 1.);
  const double nan = std::nan("");
  EXPECT_TRUE(
      std::isnan(grid.query(nan, 0., 0.).depth));  // shows, and touches no height that is not there
}

TEST(Terrain, PaintsTilesByTheirCentroid) {
  TerrainDescription description;
  description.material = 4;
  description.patches = {{0., 0., 2., 1., 1}, {1., 1., 0.55, 0.2, 2}};
  const auto check = [&](const TerrainDescription& painted) {
    const Terrain terrain(painted);
    EXPECT_EQ(terrain.query(0.5, 0.4, 0.).material,
              2);  // lower half of cell (0,0), centroid (2/3, 1/3)
    EXPECT_EQ(terrain.query(0.5, 0.6, 0.).material, 1);  // upper half, centroid (1/3, 2/3)
    EXPECT_EQ(terrain.query(1.9, 0.01, 0.).material, 1);
    EXPECT_EQ(terrain.query(1.9, 1.01, 0.).material, 4);
  };
  check(description);  // an unbounded plane
  description.surface = GridSurface{4, 3, std::vector<double>(12, 0.), 0., 0.};
  check(description);
  description.surface = FlatSurface{};
  const Terrain plane(description);
  EXPECT_EQ(plane.query(-0.5, -0.4, 0.).material, 4);
}

TEST(Terrain, LiesABodyOnItsTile) {
  const double angle = 30. * degree;
  const Terrain ground(slope(angle, 0.));
  const TilePose pose = ground.pose_on_tile(2., 1., 0.);
  EXPECT_NEAR(pose.position.z, -2. * std::tan(angle), 1e-15);
  EXPECT_LE(norm(rotate(pose.orientation, Vector3d{0., 0., 1.}) - pose.tile.normal), 1e-15);
  EXPECT_LE(norm(rotate(pose.orientation, Vector3d{1., 0., 0.}) -
                 Vector3d{std::cos(angle), 0., -std::sin(angle)}),
            1e-15);  // x downhill
  // Yawed by the azimuth, x points downhill on a slope of any azimuth.
  const Terrain turned(slope(angle, 2.));
  const TilePose yawed = turned.pose_on_tile(0., 0., 2.);
  EXPECT_LE(norm(rotate(yawed.orientation, Vector3d{1., 0., 0.}) -
                 Vector3d{std::cos(angle) * std::cos(2.), std::cos(angle) * std::sin(2.),
                          -std::sin(angle)}),
            1e-15);
}

TEST(Terrain, SaysWhatIsWrongWithADescription) {
  EXPECT_EQ(Terrain::problem(TerrainDescription{}), "");
  const auto problem_of = [](auto change) {
    TerrainDescription description;
    change(description);
    return Terrain::problem(description);
  };
  EXPECT_EQ(problem_of([](auto& d) { d.spacing = 0.; }),
            "the spacing of a terrain must be positive");
  EXPECT_EQ(problem_of([](auto& d) { d.size_x = -1.; }),
            "the size of a terrain must not be negative (0: unbounded)");
  EXPECT_EQ(problem_of([](auto& d) {
              d.surface = SlopeSurface{90. * degree, 0.};
            }),
            "the angle of a slope must be from 0 to below 90 deg");
  EXPECT_EQ(problem_of([](auto& d) {
              d.surface = GridSurface{3, 2, {1., 2.}, 0., 0.};
            }),
            "a grid of 3 x 2 vertices needs 6 heights, got 2");
  EXPECT_EQ(problem_of([](auto& d) {
              d.surface = GridSurface{2, 2, {1., 2., 3., std::nan("")}, 0., 0.};
            }),
            "the heights of a grid must be finite");
}

/// How many of the points are at different places, to a nanometre.
std::size_t distinct(const std::vector<Vector3d>& points) {
  std::set<std::array<long, 3>> places;
  for (const Vector3d& p : points) {
    places.insert({std::lround(p.x * 1e9), std::lround(p.y * 1e9), std::lround(p.z * 1e9)});
  }
  return places.size();
}

TEST(BoundaryPoints, LieOnTheShapesAndAreDistinct) {
  for (const int n : {0, 1, 2, 3, 5}) {
    const int edge = std::max(n, 1);
    const auto box = box_points({0.2, 0.4, 0.6}, n);
    EXPECT_EQ(box.size(), std::pow(edge + 1, 3) - std::pow(edge - 1, 3));
    EXPECT_EQ(distinct(box), box.size());
    for (const Vector3d& p : box) {
      EXPECT_NEAR(std::max({std::abs(p.x) / 0.1, std::abs(p.y) / 0.2, std::abs(p.z) / 0.3}), 1.,
                  1e-15);
    }
    const auto sphere = sphere_points(0.3, n);
    EXPECT_EQ(distinct(sphere), sphere.size());
    for (const Vector3d& p : sphere) EXPECT_NEAR(norm(p), 0.3, 1e-15);
  }
  EXPECT_EQ(sphere_points(1., 0).size(), 26u);
  EXPECT_EQ(cylinder_points(1., 2., 0).size(), 16u);
  for (const Vector3d& p : cylinder_points(0.5, 2., 5)) {
    EXPECT_NEAR(std::hypot(p.x, p.y), 0.5, 1e-15);
    EXPECT_EQ(std::abs(p.z), 1.);
  }
  const auto cone = legcone_points(0.3, 0.04, 0.01, 6);
  EXPECT_EQ(cone.size(), 12u);
  EXPECT_EQ(distinct(cone), 12u);
  for (const Vector3d& p : cone) {
    EXPECT_TRUE(p.x == 0. || p.x == 0.3);
    EXPECT_NEAR(std::hypot(p.y, p.z), p.x == 0. ? 0.04 : 0.01, 1e-15);
  }
  EXPECT_EQ(legcone_points(0.3, 0.04, 0., 6).size(), 7u);
  EXPECT_EQ(legcone_points(0.3, 0.04, 0., 6).back(), (Vector3d{0.3, 0., 0.}));
}

}  // namespace
}  // namespace hookpoint::contact
