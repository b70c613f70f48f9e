// Tables of measured traces, good and bad.
#include "studies/measurements/trace_file.h"

#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace hookpoint::studies {
namespace {

class TraceFile : public ::testing::Test {
 protected:
  using Traces = std::map<std::string, MeasuredTrace>;

  std::optional<Traces> read_all(const std::string& text, std::vector<std::string> columns,
                                 const std::string& time = "", const std::string& of_case = "") {
    language::Diagnostics diagnostics;
    const TraceRequest request{
        place_.file("trace.csv", text), std::move(columns), time, of_case, {}, {}, {}};
    auto traces = read_traces(request, diagnostics);
    error_ = diagnostics.all().empty() ? "" : diagnostics.all().front().message;
    EXPECT_EQ(traces.has_value(), error_.empty());
    return traces;
  }
  std::optional<MeasuredTrace> read(const std::string& text, const std::string& column,
                                    const std::string& time = "") {
    const auto traces = read_all(text, {column}, time);
    return traces ? std::optional(traces->at("")) : std::nullopt;
  }
  bool refused(const std::string& text, const std::string& column, const std::string& why,
               const std::string& time = "") {
    return !read(text, column, time) && error_.find(why) != std::string::npos;
  }

  testing::Workplace place_;
  std::string error_;
};

TEST_F(TraceFile, ColumnsInTheirUnits) {
  const auto trace =
      read("time [ms],z [mm],angle [deg]\r\n0,10,180\r\n5,,90\r\n10,-20,0", "z [mm]");
  ASSERT_TRUE(trace) << error_;
  EXPECT_EQ(trace->time, (std::vector<double>{0., 0.01}));
  EXPECT_EQ(trace->value, (std::vector<double>{0.01, -0.02}));
  const auto by_name = read("x [m],t [s]\n1,0\n2,0.5\n", "x", "t");
  ASSERT_TRUE(by_name) << error_;
  EXPECT_EQ(by_name->time, (std::vector<double>{0., 0.5}));
}

TEST_F(TraceFile, WhatIsWrongIsToldWithItsRow) {
  const std::string good = "time [s],z [m]\n0,1\n1,2\n";
  EXPECT_TRUE(refused(good, "y [m]", "no column `y [m]`")) << error_;
  EXPECT_TRUE(refused("time [s],z [m],z [mm]\n0,1,1\n1,2,2\n", "z", "more than one")) << error_;
  EXPECT_TRUE(refused("time [s],z [furlong]\n0,1\n1,2\n", "z", "is no unit")) << error_;
  EXPECT_TRUE(refused("time [m],z [m]\n0,1\n1,2\n", "z", "is no time")) << error_;
  EXPECT_TRUE(refused("time,z [m]\n0,1\n1,2\n", "z", "is no time")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n1,1\n0,2\n", "z", "row 3")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n-1,1\n0,2\n", "z", "row 2: begins before 0 s")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n1,inf\n", "z", "`inf`")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n1,nan\n", "z", "fewer than two")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\ninf,1\n1,2\n", "z", "row 2")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1x\n1,2\n", "z", "`1x`")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1,2\n", "z", "is no table")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n", "z", "fewer than two")) << error_;
  EXPECT_TRUE(refused("", "z", "it is empty")) << error_;
  // Runs of decades are refused, not begun.
  EXPECT_TRUE(
      refused("time [s],z [m]\n0,1\n1e297,2\n", "z", "row 3: its time, 1e+297 s, is beyond"))
      << error_;
  EXPECT_TRUE(refused("time [ms],z [m]\n0,1\n1e300,2\n", "z", "row 3")) << error_;
}

