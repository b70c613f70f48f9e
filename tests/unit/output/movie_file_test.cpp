// Movies as files: every bit comes back, by the program and by h5py; a run that is cut off leaves
// what it had; an instant allocates nothing.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "output/movies/movie.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/command.h"
#include "tests/support/read_record.h"
#include "tests/support/record_scene.h"
#include "tests/support/shifted_clock.h"

namespace hookpoint {
namespace {

constexpr std::size_t size = 21;  // no whole number of groups of eight

/// Numbers that stay for long, that never stay, and all that is no ordinary number.
std::vector<double> state_at(int k) {
  std::vector<double> state(size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto n = static_cast<double>(i);
    state[i] = i < 9 ? n / 3. : std::sin(n + 0.01 * k);
  }
  state[3] = k > 700 ? -0. : 0.;
  state[17] = k % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e22 * state[17];
  state[18] = -std::numeric_limits<double>::infinity();
  state[19] = std::numeric_limits<double>::denorm_min() * k;
  return state;
}

output::MovieHeader header() {
  output::MovieHeader header;
  header.name = "film";
  header.period = 1e-3;
  header.experiment = "World w { // \"quoted\"\n}\n";
  header.annotations = {{"engine", "dts"}, {"seed", "42"}};
  header.files = {{"a.csv", "/there/a.csv", std::string("time,y\n0,\0\xff\n", 12)},
                  {"empty", "/there/empty", ""}};
  header.size = size;
  header.layout = "21\tengine\tx[21]\n";
  return header;
}

void write_instants(output::RecordWriter& writer, int begin, int end) {
  for (int k = begin; k < end; ++k) writer.row(1e-3 * k, state_at(k));
}

void expect_instants(const output::MovieReader& movie, int count) {
  ASSERT_EQ(movie.times().size(), static_cast<std::size_t>(count));
  std::vector<double> state(size);
  for (int k = 0; k < count; ++k) {
    movie.read(static_cast<std::size_t>(k), state);
    EXPECT_EQ(movie.times()[static_cast<std::size_t>(k)], 1e-3 * k);
    const std::vector<double> expected = state_at(k);
    for (std::size_t i = 0; i < size; ++i)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(state[i]), std::bit_cast<std::uint64_t>(expected[i]))
          << k << ' ' << i;
  }
}

/// A short movie, and in it what the lines of Python do to the HDF5 file `f`.
std::filesystem::path damaged_movie(const testing::Workplace& place, const std::string& lines) {
  const std::filesystem::path path = place.folder() / "film.h5";
  const auto writer = output::make_movie_writer(path, header());
  write_instants(*writer, 0, 3);
  writer->close();
  const std::string script = place.file(
      "damage.py", "import h5py\nf = h5py.File('" + path.string() + "', 'r+')\n" + lines);
  EXPECT_EQ(testing::run_reader("/usr/bin/python3 '" + script + "'").status, 0);
  return path;
}

void expect_damaged(const std::filesystem::path& path) {
  try {
    const output::MovieReader movie(path);
    FAIL() << "read " << movie.times().size() << " instants";
  } catch (const output::MovieError& error) {
    EXPECT_NE(std::string(error.what()).find("is damaged"), std::string::npos) << error.what();
  }
}

TEST(MovieFile, ThatClaimsMoreInstantsThanItCanHoldIsRefused) {
  const testing::Workplace place;
  const auto path = damaged_movie(place,
                                  "f['time'].resize((10**10,))\n"
                                  "f['state'].resize((21, 10**10))\n");
  EXPECT_LT(std::filesystem::file_size(path), 200'000U);
  expect_damaged(path);
}

TEST(MovieFile, WithListsInThePlaceOfValuesIsRefused) {
  const testing::Workplace place;
  expect_damaged(damaged_movie(place, "f.attrs['period'] = [1.] * 1000\n"));
  expect_damaged(damaged_movie(place, "f.attrs['name'] = [b'film'] * 1000\n"));
  expect_damaged(damaged_movie(place, "del f['layout']\nf['layout'] = [b'text'] * 1000\n"));
}

TEST(MovieFile, ComesBackToTheLastBit) {
  const testing::Workplace place;
  const std::filesystem::path path = place.folder() / "new/film.h5";
  const auto writer = output::make_movie_writer(path, header());
  write_instants(*writer, 0, 1300);
  EXPECT_FALSE(std::filesystem::exists(path));
  writer->close();
  const output::MovieReader movie(path);
  expect_instants(movie, 1300);
  EXPECT_TRUE(movie.complete());
  const output::MovieHeader& read = movie.header();
  const output::MovieHeader written = header();
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.period, written.period);
  EXPECT_EQ(read.experiment, written.experiment);
  EXPECT_EQ(read.annotations, written.annotations);
  EXPECT_EQ(read.layout, written.layout);
  EXPECT_EQ(read.size, size);
  ASSERT_EQ(read.files.size(), 2U);
  EXPECT_EQ(read.files[0].name, "a.csv");
  EXPECT_EQ(read.files[0].path, "/there/a.csv");
  EXPECT_EQ(read.files[0].content, written.files[0].content);
  EXPECT_EQ(read.files[1].content, "");
}

TEST(MovieFile, SameInstantsSameBytes) {
  const testing::Workplace place;
  for (const char* name : {"a.h5", "b.h5"}) {
    const auto writer = output::make_movie_writer(place.folder() / name, header());
    write_instants(*writer, 0, 600);
    writer->close();
    // No clock shows: HDF5 and MATLAB's header count seconds.
    testing::clock_shift += 100'000;
  }
  EXPECT_EQ(place.read("a.h5"), place.read("b.h5"));
}

TEST(MovieFile, IsReadByH5py) {
  ASSERT_EQ(testing::missing_h5py(), "");
  const testing::Workplace place;
  const auto writer = output::make_movie_writer(place.folder() / "film.h5", header());
  write_instants(*writer, 0, 530);
  writer->close();
  const testing::Reading reading = testing::run_reader(
      "/usr/bin/python3 -c 'import h5py; f = h5py.File(\"" + (place.folder() / "film.h5").string() +
      "\"); s = f[\"state\"]; print(s.shape[0], s.shape[1], s.compression, s.shuffle, "
      "f.attrs[\"complete\"]); "
      "print(\"\\n\".join(x.hex() for x in s[10, :].tolist()))'");
  ASSERT_EQ(reading.status, 0);
  std::istringstream lines(reading.output);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "21 530 gzip True 1.0");
  for (int k = 0; k < 530; ++k) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), state_at(k)[10]) << k;
  }
}

