// A point that crosses from tile to tile: the force of every law jumps by what the tiles' normals
// and materials dictate, and by nothing else.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "contact/force_law.h"
#include "contact/terrain/terrain.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::contact {
namespace {

using Materials = std::vector<MaterialConstants<double>>;

std::vector<std::string> force_laws() {
  std::vector<std::string> names;
  for (const LawDescription& law : law_table()) {
    if (!law.is_impulse_law) names.emplace_back(law.name);
  }
  return names;
}

/// The normal force of a point at rest, as the laws' sources have it (docs/contact.md).
double resting_force(const std::string& law, double d, const MaterialConstants<double>& m) {
  if (law == "hunt_crossley") return m.normal_stiffness * std::pow(d, m.exponent);
  if (law == "azad_featherstone") return m.normal_stiffness * std::pow(d, 1.5);
  if (law == "exponential") {
    return m.exponential_force * std::exp(m.exponential_rate * (d + m.exponential_height));
  }
  if (law == "nominal") {
    const double beyond = std::max(0., d - m.nominal_penetration);
    return m.nominal_stiffness * (d - beyond) + m.normal_stiffness * beyond;
  }
  return m.normal_stiffness * d;
}

class Random {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int operator()(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator_);
  }

 private:
  std::mt19937_64 generator_{11};
};

/// A triangle of the tiling, made from its vertices alone.
struct Triangle {
  Vector3d normal;
  Vector3d centroid;
};

/// A ground of random patches, with its vertices at hand.
struct Ground {
  TerrainDescription description;

  const GridSurface& grid() const { return std::get<GridSurface>(description.surface); }
  Vector3d vertex(int i, int j) const {
    return {grid().origin_x + description.spacing * i, grid().origin_y + description.spacing * j,
            grid().heights[j * grid().columns + i]};
  }
  Triangle triangle(int i, int j, bool upper) const {
    const Vector3d a = vertex(i, j), c = vertex(i + 1, j + 1);
    const Vector3d b = upper ? vertex(i, j + 1) : vertex(i + 1, j);
    const Vector3d n = upper ? cross(c - a, b - a) : cross(b - a, c - a);
    return {(1. / norm(n)) * n, (1. / 3.) * (a + b + c)};
  }
  int material_of(const Triangle& triangle) const {
    int material = description.material;
    for (const MaterialPatch& patch : description.patches) {
      const Vector3d& p = triangle.centroid;
      if (p.x >= patch.from_x && p.x <= patch.to_x && p.y >= patch.from_y && p.y <= patch.to_y) {
        material = patch.material;
      }
    }
    return material;
  }
};

Materials random_materials(Random& random) {
  Materials materials(4);
  for (MaterialConstants<double>& m : materials) {
    m.normal_stiffness = random(1e3, 1e5);
    m.nominal_stiffness = random(1e3, 1e4);
    m.nominal_penetration = random(5e-4, 2e-3);
    m.exponent = random(1., 2.);
    m.exponential_rate = random(100., 500.);
  }
  return materials;
}

void paint(Ground& ground, Random& random) {
  const double side = ground.description.spacing * (ground.grid().columns - 1);
  for (int n = 0; n < 12; ++n) {
    const double x = ground.grid().origin_x + random(0., side);
    const double y = ground.grid().origin_y + random(0., side);
    const double width = random(0., 0.4 * side);
    ground.description.patches.push_back({x, y, x + width, y + random(0., 0.4 * side), n % 4});
  }
}

Ground rough_ground(Random& random) {
  simulation::RoughGround rough;
  rough.amplitude = 0.05;
  rough.wavelength = 0.3;
  Ground ground;
  ground.description.spacing = 0.06;
  ground.description.surface = simulation::rough_surface(rough, {0.06, 3., 3.});
  paint(ground, random);
  return ground;
}

