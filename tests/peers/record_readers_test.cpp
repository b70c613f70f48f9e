// Every format, read back by a program that knows nothing of ours: h5py, Octave, @mcap/core,
// Python's csv, and for Wolfram text a parser of its syntax. Values to the last bit, units, types,
// ranges.
// ctest: long
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tests/support/command.h"
#include "tests/support/read_record.h"
#include "tests/support/record_scene.h"
#include "text/number.h"

namespace hookpoint {
namespace {

using output::Channel;
using output::RecordHeader;
using testing::ReadRecord;

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

const Channel* channel_named(const ReadRecord& record, const std::string& path, std::size_t& at) {
  for (at = 0; at < record.channels.size(); ++at)
    if (record.channels[at].path == path) return &record.channels[at];
  return nullptr;
}

/// A JSON number is finite: what is not arrives as null.
double as_stored(const std::string& format, double value) {
  const bool lost = format == "mcap" && !std::isfinite(value);
  return lost ? std::numeric_limits<double>::quiet_NaN() : value;
}

void expect_times(const ReadRecord& record, const std::string& format, int rows) {
  ASSERT_EQ(record.time.size(), static_cast<std::size_t>(rows));
  for (int k = 0; k < rows; ++k) {
    const double expected = format == "mcap" ? k * 1e6 : testing::awkward_time(k);  // [ns], [s]
    ASSERT_TRUE(same(record.time[k], expected)) << "row " << k << ": " << record.time[k];
  }
}

void expect_rows(const ReadRecord& record, const std::string& format, int rows) {
  const RecordHeader header = testing::awkward_header();
  expect_times(record, format, rows);
  ASSERT_EQ(record.channels.size(), header.channels.size());
  ASSERT_EQ(record.data.size(), header.channels.size());
  for (std::size_t i = 0; i < header.channels.size(); ++i) {
    const Channel& expected = header.channels[i];
    SCOPED_TRACE(expected.path);
    std::size_t at = 0;
    const Channel* found = channel_named(record, expected.path, at);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->unit, expected.unit);
    EXPECT_EQ(found->type, expected.type);
    EXPECT_EQ(found->doc, expected.doc);
    EXPECT_TRUE(same(found->minimum, expected.minimum)) << found->minimum;
    EXPECT_TRUE(same(found->maximum, expected.maximum)) << found->maximum;
    ASSERT_EQ(record.data[at].size(), static_cast<std::size_t>(rows));
    for (int k = 0; k < rows; ++k) {
      const double value = as_stored(format, testing::awkward_row(k)[i]);
      ASSERT_TRUE(same(record.data[at][k], value))
          << "row " << k << ": " << record.data[at][k] << " for " << value;
    }
  }
}

class RecordReaders : public ::testing::TestWithParam<const char*> {
 protected:
  void read(const std::string& file, bool cut_off = false, const std::string& more = "") {
    const testing::Reader reader = testing::reader_of(GetParam(), cut_off);
    ASSERT_EQ(reader.missing, "");
    if (!reader.out_of_reach.empty()) GTEST_SKIP() << "out of reach: " << reader.out_of_reach;
    const testing::Reading reading = testing::run_reader(reader.command + "'" + file + "'" + more);
    ASSERT_EQ(reading.status, 0)
        << testing::run_reader(reader.command + "'" + file + "'" + more, true).output;
    record_ = testing::parse_record(reading.output);
  }
  std::string path() const {
    const output::RecordFormat* format = output::find_record_format(GetParam());
    return (place_.folder() / "run").string() + "." + std::string(format->extension);
  }
  std::unique_ptr<output::RecordWriter> writer() const {
    return output::make_record_writer(GetParam(), path(), testing::awkward_header());
  }

