// A port shows the engine's present state, step for step, whichever engine runs.
#include <gtest/gtest.h>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

void expect_present(const char* name, simulation::EngineFactory make) {
  Running run(
      "World w { gravity = 0; Robot b { Base.mobile { mass = 2; velocity = 1,0,0; "
      "Shape.Sphere radius = 1; } } }",
      make);
  const double* x = run.port("b.position.x").value;
  const double* acceleration = run.port("b.linear_acceleration.x").value;
  const double* energy = run.port("b.kinetic_energy").value;
  for (int k = 1; k < 6; ++k) {
    run.step();
    EXPECT_EQ(*x, run.world().state().bodies[0].position.x) << name << " step " << k;
    EXPECT_NEAR(*x, k * 1e-3, 1e-9) << name;
    EXPECT_NEAR(*acceleration, 0., 1e-9) << name;
    EXPECT_NEAR(*energy, 1., 1e-9) << name;
  }
}

TEST(EnginePorts, ShowThePresentState) {
  expect_present("dts", simulation::make_dts);
  for (const reference::Peer& peer : reference::peers()) {
    if (peer.found()) expect_present(std::string(peer.name).c_str(), peer.make);
  }
}

}  // namespace
}  // namespace hookpoint
