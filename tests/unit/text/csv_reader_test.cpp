// Tables of other programs: separators, decimal commas, comments, and what is no table.
#include "text/csv_reader.h"

#include <gtest/gtest.h>

namespace hookpoint::text {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Table table_of(std::string_view text) {
  Fault fault;
  auto table = read_foreign(text, fault);
  EXPECT_TRUE(table) << text << ": " << fault.text();
  return table.value_or(Table{});
}

Fault fault_of(std::string_view text) {
  Fault fault;
  EXPECT_FALSE(read_foreign(text, fault)) << text;
  return fault;
}

TEST(CsvReader, SemicolonsAndTabsSeparateWhereTheHeaderHasThem) {
  const Rows rows{{"0", "1"}, {"0.5", "2"}};
  for (const char* text : {"t;z\n0;1\n0.5;2\n", "t\tz\n0\t1\n0.5\t2\n", "t,z\n0,1\n0.5,2\n",
                           "\xEF\xBB\xBFt ; z\r\n 0;1 \r\n0.5; 2"}) {
    const Table table = table_of(text);
    EXPECT_EQ(table.header, (std::vector<std::string>{"t", "z"})) << text;
    EXPECT_EQ(table.rows, rows) << text;
  }
  // A semicolon in one title of a table with commas separates nothing.
  EXPECT_EQ(table_of("t,\"a;b\"\n0,1\n").header.back(), "a;b");
  EXPECT_EQ(table_of("t,a;b\n0,1\n").header.back(), "a;b");
  EXPECT_EQ(table_of("z\n1\n2\n").rows, (Rows{{"1"}, {"2"}}));
}

TEST(CsvReader, CommasInNumbersBetweenSemicolonsAreDecimal) {
  EXPECT_EQ(table_of("t;z\n0;-1,5\n0,5;2,25e-3\n").rows, (Rows{{"0", "-1.5"}, {"0.5", "2.25e-3"}}));
  EXPECT_EQ(table_of("t\tz\n0,25\t,5\n").rows, (Rows{{"0.25", ".5"}}));
  // Where another number has a point, a comma means something else; so it does in a text.
  EXPECT_EQ(table_of("t;z\n0.5;1,5\n").rows, (Rows{{"0.5", "1,5"}}));
  EXPECT_EQ(table_of("t;z;n\n0,5;1,234,567;a, b\n").rows, (Rows{{"0.5", "1,234,567", "a, b"}}));
  // Between commas nothing tells them apart.
  const Fault fault = fault_of("t,z\n0,5,1,5\n");
  EXPECT_EQ(fault.kind, Fault::Kind::field_count);
  EXPECT_NE(fault.text().find("separate the fields by semicolons"), std::string::npos);
}

TEST(CsvReader, CommentsAndEmptyLinesStandAnywhereAndRowsKnowTheirLines) {
  const Table table =
      table_of("# made by a logger, \"v2\n\n  # units: SI\nt;z\n0;1\n# pause\n\n1;\"#2\"\n");
  EXPECT_EQ(table.header_line, 4U);
  EXPECT_EQ(table.rows, (Rows{{"0", "1"}, {"1", "#2"}}));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{5, 8}));
}

TEST(CsvReader, SaysWhereATextIsNoTable) {
  EXPECT_EQ(fault_of("").kind, Fault::Kind::empty);
  EXPECT_EQ(fault_of("# nothing\n\n").kind, Fault::Kind::empty);
  const Fault count = fault_of("# a\nt;z\n0;1\n\n1;2;3\n");
  EXPECT_EQ(count.kind, Fault::Kind::field_count);
  EXPECT_EQ(count.line, 5U);
  EXPECT_EQ(count.text(), "expected 2 fields, found 3, separated by semicolons");
  EXPECT_EQ(fault_of("t,z\n0,\"1\n").kind, Fault::Kind::open_quote);
}

}  // namespace
}  // namespace hookpoint::text
