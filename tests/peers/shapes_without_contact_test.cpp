// A shape with `contact = false` touches nothing, whoever computes the motion.
#include <gtest/gtest.h>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

// A slab of 0.2 m that would lie 0.1 m above the ground, around a block of 0.1 m that lies on it.
constexpr const char* scene =
    "World w { gravity = 9.81; deltat = 1 ms; Material m { normal_stiffness = 20 kN/m; "
    "normal_damping = 200; } Terrain.Flat f { material = m; } Robot b { Base.mobile { location = "
    "0, "
    "0, 0.051; Shape.Box { dimensions = 0.4, 0.4, 0.2; mass = 1 kg; contact = false; } Shape.Box { "
    "dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } } }";

void expect_on_the_block(const std::string& name, simulation::EngineFactory make) {
  SCOPED_TRACE(name);
  const Loaded loaded = load_text(scene);
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "");
  Running run(loaded, make);
  run.step(1000);
  EXPECT_NEAR(run["w.b.base.location.z"], 0.05, 2e-3);
  EXPECT_NEAR(run["w.b.base.orientation.w"], 1., 1e-3);
}

TEST(ShapesWithoutContact, TouchNothingInAnyEngine) {
  expect_on_the_block("dts", simulation::make_dts);
  for (const reference::Peer& peer : reference::known_peers())
    if (peer.describe().found) expect_on_the_block(std::string(peer.name), peer.make);
}

}  // namespace
}  // namespace hookpoint
