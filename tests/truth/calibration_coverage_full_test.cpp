// Coverage of the intervals of 400 calibrations, of which 200 have a direction that no curve sees
// (sum, product, ratio, powers, threshold, periodic) and 200 have none; linear and logarithmic
// ranges, least squares and cmaes, fixed seeds.
// ctest: full, released, long
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/support/folders.h"
#include "tests/support/synthetic_calibration.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using namespace testing;

constexpr std::size_t calibrations_of_a_kind = 200;

TEST(CalibrationCoverageFull, OfAFlatDirectionNoConstantIsIdentified) {
  SyntheticCalibrations calibrations;
  SyntheticCounts counts;
  for (std::size_t number = 0; number < calibrations_of_a_kind; ++number)
    calibrations.add(pushes_with_a_flat_direction, number, counts);
  EXPECT_EQ(counts.wrongly_identified, 0) << counts.faults;
  std::printf("flat: %d calibrations, %d wrongly identified, %d of %d intervals hold, %zu models\n",
              counts.calibrations, counts.wrongly_identified, counts.holding, counts.intervals,
              counts.models);
}

TEST(CalibrationCoverageFull, WithoutOneIntervalsHoldTheTruthIn95Percent) {
  SyntheticCalibrations calibrations;
  SyntheticCounts counts;
  for (std::size_t number = 0; number < calibrations_of_a_kind; ++number)
    calibrations.add(pushes_without_one, number, counts);
  const double part = static_cast<double>(counts.holding) / counts.intervals;
  std::printf(
      "none: %d calibrations, %d of %d intervals hold (least squares %d of %d, cmaes %d of "
      "%d), %d identified, %zu models\n",
      counts.calibrations, counts.holding, counts.intervals, counts.holding_by_method[0],
      counts.intervals_by_method[0], counts.holding_by_method[1], counts.intervals_by_method[1],
      counts.identified, counts.models);
  EXPECT_EQ(counts.intervals, 2 * static_cast<int>(calibrations_of_a_kind));
  EXPECT_GE(part, 0.93);
  EXPECT_LE(part, 0.97);
  // What the manual says of this test.
  const auto of = [](int holding, int intervals) {
    return std::to_string(holding) + " of " + std::to_string(intervals);
  };
  const std::string sentence = of(counts.holding, counts.intervals) +
                               " intervals hold the truth (least squares " +
                               of(counts.holding_by_method[0], counts.intervals_by_method[0]) +
                               ", cmaes " + std::to_string(counts.holding_by_method[1]) + ")";
  EXPECT_NE(read_file(source_folder() + "/docs/tuning.md").find(sentence), std::string::npos)
      << sentence;
}

}  // namespace
}  // namespace hookpoint
