#include "output/files/csv.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/record_scene.h"
#include "tests/support/text.h"

namespace hookpoint::output {
namespace {

namespace fs = std::filesystem;

class Csv : public ::testing::Test {
 protected:
  Csv() : folder_(fs::temp_directory_path() / ("hookpoint_csv_" + std::to_string(::getpid()))) {}
  ~Csv() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Csv, QuotesOnlyWhatNeedsQuotes) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"slip\""), "\"say \"\"slip\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(column_title("creep_speed", "m/s"), "creep_speed [m/s]");
  EXPECT_EQ(column_title("contacts", ""), "contacts");
}

TEST_F(Csv, TableIsHeaderAndRows) {
  const CsvTable table{{"slope [deg]", "status"}, {{"5", "ok"}, {"", "stopped, at 1 s"}}};
  write_csv(folder_ / "deep" / "results.csv", table);
  EXPECT_EQ(testing::read_file(folder_ / "deep" / "results.csv"),
            "slope [deg],status\n5,ok\n,\"stopped, at 1 s\"\n");
}

TEST_F(Csv, TraceAppearsOnlyWhenClosed) {
  const fs::path path = folder_ / "trace.csv";
  TraceWriter trace(path, {{"w.block.base.location.x", "m"}, {"w.block.contacts", ""}});
  trace.row(0., std::vector{0.1, 4.});
  trace.row(1e-3, std::vector{-2e-17, 4.});
  EXPECT_FALSE(fs::exists(path));
  trace.close();
  EXPECT_EQ(testing::read_file(path),
            "time [s],w.block.base.location.x [m],w.block.contacts\n0,0.1,4\n0.001,-2e-17,4\n");
  EXPECT_FALSE(fs::exists(folder_ / "trace.csv.partial"));
}

/// The table that a killed run would leave.
CsvTable left_by(const TraceWriter& trace) {
  return parse_csv(testing::read_file(trace.partial())).value();
}

TEST_F(Csv, TraceThatIsCutOffLacksLittle) {
  TraceWriter dense(folder_ / "dense.csv", {{"x", "m"}});
  for (int k = 0; k < 300; ++k) {
    dense.row(k * 1e-3, std::vector{0.1 * k});
    EXPECT_EQ(testing::read_file(dense.partial()).back(), '\n');
    EXPECT_GT(std::stod(left_by(dense).rows.back()[0]), (k - 50.1) * 1e-3);
  }
  TraceWriter wide(folder_ / "wide.csv", std::vector<TraceColumn>(100, {"x", "m"}));
  for (int k = 0; k < 30; ++k) {
    wide.row(k * 1e-3, std::vector<double>(100, 1. / 3.));
    EXPECT_GE(left_by(wide).rows.size() + 2, k + 1u) << "two rows of 1.9 kB may wait";
    EXPECT_EQ(static_cast<std::int64_t>(left_by(wide).rows.size()), wide.written());
  }
  TraceWriter sparse(folder_ / "sparse.csv", {{"x", "m"}});
  for (int k = 0; k < 10; ++k) {
    sparse.row(0.06 * k, std::vector{0.1 * k});
    EXPECT_EQ(left_by(sparse).rows.size(), k + 1u);
  }
}

TEST_F(Csv, AbandonedTraceHasEveryRow) {
  const fs::path path = folder_ / "trace.csv";
  {
    TraceWriter trace(path, {{"x", "m"}});
    for (int k = 0; k < 10; ++k) trace.row(k * 1e-3, std::vector{0.1 * k});
  }
  EXPECT_EQ(parse_csv(testing::read_file(partial_name(path)))->rows.size(), 10u);
}

TEST_F(Csv, FullDiskTakesTheRowsThatFit) {
  TraceWriter trace(folder_ / "trace.csv", {{"x", ""}});
  constexpr rlim_t room = 1000;
  const testing::FileSizeLimit full(room);
  const auto fill = [&] {
    for (int k = 0; k < 1000; ++k) trace.row(k * 1e-4, std::vector{1.});
  };
  EXPECT_THROW(fill(), FileError);
  const std::string text = testing::read_file(trace.partial());
  EXPECT_LE(text.size(), room);
  EXPECT_GT(text.size(), room - std::string("0.0999,1\n").size());
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(static_cast<std::int64_t>(parse_csv(text)->rows.size()), trace.written());
}

TEST_F(Csv, AbandonedFileLeavesTheOldOneAlone) {
  const fs::path path = folder_ / "results.csv";
  write_file(path, "old\n");
  {
    PartialFile file(path);
    file.write("half");
  }
  EXPECT_EQ(testing::read_file(path), "old\n");
}

TEST_F(Csv, ATableReadsBackAsItWas) {
  const CsvTable table{{"name [m]", "status"}, {{"1e-09", "a, \"b\"\nc"}, {"", ""}}};
  const auto read = parse_csv(table.text());
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->header, table.header);
  EXPECT_EQ(read->rows, table.rows);
}

TEST_F(Csv, LinesMayEndAsOnWindows) {
  const auto read = parse_csv("a,b [m]\r\n1,2\r\n\"x\r\ny\",\"3\"\r\n");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->header, (std::vector<std::string>{"a", "b [m]"}));
  const std::vector<std::vector<std::string>> wanted{{"1", "2"}, {"x\r\ny", "3"}};
  EXPECT_EQ(read->rows, wanted);
}

TEST_F(Csv, WhatIsNoTableIsNotRead) {
  EXPECT_FALSE(parse_csv("").has_value());
  EXPECT_FALSE(parse_csv("a,b\n1\n").has_value()) << "a row is short";
  EXPECT_FALSE(parse_csv("a,b\n1,\"2\n").has_value()) << "a quote is open";
  EXPECT_EQ(parse_csv("a,b\n1,2\n3,")->rows.size(), 1u) << "cut off";
}

TEST_F(Csv, UnwritablePlaceIsSaid) {
  write_file(folder_ / "file", "not a folder");
  try {
    write_file(folder_ / "file" / "results.csv", "");
    FAIL() << "expected a FileError";
  } catch (const PlaceError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot create " +
                                             (folder_ / "file" / "results.csv").string() +
                                             ": its folder cannot be made: Not a directory");
  }
}

}  // namespace
}  // namespace hookpoint::output