TEST_F(TraceFile, TablesOfOtherPrograms) {
  const std::vector<double> time{0., 0.01}, value{0.0015, -0.02};
  for (const char* text :
       {"Time (s);z (mm)\n0;1,5\n0,01;-20\n", "Time (s),z (mm)\n0,1.5\n0.01,-20\n",
        "# logger 3\n\nTime [s]\tz [mm]\n0\t1.5\n# pause\n0.01\t-20\n",
        "Time (ms) ; z [mm] ; note\n0;1.5;a, b\n10;-20;\n"}) {
    const auto trace = read(text, "z");
    ASSERT_TRUE(trace) << text << error_;
    ASSERT_EQ(trace->value.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_DOUBLE_EQ(trace->time[i], time[i]) << text;
      EXPECT_DOUBLE_EQ(trace->value[i], value[i]) << text;
    }
  }
  EXPECT_TRUE(read("Time (s);z (mm)\n0;1\n1;2\n", "z (mm)", "Time")) << error_;
  // What stands between parentheses and is no unit is part of the name.
  EXPECT_TRUE(read("t [s],z (left) [mm]\n0,1\n1,2\n", "z (left)")) << error_;
  EXPECT_EQ(text::parts_of("force (left)").name, "force (left)");
  EXPECT_EQ(text::parts_of("v (mm/s)").unit, "mm/s");
  // Rows are those of the file, comments and all.
  EXPECT_TRUE(refused("# a\ntime [s];z [m]\n# b\n1;1\n0;2\n", "z", "row 5")) << error_;
  EXPECT_TRUE(refused("time [s];z [m]\n0;1\n1;2;3\n", "z",
                      "row 3: expected 2 fields, found 3, separated by semicolons"))
      << error_;
  EXPECT_TRUE(refused("time [s];x [m];y [m]\n0;1;1\n1;2;1\n", "z",
                      "no column `z`; its columns are `time [s]`, `x [m]`, `y [m]`, separated by "
                      "semicolons"))
      << error_;
  EXPECT_TRUE(read("time [s] z [m]\n0 1\n1 2\n", "z")) << error_;
}

TEST_F(TraceFile, TheOffsetOfAClockIsTakenFromItsTimes) {
  const auto read_with = [&](double offset, bool may_be_early) {
    language::Diagnostics diagnostics;
    TraceRequest request{
        place_.file("trace.csv", "time [s],z [m]\n12.25,1\n12.5,2\n"), {"z"}, "", "", {}, {}, {}};
    request.offset = offset;
    request.may_be_early = may_be_early;
    auto traces = read_traces(request, diagnostics);
    error_ = diagnostics.all().empty() ? "" : diagnostics.all().front().message;
    return traces ? traces->at("").time : std::vector<double>();
  };
  EXPECT_EQ(read_with(12., false), (std::vector<double>{0.25, 0.5}));
  EXPECT_TRUE(read_with(12.375, false).empty());
  EXPECT_NE(error_.find("row 2: begins before the scene does: the clock's 12.25 s less the offset "
                        "of 12.375 s"),
            std::string::npos)
      << error_;
  EXPECT_EQ(read_with(12.375, true), (std::vector<double>{-0.125, 0.125}));
}

TEST_F(TraceFile, CurvesOfManyCasesAndOfSeveralColumns) {
  const std::string table =
      "toss,t [ms],x [m],y [mm]\nb,0,1,10\na,0,2,20\nb,5,3,30\na,4,4,\na,8,5,50\n";
  const auto traces = read_all(table, {"x", "y"}, "t", "toss");
  ASSERT_TRUE(traces) << error_;
  ASSERT_EQ(traces->size(), 2U);
  // A sample that lacks a part is none.
  EXPECT_EQ(traces->at("a").time, (std::vector<double>{0., 0.008}));
  EXPECT_EQ(traces->at("a").value, (std::vector<double>{2., 0.02, 5., 0.05}));
  EXPECT_EQ(traces->at("b").sample(1)[1], 0.03);
  EXPECT_FALSE(read_all(table, {"x", "t"}, "t", "toss"));
  EXPECT_NE(error_.find("different dimensions"), std::string::npos) << error_;
  EXPECT_FALSE(read_all(table, {"x"}, "t", "throw"));
  EXPECT_NE(error_.find("no column `throw`"), std::string::npos) << error_;
  EXPECT_FALSE(read_all(table + "c,0,1,1\n", {"x"}, "t", "toss"));
  EXPECT_NE(error_.find("fewer than two samples in the column `x [m]` of toss c"),
            std::string::npos)
      << error_;
  // Without its case a row goes back in time.
  EXPECT_FALSE(read_all(table, {"x"}, "t"));
  EXPECT_NE(error_.find("row 5"), std::string::npos) << error_;
}

}  // namespace
}  // namespace hookpoint::studies