Ground jagged_ground(Random& random) {
  GridSurface grid{41, 41, {}, -1.234, 0.777};
  for (int n = 0; n < 41 * 41; ++n) grid.heights.push_back(random(-0.05, 0.05));
  Ground ground;
  ground.description.spacing = 0.0731;
  ground.description.surface = std::move(grid);
  paint(ground, random);
  return ground;
}

/// A place where tiles meet, and a step into each of them.
struct Crossing {
  Vector3d place;
  struct Side {
    double step_x, step_y;
    Triangle triangle;
  };
  std::vector<Side> sides;
};

Crossing across_edge(const Ground& g, int i, int j, int kind, double along) {
  const Vector3d a = g.vertex(i, j);
  const Vector3d b = kind == 0   ? g.vertex(i, j + 1)
                     : kind == 1 ? g.vertex(i + 1, j)
                                 : g.vertex(i + 1, j + 1);
  const Vector3d place = a + along * (b - a);
  if (kind == 0)
    return {place, {{-1., 0., g.triangle(i - 1, j, false)}, {1., 0., g.triangle(i, j, true)}}};
  if (kind == 1)
    return {place, {{0., -1., g.triangle(i, j - 1, true)}, {0., 1., g.triangle(i, j, false)}}};
  return {place, {{1., -1., g.triangle(i, j, false)}, {-1., 1., g.triangle(i, j, true)}}};
}

Crossing across_vertex(const Ground& g, int i, int j) {
  return {g.vertex(i, j),
          {{2., 1., g.triangle(i, j, false)},
           {1., 2., g.triangle(i, j, true)},
           {-1., 1., g.triangle(i - 1, j, false)},
           {-2., -1., g.triangle(i - 1, j - 1, true)},
           {-1., -2., g.triangle(i - 1, j - 1, false)},
           {1., -1., g.triangle(i, j - 1, true)}}};
}

class Crossings : public ::testing::TestWithParam<std::string> {
 protected:
  /// On every side of a crossing the force is N(d n_z) n of that side's own tile and material, d
  /// the one vertical depth that all sides share.
  void check(const Ground& ground, const Terrain& terrain, const Materials& materials,
             const Crossing& crossing, double vertical_depth) {
    const LawDescription& law = *find_force_law(GetParam());
    for (const Crossing::Side& side : crossing.sides) {
      constexpr double step = 1e-12;  // [m]
      PointKinematics<double> point;
      point.position =
          crossing.place + Vector3d{step * side.step_x, step * side.step_y, -vertical_depth};
      const TilePoint tile = terrain.query(point.position);
      const int material = ground.material_of(side.triangle);
      ASSERT_EQ(tile.material, material);
      point.normal = tile.normal;
      point.depth = tile.depth;
      const Vector3d force = law.evaluate(point, {}, materials[tile.material], 1e-4).force;
      const double depth = vertical_depth * side.triangle.normal.z;
      const Vector3d expected =
          resting_force(GetParam(), depth, materials[material]) * side.triangle.normal;
      // The step into the tile changes its height by up to 4e-12 m, against a depth of at least
      // 2e-4 m to the power of at most 2.
      ASSERT_LE(norm(force - expected), 1e-7 * norm(expected))
          << "at " << crossing.place.x << ", " << crossing.place.y;
    }
  }
};

