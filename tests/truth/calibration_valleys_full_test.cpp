// Constants that a rough error sees as a combination: six seeds of noise, another integrator, a sum
// of squares, a third constant, many cases.
// ctest: full, released, long
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/rough_calibration.h"

namespace hookpoint {
namespace {

using testing::RoughCalibrations;

constexpr const char* vary_k = "Vary k { from = 1 kN/m; to = 200 kN/m; scale = log; } ";

struct Lift {
  const char *seen, *world, *block;
  double low, high;  ///< where a and b can be
  unsigned seeds;
};

// a b = 6: each from 1 to 6. a^2 + b^2 = 13: each from 0 to 3.606.
TEST(CalibrationValleysFull, OfACombinationOnLinearRangesNeitherConstantIsIdentified) {
  RoughCalibrations calibrations;
  for (const Lift& lift :
       {Lift{"a*b", "", "", 1., 6., 6}, Lift{"a*b", "integrator = rk4;", "", 1., 6., 1},
        Lift{"(a^2 + b^2)", "", "", 0., std::sqrt(13.), 2}, Lift{"a*b", "", vary_k, 1., 6., 1}}) {
    for (unsigned seed = 1; seed <= lift.seeds; ++seed) {
      for (const std::string& method : {std::string(), std::string(RoughCalibrations::cmaes)}) {
        const auto result =
            calibrations.lifted_drop(lift.seen, lift.world, method + lift.block, seed);
        ASSERT_TRUE(result);
        const std::string name =
            lift.seen + std::string(lift.world) + lift.block + method + std::to_string(seed);
        ASSERT_GE(result->found.constants.size(), 2U) << result->found.status;
        for (const std::size_t i : {0U, 1U}) {
          EXPECT_FALSE(result->found.constants[i].identifiable) << name;
          EXPECT_NEAR(result->low(i), lift.low, 0.1) << name;
          EXPECT_NEAR(result->high(i), lift.high, 0.1) << name;
        }
        if (result->found.constants.size() > 2) {
          EXPECT_TRUE(result->found.constants[2].identifiable)
              << name << result->found.constants[2].reason;
        }
      }
    }
  }
}

TEST(CalibrationValleysFull, OfManyDropsByCmaesIntervalsHaveAWidthAndAProductIsNotIdentified) {
  RoughCalibrations calibrations;
  const auto result = calibrations.eight_drops(7);
  ASSERT_TRUE(result);
  const auto& constants = result->found.constants;
  ASSERT_EQ(constants.size(), 3U) << result->found.status;
  EXPECT_TRUE(constants[0].identifiable) << constants[0].reason;
  EXPECT_LT(*constants[0].low, constants[0].share);
  EXPECT_GT(*constants[0].high, constants[0].share);
  // With 8 curves of 100 samples and noise of 0.2 mm k is known to a percent, not to a digit more
  // than six.
  EXPECT_GT(result->high(0) - result->low(0), 1e-3);  // [kN/m]
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_FALSE(constants[i].identifiable) << i;
    EXPECT_LT(result->low(i), 1.2) << i;  // 6/6
    EXPECT_GT(result->high(i), 5.7) << i;
  }
}

}  // namespace
}  // namespace hookpoint