TEST(MovieFile, AKilledRunLeavesWholeBlocks) {
  const testing::Workplace place;
  const std::filesystem::path path = place.folder() / "film.h5";
  testing::run_and_die([&] {
    const auto writer = output::make_movie_writer(path, header());
    write_instants(*writer, 0, 1030);
  });
  EXPECT_FALSE(std::filesystem::exists(path));
  const output::MovieReader movie(path.string() + ".partial");
  expect_instants(movie, 1024);
  EXPECT_FALSE(movie.complete());
}

TEST(MovieFile, AFullDiskLeavesWhatWasThere) {
  const testing::Workplace place;
  const std::filesystem::path path = place.folder() / "film.h5";
  const auto writer = output::make_movie_writer(path, header());
  write_instants(*writer, 0, 1024);
  const testing::FileSizeLimit full(std::filesystem::file_size(path.string() + ".partial") + 1000);
  try {
    write_instants(*writer, 1024, 2000);
    FAIL() << "nothing was refused";
  } catch (const output::FileError& error) {
    EXPECT_NE(std::string(error.what()).find("the first 1024 rows are kept in"), std::string::npos)
        << error.what();
  }
  expect_instants(output::MovieReader(path.string() + ".partial"), 1024);
}

TEST(MovieFile, InstantsAllocateNothing) {
  const testing::Workplace place;
  std::vector<std::vector<double>> states;
  for (int k = 0; k < 2000; ++k) states.push_back(state_at(k));
  const auto writer = output::make_movie_writer(place.folder() / "film.h5", header());
  const long before = testing::allocation_count();
  for (int k = 0; k < 2000; ++k) writer->row(1e-3 * k, states[static_cast<std::size_t>(k)]);
  EXPECT_EQ(testing::allocation_count() - before, 0);
}

}  // namespace
}  // namespace hookpoint
