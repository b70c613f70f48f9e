// The integrator of docs/adding_an_integrator.md, compiled as it stands there: it keeps the
// contract of a stepper, has the order that it states, and bears the step that is found from its
// steps.
// ctest: alone
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "integrators/velocity_verlet.h"
#include "tests/support/folders.h"
#include "tests/support/integrator_order.h"
#include "tests/support/stepper_contract.h"

namespace hookpoint::integrators {
namespace {

INSTANTIATE_TEST_SUITE_P(Page, StepperContract, ::testing::Values(velocity_verlet),
                         hookpoint::testing::StepperName{});
INSTANTIATE_TEST_SUITE_P(Page, IntegratorOrder, ::testing::Values(velocity_verlet),
                         hookpoint::testing::StepperName{});
INSTANTIATE_TEST_SUITE_P(Page, IntegratorStability, ::testing::Values(velocity_verlet),
                         hookpoint::testing::StepperName{});

// Undamped 2/w. Of a damper alone v1 = v0 (1 - h c + (h c)^2/2): up to 2/c.
TEST(VelocityVerletOfThePage, BearsTheStepsOfItsClosedForms) {
  EXPECT_NEAR(largest_stable_step(velocity_verlet, {400., 0., 1.}), 2. / 20., 1e-7);
  EXPECT_NEAR(largest_stable_step(velocity_verlet, {0., 8., 1.}), 2. / 8., 1e-7);
}

std::string read(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(testing::source_folder() + "/" + file).rdbuf();
  return text.str();
}

// The lines that the page changes, and those beside which it puts its own, are there in that order.
TEST(VelocityVerletOfThePage, ItsDiffFitsTheTable) {
  const std::string page = read("docs/adding_an_integrator.md");
  const std::string table = read("integrators/stepper.cpp");
  const std::size_t begin = page.find("```diff\n");
  ASSERT_NE(begin, std::string::npos);
  std::istringstream diff(page.substr(begin, page.find("\n```", begin) - begin));
  std::size_t at = 0, lines = 0;
  for (std::string line; std::getline(diff, line);) {
    if (line.empty() || line.starts_with('+') || line.starts_with("--") ||
        line.find_first_of("@`") == 0)
      continue;
    const std::size_t found = table.find("\n" + line.substr(1) + "\n", at);
    ASSERT_NE(found, std::string::npos) << line;
    at = found + 1;
    ++lines;
  }
  EXPECT_EQ(lines, 2u);
}

}  // namespace
}  // namespace hookpoint::integrators