TEST_P(Crossings, JumpByNormalAndStiffnessAlone) {
  Random random;
  for (const bool rough : {true, false}) {
    const Ground ground = rough ? rough_ground(random) : jagged_ground(random);
    const Terrain terrain(ground.description);
    const Materials materials = random_materials(random);
    const int last = ground.grid().columns - 2;
    int borders = 0;
    for (int n = 0; n < 400; ++n) {
      const int i = random(1, last), j = random(1, last);
      const double depth = random(2e-4, 4e-3);
      for (const int kind : {0, 1, 2}) {
        const Crossing crossing = across_edge(ground, i, j, kind, random(0.01, 0.99));
        borders += ground.material_of(crossing.sides[0].triangle) !=
                   ground.material_of(crossing.sides[1].triangle);
        check(ground, terrain, materials, crossing, depth);
      }
      check(ground, terrain, materials, across_vertex(ground, i, j), depth);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(borders, 20);
  }
}

/// The law's forces along a path over a terrain, with the memory and the bristle that they leave.
std::vector<Vector3d> forces_along(const LawDescription& law, const std::vector<Vector3d>& path,
                                   const Terrain& terrain, const Materials& materials, double dt) {
  std::vector<Vector3d> forces;
  Memory<double> memory;
  Bristle<double> bristle;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const TilePoint tile = terrain.query(path[k]);
    PointKinematics<double> point;
    point.position = path[k];
    point.velocity = (1. / dt) * (path[k] - path[k - 1]);
    point.normal = tile.normal;
    point.depth = tile.depth;
    point.bristle = bristle;
    const Reaction<double> reaction = law.evaluate(point, memory, materials[tile.material], dt);
    forces.push_back(reaction.force);
    memory = reaction.next;
    bristle.deflection = reaction.bristle.deflection + dt * reaction.bristle_rate.deflection;
    bristle.sliding = reaction.bristle.sliding + dt * reaction.bristle_rate.sliding;
  }
  return forces;
}

/// A random walk about 1 mm inside the plane; `reach` [m] of every move.
std::vector<Vector3d> walk(const Terrain& plane, double reach, Random& random) {
  std::vector<Vector3d> path{{1e-7, 2e-7, 0.}};
  double depth = 1e-3;
  for (int n = 0; n < 300; ++n) {
    Vector3d next = path.back();
    next.x += random(-reach, reach);
    next.y += random(-reach, reach);
    depth = std::clamp(depth + random(-1e-5, 1e-5), 5e-4, 2e-3);
    next.z = plane.query(next.x, next.y, 0.).height - depth;
    path.push_back(next);
  }
  path.front().z = plane.query(path.front().x, path.front().y, 0.).height - 1e-3;
  return path;
}

constexpr double slope_angle = 0.3, slope_azimuth = 0.8;

Terrain plane() {
  TerrainDescription description;
  description.surface = SlopeSurface{slope_angle, slope_azimuth};
  return Terrain(description);
}

/// The same plane in tiles, each vertex off it by up to `crease` spacings.
Terrain tiled_plane(double spacing, double crease, Random& random) {
  GridSurface grid{201, 201, {}, -100. * spacing, -100. * spacing};
  const Terrain flat = plane();
  for (int j = 0; j < 201; ++j) {
    for (int i = 0; i < 201; ++i) {
      const double height =
          flat.query(grid.origin_x + spacing * i, grid.origin_y + spacing * j, 0.).height;
      grid.heights.push_back(height + spacing * crease * random(-1., 1.));
    }
  }
  TerrainDescription description;
  description.surface = std::move(grid);
  description.spacing = spacing;
  return Terrain(description);
}

double largest_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double largest = 0.;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, norm(a[k] - b[k]));
  return largest;
}

// Tiles that lie in one plane are one plane, for a point that sticks, slips, and remembers:
// crossing their edges, vertices and diagonals by the hundred leaves nothing but rounding.
TEST_P(Crossings, OfCoplanarTilesLeaveNoTrace) {
  Random random;
  const LawDescription& law = *find_force_law(GetParam());
  const Materials materials(1);
  for (const double reach : {2e-5, 2e-3}) {
    for (int n = 0; n < 10; ++n) {
      const double spacing = 2. * reach * random(0.5, 5.);
      const auto path = walk(plane(), reach, random);
      const auto untiled = forces_along(law, path, plane(), materials, 1e-4);
      const Terrain tiles = tiled_plane(spacing, 0., random);
      const auto tiled = forces_along(law, path, tiles, materials, 1e-4);
      // k times the rounding of heights of 0.1 m; N times that of gradients over one cell.
      EXPECT_LE(largest_difference(untiled, tiled), 1e-6);
    }
  }
}

