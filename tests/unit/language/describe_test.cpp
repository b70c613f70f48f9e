// describe and the manual's pages say everything that the schema says.
#include <gtest/gtest.h>

#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

TEST(LanguageDescribe, AClassHasAllItsFieldsWithTheirFacts) {
  const Schema schema = make_schema();
  EXPECT_EQ(describe(*schema.find("Terrain.Slope"), schema),
            "Terrain.Slope\n"
            "  An inclined plane through the origin.\n"
            "  stands in: World\n"
            "\n"
            "  angle  number [rad]; default 0 deg\n"
            "      Inclination.\n"
            "\n"
            "  material  name of a Material\n"
            "      What it is made of.\n");
  const std::string link = describe(*schema.find("Link"));
  EXPECT_NE(link.find("  mass  number [kg]; greater than 0 kg; required\n"), std::string::npos)
      << link;
  EXPECT_NE(link.find("  angle  number [rad]; default 0 rad; output\n"), std::string::npos);
  EXPECT_NE(link.find("  joint  one of revolute, prismatic; default revolute\n"),
            std::string::npos);
  EXPECT_NE(describe(*schema.find("World")).find("time  number [s]; output only"),
            std::string::npos);
  EXPECT_NE(describe(*schema.find("Window")).find("width  whole number; from 1 to 10000\n"),
            std::string::npos);
  EXPECT_NE(describe(*schema.find("Valuator.Slider")).find("a wire without TO ends at: value\n"),
            std::string::npos);
}

TEST(LanguageDescribe, TheIndexAndTheManualHoldEveryClassAndField) {
  const Schema schema = make_schema();
  const std::string index = describe_all(schema), manual = describe_markdown(schema);
  for (const auto& [name, entry] : schema.classes()) {
    EXPECT_NE(index.find(name + " "), std::string::npos);
    EXPECT_NE(manual.find("## " + name + "\n"), std::string::npos);
    for (const FieldSchema& field : entry.fields)
      EXPECT_NE(manual.find("| `" + field.name + "` |"), std::string::npos);
  }
}

}  // namespace
}  // namespace hookpoint::language::testing