  testing::Workplace place_;
  ReadRecord record_;
};

TEST_P(RecordReaders, FindEverythingThatWasWritten) {
  constexpr int rows = 1300;
  const auto record = writer();
  testing::write_awkward_rows(*record, 0, rows);
  record->close();
  EXPECT_FALSE(std::filesystem::exists(path() + ".partial"));
  EXPECT_FALSE(std::filesystem::exists(path() + ".spool"));
  read(path());
  if (IsSkipped() || HasFatalFailure()) return;
  expect_rows(record_, GetParam(), rows);
  EXPECT_EQ(record_.about["name"], "\"awkward\"");
  EXPECT_EQ(std::stod(record_.about["period"].substr(1)), 1e-3);
  EXPECT_EQ(record_.about["engine"], "\"dts\"");
  EXPECT_EQ(record_.about["seed"], "\"42\"");
  EXPECT_EQ(record_.about["note"], "\"\"");
  EXPECT_EQ(record_.about["experiment"],
            R"("World w {\n\tdeltat = 1 ms; // \"quoted\", back\\slash\n}\n")");
  if (record_.about.count("complete")) {
    EXPECT_EQ(record_.about["complete"], "\"true\"");
  }
}

TEST_P(RecordReaders, FindAnEmptyRecord) {
  writer()->close();
  read(path());
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_TRUE(record_.time.empty());
  ASSERT_EQ(record_.channels.size(), testing::awkward_header().channels.size());
  for (const auto& data : record_.data) EXPECT_TRUE(data.empty());
}

/// Rows of the killed run below that are there: all but those of the block that waited, of `csv`
/// less than 50 ms of the run, of others up to 512 rows.
int surviving(const std::string& format, int rows, std::size_t found) {
  if (format == "csv") return std::clamp(static_cast<int>(found), rows - 50, rows);
  const bool in_blocks = format == "hdf5" || format == "mcap";
  return in_blocks ? rows / 512 * 512 : rows;
}

TEST_P(RecordReaders, FindTheRowsOfAKilledRun) {
  constexpr int rows = 1100;
  testing::run_and_die([&] {
    const auto record = writer();
    testing::write_awkward_rows(*record, 0, rows);
    ::kill(::getpid(), SIGKILL);
  });
  EXPECT_FALSE(std::filesystem::exists(path())) << "a record under its own name is complete";
  std::string left = path() + ".partial";
  if (std::filesystem::exists(path() + ".spool")) {
    EXPECT_EQ(output::recover_spool(path() + ".spool").rows, rows);
    left = path();
  }
  read(left, true,
       std::string(GetParam()) == "csv" ? " '" + place_.folder().string() + "/run'" : "");
  if (IsSkipped() || HasFatalFailure()) return;
  expect_rows(record_, GetParam(), surviving(GetParam(), rows, record_.time.size()));
  if (record_.about.count("complete")) {
    EXPECT_EQ(record_.about["complete"], "\"false\"");
  }
}

TEST_P(RecordReaders, FindTheRowsBeforeTheDiskWasFull) {
  const auto record = writer();
  int written = 0;
  std::string message;
  {
    const testing::FileSizeLimit full(400'000);
    try {
      for (; written < 100'000; ++written)
        testing::write_awkward_rows(*record, written, written + 1);
    } catch (const output::FileError& error) {
      message = error.what();
    }
    EXPECT_THROW(testing::write_awkward_rows(*record, 0, 1), output::FileError);
    record->close();
  }
  ASSERT_NE(message, "") << "the disk never got full";
  EXPECT_NE(message.find(path()), std::string::npos) << message;
  const std::string moment = text::shortest(testing::awkward_time(written));
  EXPECT_NE(
      message.find("File too large (the limit of file sizes, `ulimit -f`), at " + moment + " s"),
      std::string::npos)
      << message;
  std::string left = path() + ".partial";
  if (std::filesystem::exists(path() + ".spool")) {
    EXPECT_NE(message.find(".spool"), std::string::npos) << message;
    EXPECT_EQ(output::recover_spool(path() + ".spool").rows, written);
    left = path();
  }
  const int kept = std::stoi(message.substr(message.find("the first ") + 10));
  EXPECT_GT(kept, 500);
  EXPECT_GE(kept, written - 511);
  read(left, true,
       std::string(GetParam()) == "csv" ? " '" + place_.folder().string() + "/run'" : "");
  if (IsSkipped() || HasFatalFailure()) return;
  expect_rows(record_, GetParam(), kept);
}

INSTANTIATE_TEST_SUITE_P(Formats, RecordReaders,
                         ::testing::Values("csv", "mat5", "mat73", "hdf5", "wl", "mcap"),
                         [](const auto& format) { return std::string(format.param); });

}  // namespace
}  // namespace hookpoint
