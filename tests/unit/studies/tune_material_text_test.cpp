// A tuned Material as text: numbers as short as they are, without what a unit's factor adds.
#include <gtest/gtest.h>

#include "studies/search/material_text.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

TEST(MaterialText, HasNoNoiseOfUnits) {
  language::Library library(experiment_schema(), {});
  // 20.2421e3 is 20242.100000000002 in doubles; the damping needs all of its digits.
  library.give("tuned.hook",
               "Material m { normal_stiffness = 20.2421 kN/m; normal_damping = "
               "25.185091173968463; restitution = 0.3; }\n");
  language::Diagnostics diagnostics;
  const auto root = library.evaluate("tuned.hook", {}, diagnostics);
  ASSERT_TRUE(root);
  const language::Object& material = *root->children_of("Material").front();
  ASSERT_EQ(material.number("normal_stiffness"), 20242.100000000002);
  EXPECT_EQ(studies::material_block(material, "tuned"),
            "Material tuned {\n  normal_stiffness = 20242.1 N/m;\n  normal_damping = "
            "25.185091173968463 N.s/m;\n  restitution = 0.3;\n}\n");
}

}  // namespace
}  // namespace hookpoint