// A crease costs force in proportion to its angle and to nothing else: what a point remembers
// crosses it. A sticking point dances about a vertex of six tiles.
TEST_P(Crossings, OfACreaseJumpInProportionToIt) {
  Random random;
  const LawDescription& law = *find_force_law(GetParam());
  Materials materials(1);
  materials[0].static_friction = materials[0].kinetic_friction = 1.5;
  const auto path = walk(plane(), 2e-6, random);
  const auto untiled = forces_along(law, path, plane(), materials, 1e-4);
  double last = 0.;
  for (const double crease : {1e-4, 1e-5, 1e-6}) {
    Random same;
    const Terrain tiles = tiled_plane(0.01, crease, same);
    const auto tiled = forces_along(law, path, tiles, materials, 1e-4);
    const double jump = largest_difference(untiled, tiled) / crease;
    EXPECT_GT(jump, 0.);
    if (last > 0.) {
      EXPECT_NEAR(jump / last, 1., 0.05) << crease;
    }
    last = jump;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Crossings, ::testing::ValuesIn(force_laws()),
                         [](const auto& tested) { return tested.param; });

// A hooked foot that crosses a material border on level ground: k1 d -> k2 d, c1 d' -> c2 d' along
// the normal; k_t1 e -> k_t2 e, c_t1 v -> c_t2 v along the ground while it sticks; mu1 N1 -> mu2 N2
// while it slips.
TEST(MaterialBorder, ChangesTheConstantsAndNothingElse) {
  Random random;
  for (int n = 0; n < 500; ++n) {
    Materials materials(2);
    for (MaterialConstants<double>& m : materials) {
      m.normal_stiffness = random(1e3, 1e5);
      m.normal_damping = random(0., 300.);
      m.tangential_stiffness = random(1e3, 1e5);
      m.tangential_damping = random(0., 300.);
      m.static_friction = m.kinetic_friction = n % 2 == 0 ? 1e3 : random(0.01, 0.1);
    }
    TerrainDescription description;
    description.surface = GridSurface{3, 3, std::vector<double>(9, 0.), -1., -1.};
    description.patches = {{0., -1., 1., 1., 1}};
    const Terrain terrain(description);

    PointKinematics<double> point;
    point.velocity = {random(0.01, 0.1), random(-0.1, 0.1), random(-0.01, 0.)};
    point.normal = {0., 0., 1.};
    point.depth = random(1e-3, 3e-3);
    Memory<double> memory;
    memory.attached = true;
    memory.hook = {random(-2e-3, -1e-3), random(-1e-3, 1e-3), 0.};
    memory.stretch = -1. * memory.hook;
    std::array<Vector3d, 2> forces, expected;
    for (const int side : {0, 1}) {
      const double y = 0.3;
      point.position = {side == 0 ? -1e-13 : 1e-13, 0., -point.depth};
      const TilePoint tile = terrain.query(point.position.x, y, point.position.z);
      ASSERT_EQ(tile.material, side);
      forces[side] = Hookpoint::evaluate(point, memory, materials[tile.material], 1e-4).force;
      const MaterialConstants<double>& m = materials[side];
      const double N = m.normal_stiffness * point.depth - m.normal_damping * point.velocity.z;
      const Vector3d v{point.velocity.x, point.velocity.y, 0.};
      Vector3d f = m.tangential_stiffness * memory.stretch + m.tangential_damping * v;
      if (norm(f) > m.static_friction * N) f = (m.kinetic_friction * N / norm(f)) * f;
      expected[side] = Vector3d{0., 0., N} - f;
    }
    const Vector3d jump = forces[1] - forces[0];
    EXPECT_LE(norm(jump - (expected[1] - expected[0])), 1e-7 * norm(expected[0]));
  }
}

}  // namespace
}  // namespace hookpoint::contact
