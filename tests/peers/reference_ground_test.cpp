// The peers on computed ground: the tile that a small ball meets is the tile that our terrain has
// there.
#include <gtest/gtest.h>

#include <random>

#include "contact/terrain/terrain.h"
#include "reference/engines.h"
#include "simulation/scene/terrain/surface.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

constexpr double radius = 0.004;

simulation::TerrainSpec ground(simulation::GridSpec grid, double spacing) {
  simulation::TerrainSpec terrain;
  terrain.surface = std::move(grid);
  terrain.spacing = spacing;
  return terrain;
}

/// A ball 10 um inside the ground at `p`, where the tile's normal is `normal`; without gravity, so
/// that nothing but the tile acts on it, however soft the engine's ground is.
simulation::Experiment ball_on(const simulation::TerrainSpec& terrain, const Vector3d& p,
                               const Vector3d& normal) {
  simulation::Experiment experiment = empty_world(0.8, 1e-4, "default");
  experiment.gravity = {};
  experiment.terrain = terrain;
  simulation::RobotSpec robot = block();
  robot.base.shapes[0].geometry = simulation::Sphere{radius};
  robot.base.mass.inertia = {1e-5, 1e-5, 1e-5, 0., 0., 0.};
  robot.location = p + (radius - 1e-5) * normal;
  experiment.robots.push_back(robot);
  return experiment;
}

TEST(PeerGround, EveryTileOfRoughGroundIsWhereOursIs) {
  const simulation::Extent extent{0.05, 2., 2.};
  const simulation::TerrainSpec terrain =
      ground(simulation::rough_surface({0.04, 0.4, 3, 0., 0., 0.}, extent), extent.spacing);
  const contact::Terrain ours(terrain);
  std::mt19937 generator(5);
  std::uniform_int_distribution<int> cell(-18, 17);
  for (const auto& peer : reference::peers()) {
    if (refuses(peer, reference::feature::height_field)) continue;
    for (int n = 0; n < 12; ++n) {
      // The centroid of a lower or an upper triangle.
      const double s = n % 2 == 0 ? 2. / 3. : 1. / 3.;
      const double x = 0.05 * (cell(generator) + s), y = 0.05 * (cell(generator) + 1. - s);
      const contact::TilePoint tile = ours.query(x, y, 0.);
      const auto engine = peer.make(ball_on(terrain, {x, y, tile.height}, tile.normal));
      ASSERT_TRUE(engine->step().ok());
      const Vector3d force = engine->state().bodies[0].contact_force;
      EXPECT_GT(norm(force), 0.01) << peer.name;
      EXPECT_GT(dot(force, tile.normal), 0.9999 * norm(force)) << peer.name;
    }
  }
}

}  // namespace
}  // namespace hookpoint
