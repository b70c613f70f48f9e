// A step with wires, components, noise, delays and forces allocates nothing.
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

TEST(WiringAllocation, AStepAllocatesNothing) {
  Running run(
      "World w { Robot bot { Base.mobile { mass = 1; Shape.Sphere radius = 1; } For i in 0..2 { "
      "Chain "
      "leg[i] { Link l { mass = 1; Shape.Sphere radius = 0.1; Controller.PD p { rate = 300 Hz; "
      "delay = 5 "
      "ms; noise = 0.1 deg; pconstant = 5; Wire FROM l.angle; Wire FROM l.rate TO rate_in; Wire TO "
      "l.torque; } } } } } Push push { body = bot.base; force = 1,0,0; to = 10 ms; edge = 2 ms; } "
      "Force f "
      "{ body = bot.base; } Gain g { Wire FROM bot.leg[1].l.p; Wire TO f.force.x; } }");
  run.step();
  const long before = testing::allocation_count();
  run.step(100);
  EXPECT_EQ(testing::allocation_count() - before, 0);
}

}  // namespace
}  // namespace hookpoint
