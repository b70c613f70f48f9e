// What the parts of data out promise each by itself; whole files are read back by other programs in
// tests/peers/record_readers_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "output/files/bytes.h"
#include "output/records/matlab_names.h"
#include "output/records/mcap_records.h"
#include "output/records/spool.h"
#include "output/records/wolfram_text.h"
#include "tests/support/command.h"
#include "tests/support/record_scene.h"
#include "tests/support/shifted_clock.h"

namespace hookpoint::output {
namespace {

std::string wolfram(double value) {
  std::string text;
  append_wolfram_real(text, value);
  return text;
}

TEST(WolframText, MachineReals) {
  EXPECT_EQ(wolfram(1.5e-9), "1.5*^-9");
  EXPECT_EQ(wolfram(-2.5), "-2.5");
  EXPECT_EQ(wolfram(0.), "0.");
  EXPECT_EQ(wolfram(3.), "3.");
  EXPECT_EQ(wolfram(1e22), "1.*^22");
  EXPECT_EQ(wolfram(0.1 + 0.2), "3.0000000000000004`*^-1");
  EXPECT_EQ(wolfram(-1.7976931348623157e308), "-1.7976931348623157`*^308");
  EXPECT_EQ(wolfram(std::numeric_limits<double>::infinity()), "Infinity");
  EXPECT_EQ(wolfram(-std::numeric_limits<double>::infinity()), "-Infinity");
  EXPECT_EQ(wolfram(std::numeric_limits<double>::quiet_NaN()), "Indeterminate");
}

TEST(WolframText, StringsAreAscii) {
  EXPECT_EQ(wolfram_string("a \"b\" \\ c\n"), R"("a \"b\" \\ c\n")");
  EXPECT_EQ(wolfram_string("\xc2\xb5m"), R"("\:00b5m")");
  EXPECT_EQ(wolfram_string("\xf0\x9f\xa6\x97"), R"("\|01f997")");
}

TEST(MatlabNames, AreValidAndDifferent) {
  const std::vector<std::string> paths{"bot.leg[0].angle",
                                       "time",
                                       "end",
                                       "2.x",
                                       "bot.leg[0]_angle",
                                       "...",
                                       std::string(80, 'a') + ".first"};
  const auto names = matlab_names(paths, std::vector<std::string>{"time"});
  EXPECT_EQ(names[0], "bot_leg_0_angle");
  EXPECT_EQ(names[1], "time_2");
  EXPECT_EQ(names[2], "x_end");
  EXPECT_EQ(names[3], "x_2_x");
  EXPECT_EQ(names[4], "bot_leg_0_angle_2");
  EXPECT_EQ(names[5], "x_");
  EXPECT_EQ(names[6], std::string(57, 'a') + "_first");
}

TEST(Bytes, AreLittleEndianAndComeBack) {
  std::string bytes;
  append_integer(bytes, std::uint32_t{0x01020304});
  EXPECT_EQ(bytes, "\x04\x03\x02\x01");
  append_double(bytes, -0.1);
  append_string(bytes, "text");
  ByteReader reader(bytes);
  EXPECT_EQ(reader.integer<std::uint32_t>(), 0x01020304U);
  EXPECT_EQ(reader.real(), -0.1);
  EXPECT_EQ(reader.string(), "text");
  EXPECT_TRUE(reader.good());
  EXPECT_EQ(reader.integer<std::uint16_t>(), 0);
  EXPECT_FALSE(reader.good());
}

TEST(Mcap, ChecksumIsTheOneOfTheStandard) {
  EXPECT_EQ(mcap::crc32("123456789"), 0xcbf43926U);
  EXPECT_EQ(mcap::crc32("6789", mcap::crc32("12345")), 0xcbf43926U);
}

TEST(Mcap, RecordIsOpcodeLengthContent) {
  std::string bytes;
  mcap::append_header(bytes, "me");
  EXPECT_EQ(bytes, std::string("\x01\x0a\0\0\0\0\0\0\0\0\0\0\0\x02\0\0\0me", 19));
}

TEST(PartialFile, FullDiskLeavesWhatWasThere) {
  const hookpoint::testing::Workplace place;
  PartialFile file(place.folder() / "lines");
  file.write("first\n");
  {
    const hookpoint::testing::FileSizeLimit full(10);
    EXPECT_THROW(file.write("second\n"), FileError);
    EXPECT_EQ(place.read("lines.partial"), "first\n");
    file.write("2nd\n");
  }
  file.write_at(6, "end");
  file.complete();
  EXPECT_EQ(place.read("lines"), "first\nend");
}

TEST(Spool, LastRowThatIsNotWholeIsLeftOut) {
  const hookpoint::testing::Workplace place;
  const RecordHeader header = hookpoint::testing::awkward_header();
  std::filesystem::path path;
  {
    SpoolWriter spool(place.folder() / "run.mat", "mat5", header);
    for (int k = 0; k < 3; ++k) spool.row(k, hookpoint::testing::awkward_row(k));
    path = spool.path();
  }
  EXPECT_EQ(path.filename(), "run.mat.spool");
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  SpoolReader reader(path);
  EXPECT_EQ(reader.rows(), 2);
  EXPECT_EQ(reader.format(), "mat5");
  EXPECT_EQ(reader.header().experiment, header.experiment);
  EXPECT_EQ(reader.header().annotations, header.annotations);
  std::vector<std::vector<double>> columns(2);
  reader.read(0, columns);
  EXPECT_EQ(columns[0], (std::vector<double>{0., 1.}));
  EXPECT_EQ(columns[1][1], hookpoint::testing::awkward_row(1)[0]);
}

TEST(Spool, OtherFilesAreRefused) {
  const hookpoint::testing::Workplace place;
  const std::string text = place.file("text", "time [s],x\n0,1\n2,3\n4,5\n");
  EXPECT_THROW(recover_spool(text), FileError);
  EXPECT_THROW(recover_spool(place.folder() / "missing"), FileError);
  EXPECT_THROW(recover_spool(place.file("cut", "hookpoint spool 1\n\xff\xff\xff\x7f")), FileError);
}

TEST(Recorder, FormatsHaveNames) {
  EXPECT_EQ(record_formats().size(), 6u);
  EXPECT_EQ(find_record_format("mat73")->extension, "mat");
  EXPECT_EQ(find_record_format("xls"), nullptr);
  EXPECT_THROW(make_record_writer("xls", "run.xls", {}), std::invalid_argument);
}

TEST(Recorder, RowsNeedAPoseForEachBody) {
  const hookpoint::testing::Workplace place;
  RecordHeader header;
  header.channels.resize(1);
  header.channels[0].path = "a";
  header.scene.bodies = {{"w.ball", {}}};
  const auto record = make_record_writer("mcap", place.folder() / "run.mcap", header);
  EXPECT_THROW(record->row(0., std::vector<double>(1)), std::logic_error);
  record->row(0., std::vector<double>(1 + numbers_of_pose));
  record->close();
}

TEST(Recorder, SameRowsGiveTheSameBytes) {
  const hookpoint::testing::Workplace place;
  const time_t before = std::time(nullptr);
  for (const char* time : {"now", "later"}) {
    for (const RecordFormat& format : record_formats()) {
      const auto writer = make_record_writer(format.name, place.folder() / time / format.name,
                                             hookpoint::testing::awkward_header());
      hookpoint::testing::write_awkward_rows(*writer, 0, 700);
      writer->close();
    }
    // No clock shows: HDF5 and MATLAB's header count seconds.
    hookpoint::testing::clock_shift += 100'000;
  }
  EXPECT_GT(std::time(nullptr), before + 100'000) << "the clock is the shifted one";
  for (const RecordFormat& format : record_formats())
    EXPECT_EQ(place.read("now/" + std::string(format.name)),
              place.read("later/" + std::string(format.name)))
        << format.name;
}

TEST(Recorder, BinaryFormatsCompress) {
  const hookpoint::testing::Workplace place;
  RecordHeader header;
  for (int i = 0; i < 24; ++i) header.channels.emplace_back().path = "value" + std::to_string(i);
  for (const char* format : {"mat5", "mat73", "hdf5"}) {
    const auto writer = make_record_writer(format, place.folder() / format, header);
    std::vector<double> values(header.channels.size());
    for (int k = 0; k < 8192; ++k) {
      for (double& value : values) value = std::floor(k / 10.);
      writer->row(k, values);
    }
    writer->close();
    EXPECT_LT(std::filesystem::file_size(place.folder() / format), 25u * 8192u * 8u / 4u) << format;
  }
}

TEST(Recorder, UnwritablePlaceIsSaid) {
  const hookpoint::testing::Workplace place;
  const std::string file = place.file("file", "not a folder");
  for (const RecordFormat& format : record_formats()) {
    try {
      make_record_writer(format.name, file + "/run", hookpoint::testing::awkward_header());
      ADD_FAILURE() << "expected a FileError from " << format.name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("file/run"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace hookpoint::output
