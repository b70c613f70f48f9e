// Drawn bodies of every shape on drawn ground, among obstacles and on each other (drawn_yard.h): nothing
// gains energy, falls through the ground or passes through another. A thousand more are
// shape_energy_full_test's.
#include <gtest/gtest.h>

#include "tests/support/drawn_yard.h"

namespace hookpoint {
namespace {

using namespace test_support;

class DrawnYards : public ::testing::TestWithParam<unsigned> {};

TEST_P(DrawnYards, KeepTheirEnergyWithoutFrictionAndDamping) {
  const DrawnYard yard(GetParam(), elastic_yard());
  EXPECT_EQ(fault_of(yard, elastic_yard()), "");
}

TEST_P(DrawnYards, ComeToRestWithThem) {
  const YardOf of = damped_yard("hookpoint");
  EXPECT_EQ(fault_of(DrawnYard(GetParam(), of), of), "");
}

// Those from 116 on once failed: discs, cones and tins that met rims, edges and each other, corners beside a capsule and over a nosing,
// a ball on gentle ridges that were taken for seams.
INSTANTIATE_TEST_SUITE_P(Seeds, DrawnYards,
                         ::testing::Values(1u, 2u, 3u, 116u, 157u, 173u, 207u, 369u, 477u, 510u,
                                           528u, 905u));

}  // namespace
}  // namespace hookpoint
