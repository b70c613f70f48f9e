// A thousand drawn yards, and a hundred under each law at the step that the program chooses: each whose
// stiffness an impact does not raise over that under weight, for which the step is chosen.
// ctest: full, long
#include <gtest/gtest.h>

#include <string>

#include "tests/support/drawn_yard.h"

namespace hookpoint {
namespace {

using namespace test_support;

void expect_no_fault(unsigned count, const YardOf& of) {
  for (unsigned seed = 1; seed <= count; ++seed) {
    const DrawnYard yard(seed, of);
    EXPECT_EQ(fault_of(yard, of), "") << "seed " << seed;
  }
}

TEST(ThousandYards, KeepTheirEnergyWithoutFrictionAndDamping) {
  expect_no_fault(1000, elastic_yard());
}

class YardsUnder : public ::testing::TestWithParam<const char*> {};

TEST_P(YardsUnder, EachLawComeToRest) { expect_no_fault(100, damped_yard(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Laws, YardsUnder,
                         ::testing::Values("hookpoint", "hookpoint_reset", "nominal", "lugre",
                                           "elastoplastic"));

}  // namespace
}  // namespace hookpoint
