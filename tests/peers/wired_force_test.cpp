// A wired Force acts alike on every engine: the same signals around each.
#include <gtest/gtest.h>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

// 1 N/s along x on 2 kg in steps of 1 ms, forces held over a step: after n steps the momentum is
// dt^2 n (n - 1) / 2.
TEST(WiredForce, GivesEveryEngineTheSameMomentum) {
  const std::string text =
      "World w { gravity = 0; Robot b { Base.mobile { mass = 2; Shape.Sphere radius = 1; } } Force "
      "f { "
      "body = b.base; } }\n"
      "Wire FROM w.time TO g.input; Gain g { gain = 1; Wire TO w.f.force.x; }";
  const auto momentum = [&](simulation::EngineFactory make) {
    Running run(text, make);
    run.step(400);
    return 2. * run["b.velocity.x"];
  };
  const double expected = 1e-6 * 400. * 399. / 2.;
  EXPECT_NEAR(momentum(simulation::make_dts), expected, 1e-12);
  int engines = 0;
  for (const reference::Peer& peer : reference::peers()) {
    if (!peer.found()) continue;
    ++engines;
    EXPECT_NEAR(momentum(peer.make), expected, 1e-9) << peer.name;
  }
  EXPECT_GE(engines, 2);
}

}  // namespace
}  // namespace hookpoint
