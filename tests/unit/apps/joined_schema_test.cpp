// The classes of all folders together, as the command joins them: nothing is missing, nothing is
// said twice.
#include <gtest/gtest.h>

#include "apps/view/widgets/schema.h"
#include "language/document/document.h"
#include "reference/engines.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"

namespace hookpoint {
namespace {

TEST(JoinedSchema, HasNoProblems) {
  language::Schema schema;
  simulation::add_experiment_classes(schema, reference::peer_choices());
  view::add_display_classes(schema);
  studies::add_study_classes(schema);
  EXPECT_EQ(language::schema_problems(schema), std::vector<std::string>{});
  for (const auto& [name, type] : schema.classes()) EXPECT_FALSE(type.doc.empty()) << name;
}

}  // namespace
}  // namespace hookpoint
