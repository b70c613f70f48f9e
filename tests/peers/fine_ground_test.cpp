// Ground of fine cells in the reference engines: what a library cannot hold is refused before it
// allocates anything, and contacts that it drops are said.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "reference/engines.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

/// Level ground of `columns` x `columns` heights, `spacing` [m] apart about the origin.
simulation::TerrainSpec level_grid(int columns, double spacing) {
  simulation::GridSpec grid;
  grid.columns = grid.rows = columns;
  grid.origin_x = grid.origin_y = -0.5 * spacing * (columns - 1);
  grid.heights.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns), 0.);
  simulation::TerrainSpec terrain;
  terrain.name = "field";
  terrain.spacing = spacing;
  terrain.surface = grid;
  return terrain;
}

/// The block at rest on it.
simulation::Experiment block_on(const simulation::TerrainSpec& terrain) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  experiment.terrain = terrain;
  return experiment;
}

const reference::Peer* find(std::string_view name) {
  for (const reference::Peer& peer : reference::peers())
    if (peer.name == name && peer.found()) return &peer;
  return nullptr;
}

/// All notices of some steps.
std::string notices(const reference::Peer& peer, const simulation::Experiment& experiment) {
  const auto engine = peer.make(experiment);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(engine->step().ok()) << peer.name;
  std::string all;
  for (const std::string& notice : engine->state().notices) all += notice + "\n";
  return all;
}

// 2 (n - 1)^2 triangles.
TEST(FineGround, OfMoreTrianglesThanALibraryHoldsIsRefused) {
  int limited = 0;
  for (const reference::Peer& peer : reference::peers()) {
    if (!peer.found() || peer.triangles.most == 0) continue;
    ++limited;
    int columns = 2;
    while (2. * (columns - 1.) * (columns - 1.) <= static_cast<double>(peer.triangles.most))
      ++columns;
    const std::string said = refusal(peer, block_on(level_grid(columns, 1e-3)));
    EXPECT_NE(said.find("terrain 'field'"), std::string::npos) << peer.name << ": " << said;
    EXPECT_NE(said.find("raise its spacing"), std::string::npos) << peer.name << ": " << said;
  }
  EXPECT_GE(limited, 2);
}

// 20 x 20 cells under the block, 50 contacts at most (mjMAXCONPAIR).
TEST(FineGround, WhoseContactsMujocoDropsIsNoticed) {
  const reference::Peer* mujoco = find("mujoco");
  if (mujoco == nullptr) GTEST_SKIP() << "this build has no MuJoCo";
  simulation::Experiment experiment = block_on(level_grid(101, 0.01));
  experiment.robots[0].location.z -= 1e-3;
  const std::string said = notices(*mujoco, experiment);
  EXPECT_NE(said.find("50 contacts of block.base"), std::string::npos) << said;
  EXPECT_EQ(said.find("50 contacts"), said.rfind("50 contacts")) << said;
  EXPECT_NE(said.find("spacing"), std::string::npos) << said;
}

TEST(FineGround, WithFewCellsUnderTheBlockIsNotNoticed) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!peer.found() || refuses(peer, reference::feature::height_field)) continue;
    simulation::Experiment experiment = block_on(level_grid(5, 0.25));
    experiment.robots[0].location.z -= 1e-4;
    EXPECT_EQ(notices(peer, experiment).find("contacts of"), std::string::npos) << peer.name;
  }
}

}  // namespace
}  // namespace hookpoint
