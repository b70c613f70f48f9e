// A share of the coverage study of calibration_coverage_full_test.cpp, for every change.
// ctest: released
#include <gtest/gtest.h>

#include "tests/support/synthetic_calibration.h"

namespace hookpoint {
namespace {

using namespace testing;

TEST(CalibrationCoverage, OfAFlatDirectionNoConstantIsIdentified) {
  SyntheticCalibrations calibrations;
  SyntheticCounts counts;
  // Every push, scale and method once.
  for (std::size_t number = 0; number < 28; ++number)
    calibrations.add(pushes_with_a_flat_direction, number, counts);
  EXPECT_EQ(counts.calibrations, 28);
  EXPECT_EQ(counts.wrongly_identified, 0) << counts.faults;
}

TEST(CalibrationCoverage, WithoutOneIntervalsHoldTheTruth) {
  SyntheticCalibrations calibrations;
  SyntheticCounts counts;
  for (std::size_t number = 0; number < 20; ++number)
    calibrations.add(pushes_without_one, number, counts);
  EXPECT_EQ(counts.intervals, 40);
  // Binomial with 95 %: fewer than 34 with a chance of 0.3 %.
  EXPECT_GE(counts.holding, 34);
}

}  // namespace
}  // namespace hookpoint
