#include <gtest/gtest.h>

#include <sstream>

#include "simulation/scene/terrain/ascii_grid.h"

namespace hookpoint::simulation {
namespace {

AsciiGridResult read(const std::string& text) {
  std::istringstream stream(text);
  return read_ascii_grid(stream);
}

TEST(AsciiGrid, ReadsAnEsriGridNorthernmostRowFirst) {
  const auto result = read(
      "NCOLS 3\r\nnrows 2\nxllcorner -1.5\nyllcenter 2\ncellsize 0.25\nNODATA_value -9999\n"
      "1 2 3\n\n4 +5 -6e-1\n");
  ASSERT_TRUE(result.grid.has_value()) << result.message;
  EXPECT_EQ(result.grid->columns, 3);
  EXPECT_EQ(result.grid->rows, 2);
  EXPECT_EQ(result.grid->spacing, 0.25);
  EXPECT_EQ(result.grid->origin_x, -1.5);
  EXPECT_EQ(result.grid->origin_y, 2.);
  EXPECT_EQ(result.grid->heights, (std::vector<double>{4., 5., -0.6, 1., 2., 3.}));
}

TEST(AsciiGrid, ReadsAPlainMatrixLeastYFirst) {
  const auto result = read("1 2\n3\t4\n5 6");
  ASSERT_TRUE(result.grid.has_value()) << result.message;
  EXPECT_EQ(result.grid->rows, 3);
  EXPECT_EQ(result.grid->heights, (std::vector<double>{1., 2., 3., 4., 5., 6.}));
  EXPECT_FALSE(result.grid->spacing.has_value());
}

TEST(AsciiGrid, SaysWhichLineIsWrong) {
  const std::vector<std::tuple<std::string, int, std::string>> cases{
      {"", 0, "no heights"},
      {"1 2\n3 x\n", 2, "line 2: expected a height, got 'x'"},
      {"1 2\n3 4 5\n", 2, "line 2: expected 2 heights, got 3"},
      {"1 2\nnan 4\n", 2, "line 2: expected a height, got 'nan'"},
      {"1 2\n1e999 4\n", 2, "line 2: expected a height, got '1e999'"},
      {"1 2\n", 1, "line 1: a grid needs at least 2 x 2 heights"},
      {"ncols 2\nnrows 3\n1 2\n3 4\n", 4, "line 4: expected 3 rows, got 2"},
      {"ncols 2\nnrows 2\n1 2\n3\n", 4, "line 4: expected 2 heights, got 1"},
      {"ncols 2\n1 2\n3 4\n", 0, "a header needs both ncols and nrows"},
      {"ncols 2\nncols 2\n", 2, "line 2: 'ncols' a second time"},
      {"ncols two\n", 1, "line 1: expected one number after 'ncols'"},
      {"ncols 2.5\n", 1, "line 1: 'ncols' must be a whole number of at least 2"},
      {"cellsize 0\n", 1, "line 1: cellsize must be positive"},
      {"ncols 2\nnrows 2\nNODATA_value -1\n1 2\n3 -1\n", 5,
       "line 5: NODATA height: the ground must not have holes"},
      {"cellsiz 1\n", 1,
       "line 1: expected a height or one of ncols, nrows, xllcorner, yllcorner, cellsize, "
       "NODATA_value, got 'cellsiz'"},
      {std::string("\x7f\x00PNG", 5), 1, "line 1: expected a height, got '??PNG'"},
  };
  for (const auto& [text, line, message] : cases) {
    const auto result = read(text);
    EXPECT_FALSE(result.grid.has_value()) << text;
    EXPECT_EQ(result.message, message);
    EXPECT_EQ(result.line, line) << message;
  }
  const auto absent = read_ascii_grid(std::filesystem::path("no/such/file.asc"));
  EXPECT_EQ(absent.message, "cannot open no/such/file.asc");
}

}  // namespace
}  // namespace hookpoint::simulation
