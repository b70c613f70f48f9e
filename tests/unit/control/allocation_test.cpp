// An update allocates nothing: counted at operator new, for every class that is registered.
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

TEST(ControlAllocation, NoUpdateAllocates) {
  const testing::TemporaryFile file("allocation.csv", "time,x\n0,1\n0.01,2\n0.02,1\n0.03,4\n");
  for (const auto& [name, type] : control::Registry::instance().classes()) {
    testing::ComponentBench bench(name);
    if (name == "Data" || name == "Controller.Trajectory") bench.text("file", file.path());
    if (name == "Data") bench.text("column", "x");
    bench.component().set_open_count(3);  // of those that take as many as their formulas name
    if (name == "Expression") bench.text("formula", "previous + sin(a) * min(b, time, 2)");
    if (name == "StateMachine")
      bench.text("program", "state a + hypot(b, 2)\nto 1 time > 0.05\nstate 1\nto 0 time < 0\n");
    ASSERT_EQ(testing::start_error(bench), "") << name;
    const long before = testing::allocation_count();
    bench.tick(100);
    EXPECT_EQ(testing::allocation_count() - before, 0) << name;
  }
}

}  // namespace
}  // namespace hookpoint
