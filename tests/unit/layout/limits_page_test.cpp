// docs/limits.md speaks of everything that the language says it has not.
// ctest: released
#include <gtest/gtest.h>

#include <sstream>

#include "language/schema/absent.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/message_rules.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

std::vector<language::Absent> everything_absent() {
  experiment_schema();  // its classes bring the rows
  std::vector<language::Absent> all;
  for (const auto& rows : language::absent()) all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

TEST(LimitsPage, NamesSomethingOfEachRow) {
  const std::string page = testing::read_file(testing::source_folder() + "/docs/limits.md");
  const std::vector<language::Absent> all = everything_absent();
  ASSERT_FALSE(all.empty());
  for (const language::Absent& absent : all) {
    std::istringstream names{std::string(absent.names)};
    bool named = absent.names == "..." || absent.names == "input";
    for (std::string name; std::getline(names, name, '|');) {
      const std::string word =
          name.substr(name.rfind('.') == name.size() - 1 ? 0 : name.rfind('.') + 1);
      named = named || page.find(word) != std::string::npos;
    }
    EXPECT_TRUE(named) << absent.names;
    EXPECT_EQ(testing::broken_rule(std::string(absent.instead)), "");
  }
}

/// A row whose class or field exists now would never be said.
TEST(Absent, IsNowhereInTheSchema) {
  const language::Schema& schema = experiment_schema();
  for (const language::Absent& absent : everything_absent()) {
    std::istringstream names{std::string(absent.names)};
    for (std::string name; std::getline(names, name, '|');) {
      if (absent.where.empty()) {
        EXPECT_EQ(schema.find(name), nullptr) << name;
        continue;
      }
      for (const auto& [title, entry] : schema.classes()) {
        if (language::instead_of(entry.name, name) != absent.instead) continue;
        const bool has = entry.find(name) != nullptr;
        // Of several classes only some have it: joints have a friction, shapes have none.
        const bool all_of_them = absent.where.find('|') == std::string::npos;
        EXPECT_FALSE(has && all_of_them) << entry.name << '.' << name;
      }
    }
  }
}

}  // namespace
}  // namespace hookpoint
