#include <gtest/gtest.h>
#include <unistd.h>

#include "simulation/scene/terrain/png_grid.h"
#include "tests/support/png_file.h"

namespace hookpoint::simulation {
namespace {

using test_support::png_bytes;
using test_support::PngImage;

PngGridResult read(const std::string& bytes, double low = 0., double high = 1.) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("hookpoint_" + std::to_string(getpid()) + ".png");
  test_support::write_file(path, bytes);
  PngGridResult result = read_png_grid(path, low, high);
  std::filesystem::remove(path);
  return result;
}

TEST(PngGrid, EightBitsAreLinearFromLowToHighAndTheTopIsNorth) {
  const auto result =
      read(png_bytes({3, 2, 8, 0, 0, {0, 51, 102, '\x99', '\xcc', '\xff'}}), -1., 4.);
  ASSERT_TRUE(result.grid.has_value()) << result.message;
  EXPECT_EQ(result.grid->columns, 3);
  EXPECT_EQ(result.grid->rows, 2);
  const std::vector<double> expected{2., 3., 4., -1., 0., 1.};  // -1 + 5 n/5
  ASSERT_EQ(result.grid->heights.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(result.grid->heights[i], expected[i], 1e-15);
  }
}

TEST(PngGrid, SixteenBitsHaveTheirHighByteFirst) {
  const std::string bytes{'\x00', '\x01', '\x01', '\x00', '\xff', '\xff', '\x00', '\x00'};
  const auto result = read(png_bytes({2, 2, 16, 0, 0, bytes}), 0., 65535.);
  ASSERT_TRUE(result.grid.has_value()) << result.message;
  EXPECT_EQ(result.grid->heights, (std::vector<double>{65535., 0., 1., 256.}));
}

TEST(PngGrid, LowMayBeAboveHigh) {
  const auto result = read(png_bytes({2, 2, 8, 0, 0, {0, '\xff', 0, 0}}), 2., -2.);
  ASSERT_TRUE(result.grid.has_value()) << result.message;
  EXPECT_EQ(result.grid->heights, (std::vector<double>{2., 2., 2., -2.}));
}

TEST(PngGrid, SaysWhyAFileIsRefused) {
  const std::string colour =
      "it has colour, a palette or transparency; heights come from a grayscale image without alpha";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "it is not a PNG image"},
      {"1 2\n3 4\n", "it is not a PNG image"},
      {png_bytes({2, 2, 8, 2, 0, std::string(12, 'a')}), colour},
      {png_bytes({2, 2, 8, 4, 0, std::string(8, 'a')}), colour},
      {png_bytes({2, 2, 8, 6, 0, std::string(16, 'a')}), colour},
      {png_bytes({2, 2, 4, 0, 0, std::string(2, 'a')}),
       "it has 4 bits of gray; heights come from 8 or 16"},
      {png_bytes({2, 2, 8, 0, 1, std::string(4, 'a')}), "it is interlaced; save it without"},
      {png_bytes({1, 4, 8, 0, 0, std::string(4, 'a')}),
       "it has 1 x 4 pixels; a grid needs at least 2 x 2"},
      {png_bytes({5000, 4000, 8, 0, 0, "a"}),
       "it has 5000 x 4000 pixels, more than 16777216 in all"},
      {png_bytes({900000, 2, 8, 0, 0, "a"}),
       "it has 900000 x 2 pixels, more than 65536 along a side"},
  };
  for (const auto& [bytes, message] : cases) {
    const auto result = read(bytes);
    EXPECT_FALSE(result.grid.has_value());
    EXPECT_EQ(result.message, message);
  }
  EXPECT_EQ(read_png_grid("no/such/file.png", 0., 1.).message, "it is not a PNG image");
}

// Wherever a file is cut off and whichever byte is damaged, it is refused; none of that is a crash.
TEST(PngGrid, RefusesEveryCutAndEveryDamage) {
  const std::string whole = png_bytes({3, 4, 8, 0, 0, "abcdefghijkl"});
  ASSERT_TRUE(read(whole).grid.has_value());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto result = read(whole.substr(0, length));
    EXPECT_FALSE(result.grid.has_value()) << length;
    if (length >= 8) {
      EXPECT_EQ(result.message.substr(0, 25), "it is damaged or cut off:");
    }
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
    EXPECT_FALSE(read(damaged).grid.has_value()) << at;
  }
}

}  // namespace
}  // namespace hookpoint::simulation
