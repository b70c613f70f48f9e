// Tables of measured traces, good and bad.
#include "studies/calibrate/trace_file.h"

#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace hookpoint::studies {
namespace {

class TraceFile : public ::testing::Test {
 protected:
  std::optional<MeasuredTrace> read(const std::string& text, const std::string& column,
                                    const std::string& time = "") {
    language::Diagnostics diagnostics;
    TraceRequest request{place_.file("trace.csv", text), column, time, {}, {}, {}};
    auto trace = read_trace(request, diagnostics);
    error_ = diagnostics.all().empty() ? "" : diagnostics.all().front().message;
    EXPECT_EQ(trace.has_value(), error_.empty());
    return trace;
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
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n0,2\n", "z", "row 3")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n-1,1\n0,2\n", "z", "row 2: begins before 0 s")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n1,nan\n", "z", "`nan`")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\ninf,1\n1,2\n", "z", "row 2")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1x\n1,2\n", "z", "`1x`")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1,2\n", "z", "is no table")) << error_;
  EXPECT_TRUE(refused("time [s],z [m]\n0,1\n", "z", "fewer than two")) << error_;
  EXPECT_TRUE(refused("", "z", "no column `z`")) << error_;
}

}  // namespace
}  // namespace hookpoint::studies
