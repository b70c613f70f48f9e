// Tables of other programs: separators, decimal commas, comments, titles, and what is no table.
#include "text/foreign_table.h"

#include <gtest/gtest.h>

namespace hookpoint::text {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using Titles = std::vector<std::string>;

ForeignTable table_of(std::string_view text) {
  Fault fault;
  auto tables = read_foreign(text, fault);
  EXPECT_TRUE(tables) << text << ": " << fault.text();
  return tables ? tables->front() : ForeignTable{};
}

Fault fault_of(std::string_view text) {
  Fault fault;
  EXPECT_FALSE(read_foreign(text, fault)) << text;
  return fault;
}

TEST(ForeignTable, SemicolonsAndTabsSeparateWhereTheHeaderHasThem) {
  const Rows rows{{"0", "1"}, {"0.5", "2"}};
  for (const char* text :
       {"t;z\n0;1\n0.5;2\n", "t\tz\n0\t1\n0.5\t2\n", "t,z\n0,1\n0.5,2\n", "t z\n0 1\n0.5   2\n",
        "sep=;\nt;z\n0;1\n0.5;2\n", "\xEF\xBB\xBFt ; z\r\n 0;1 \r\n0.5; 2"}) {
    const ForeignTable table = table_of(text);
    EXPECT_EQ(table.titles(), (Titles{"t", "z"})) << text;
    EXPECT_EQ(table.rows, rows) << text;
  }
  // A semicolon in one title of a table with commas separates nothing.
  EXPECT_EQ(table_of("t,\"a;b\"\n0,1\n").titles().back(), "a;b");
  EXPECT_EQ(table_of("t,a;b\n0,1\n").titles().back(), "a;b");
  EXPECT_EQ(table_of("z\n1\n2\n").rows, (Rows{{"1"}, {"2"}}));
}

TEST(ForeignTable, CommasInNumbersBetweenSemicolonsAreDecimal) {
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

TEST(ForeignTable, CommentsAndEmptyLinesStandAnywhereAndRowsKnowTheirLines) {
  const ForeignTable table =
      table_of("# made by a logger, \"v2\n\n  # units: SI\nt;z\n0;1\n# pause\n\n1;\"#2\"\n");
  EXPECT_EQ(table.rows, (Rows{{"0", "1"}, {"1", "#2"}}));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{5, 8}));
  for (const char* mark : {"#", "%", "// "}) {
    const ForeignTable titled = table_of(std::string(mark) + "t z\n0.0 1.0\n0.5 2.0\n");
    EXPECT_EQ(titled.titles(), (Titles{"t", "z"})) << mark;
  }
}

TEST(ForeignTable, TitlesGroupsAndUnitsStandAboveTheNumbers) {
  const ForeignTable table = table_of(
      "Report of plate 3\nOperator,Ada\nRate,100 Hz\n\n,Left,,Right,\nTime,X,Y,X,Y\ns,N,kN,N,kN\n"
      "0,1,2,3,4\n1,5,6,7,8\n");
  EXPECT_EQ(table.titles(), (Titles{"Time", "X", "Y", "X", "Y"}));
  EXPECT_EQ(table.columns[2].full_name(), "Left Y");
  EXPECT_EQ(table.columns[3].full_name(), "Right X");
  EXPECT_EQ(table.columns[4].unit, "kN");
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.sample_rate, 100.);
  EXPECT_EQ(table.rows.size(), 2U);
  // A table without titles has numbers.
  const ForeignTable bare = table_of("0 1 2\n1 3 4\n");
  EXPECT_FALSE(bare.has_titles);
  EXPECT_EQ(bare.titles(), (Titles{"1", "2", "3"}));
  // Titles may be numbers, and rows may begin with words.
  EXPECT_EQ(table_of("time,1,2\n0,5,6\n1,7,8\n").titles(), (Titles{"time", "1", "2"}));
  EXPECT_EQ(table_of("case,mass\na,1\nb,2\n").rows, (Rows{{"a", "1"}, {"b", "2"}}));
}

TEST(ForeignTable, SectionsAreTablesOfTheirOwn) {
  Fault fault;
  const auto tables = read_foreign(
      "Devices\n1000\n,,Plate,\nFrame,Sub Frame,Fx,Fz\n,,N,N\n1,0,5,700\n1,1,6,701\n\n"
      "Trajectories\n100\n,,Bob:LANK,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n1,0,1,2,3\n2,0,4,5,6\n",
      fault);
  ASSERT_TRUE(tables) << fault.text();
  ASSERT_EQ(tables->size(), 2U);
  EXPECT_EQ((*tables)[0].sample_rate, 1000.);
  EXPECT_EQ((*tables)[0].columns[3].full_name(), "Plate Fz");
  EXPECT_EQ((*tables)[1].sample_rate, 100.);
  EXPECT_EQ((*tables)[1].columns[4].full_name(), "Bob:LANK Z");
  EXPECT_EQ((*tables)[1].columns[4].unit, "mm");
  EXPECT_EQ((*tables)[1].lines[0], 14U);
}

TEST(ForeignTable, WideCharactersAreRead) {
  std::string text = "\xFF\xFE";
  for (const char16_t c : std::u16string(u"t\t\u00b5\n0\t1\n")) {
    text += static_cast<char>(c & 0xFF);
    text += static_cast<char>(c >> 8);
  }
  EXPECT_EQ(table_of(text).titles(), (Titles{"t", "µ"}));
}

TEST(ForeignTable, UnitsAreReadAsProgramsWriteThem) {
  const std::pair<const char*, const char*> units[]{
      {"Seconds", "s"},     {"ms", "ms"},      {"msec", "ms"},         {"°", "deg"},
      {"deg/sec", "deg/s"}, {"Nm", "N.m"},     {"N*m", "N.m"},         {"N-m", "N.m"},
      {"kNm", "kN.m"},      {"m/s²", "m/s^2"}, {"µs", "us"},           {"degrees", "deg"},
      {"Meters", "m"},      {"-", ""},         {"furlong", "furlong"}, {"ns", "ns"},
      {"nm", "nm"},         {"rad/s", "rad/s"}};
  for (const auto& [written, usual] : units) EXPECT_EQ(usual_unit(written), usual) << written;
  EXPECT_EQ(parts_of("t / ms").unit, "ms");
  EXPECT_EQ(parts_of("Time(s)").unit, "s");
  EXPECT_EQ(parts_of("force[N]").name, "force");
  EXPECT_EQ(parts_of("in / out").name, "in / out");
  EXPECT_EQ(parts_of("path.goal[0]").name, "path.goal[0]");
}

TEST(ForeignTable, SaysWhereATextIsNoTable) {
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
