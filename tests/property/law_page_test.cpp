// docs/adding_a_law.md: the law that it adds is compiled from the page, and held to what every law
// must hold and to the page's own claims; its edit of the list of laws fits the list.
// ctest: alone
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "contact/force_law.h"
#include "contact/laws/limited_damper.h"
#include "tests/support/contact_law_suite.h"
#include "tests/support/folders.h"
#include "tests/support/point_mass.h"

namespace hookpoint::contact {
namespace law_suite {

static_assert(fulfils_the_interface<LimitedDamper>());
INSTANTIATE_TYPED_TEST_SUITE_P(OfThePage, ContactLaw, ::testing::Types<LimitedDamper>);

}  // namespace law_suite
namespace {

using namespace test_support;

TEST(LawOfThePage, CreepsDownASlopeAsThePageSays) {
  MaterialConstants<double> material = well_damped();
  material.kinetic_friction = 0.5;
  material.regularisation_speed = 0.01;
  for (const double tangent : {0.1, 0.4}) {
    PointMass block{.mass = 2., .slope = std::atan(tangent), .azimuth = 0.7, .material = material};
    block.position.z = -LimitedDamper::static_depth(block.normal_load(), material);
    block.run<LimitedDamper>(1e-4, 1.);
    const double creep = 0.01 * tangent / std::sqrt(0.25 - tangent * tangent);
    EXPECT_NEAR(block.downhill_speed(), creep, 1e-9);
    EXPECT_NEAR(*LimitedDamper::creep_speed(tangent, material), creep, 1e-15);
  }
  EXPECT_FALSE(LimitedDamper::creep_speed(0.5, material));
}

std::string text_of(const std::string& path) {
  std::ifstream file(testing::source_folder() + "/" + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Lines of the diff that the file has now, in one piece; that the page's law is not yet of the
// table.
TEST(LawOfThePage, IsAddedByAnEditThatFitsTheListOfLaws) {
  const std::string path = "contact/force_law.h", opening = "```diff file=" + path + "\n";
  const std::string page = text_of("docs/adding_a_law.md"), list = text_of(path);
  const std::size_t start = page.find(opening);
  ASSERT_NE(start, std::string::npos);
  const std::size_t end = page.find("\n```", start + opening.size());
  std::istringstream diff(page.substr(start + opening.size(), end - start - opening.size()));
  std::string before, added;
  for (std::string line; std::getline(diff, line);) {
    const std::string text = line.empty() ? "" : line.substr(1);
    (line.starts_with("+") ? added : before) += text + "\n";
  }
  EXPECT_NE(list.find(before), std::string::npos) << before;
  EXPECT_NE(added.find(" LimitedDamper,"), std::string::npos);
  EXPECT_NE(added.find("contact/laws/limited_damper.h"), std::string::npos);
  EXPECT_EQ(find_law(LimitedDamper::name), nullptr);
}

}  // namespace
}  // namespace hookpoint::contact
