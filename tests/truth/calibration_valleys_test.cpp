// Two constants that a rough error sees as a product: neither is identified, after either method.
// ctest: released
#include <gtest/gtest.h>

#include "tests/support/rough_calibration.h"

namespace hookpoint {
namespace {

// a b = 6: each from 1 to 6.
TEST(CalibrationValleys, OfAProductOnLinearRangesNeitherConstantIsIdentified) {
  testing::RoughCalibrations calibrations;
  for (const std::string& method :
       {std::string(), std::string(testing::RoughCalibrations::cmaes)}) {
    const auto result = calibrations.lifted_drop("a*b", "", method, 1);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->found.constants.size(), 2U) << result->found.status;
    for (const std::size_t i : {0U, 1U}) {
      EXPECT_FALSE(result->found.constants[i].identifiable) << method;
      EXPECT_NEAR(result->low(i), 1., 0.1) << method;
      EXPECT_EQ(result->high(i), 6.) << method;
      EXPECT_NE(
          result->found.constants[i].reason.find(i == 0 ? "together with b" : "together with a"),
          std::string::npos)
          << result->found.constants[i].reason;
    }
  }
}

}  // namespace
}  // namespace hookpoint
