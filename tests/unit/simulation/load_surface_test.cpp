// Terrain.Rough, Terrain.Steps and a PNG under Terrain.Grid, as files give them: loaded, stood on,
// or refused at the place.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/experiment/kinematics.h"
#include "simulation/scene/terrain/surface.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/png_file.h"

namespace hookpoint {
namespace {

using namespace simulation;
using test_support::png_bytes;

std::string refusal(const std::string& terrain) {
  const Loaded loaded = load_text("World w {\n" + terrain + " }");
  EXPECT_FALSE(loaded.experiment);
  return loaded.diagnostics;
}

TEST(LoadSurface, RoughGroundIsThatOfItsFields) {
  const Loaded loaded = load_text(
      "World w { Terrain.Rough g { amplitude = 30 mm; wavelength = 40 cm; seed = 7; flat_radius = "
      "0.2 m; slope = 5 deg; azimuth = 30 deg; spacing = 8 cm; size = 3, 2; } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const TerrainSpec& terrain = *loaded.experiment->terrain;
  EXPECT_EQ(terrain.spacing, 0.08);
  constexpr double degree = 3.14159265358979323846 / 180.;
  const GridSpec expected =
      rough_surface({0.03, 0.4, 7, 0.2, 5 * degree, 30 * degree}, {0.08, 3., 2.});
  EXPECT_EQ(std::get<GridSpec>(terrain.surface).heights, expected.heights);
  EXPECT_EQ(std::get<GridSpec>(terrain.surface).columns, 39);  // 38 cells, the next even number
}

TEST(LoadSurface, RoughGroundIsFineEnoughByItself) {
  const Loaded loaded =
      load_text("World w { Terrain.Rough g { amplitude = 0.01; wavelength = 0.4; } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.experiment->terrain->spacing, 0.05);
  EXPECT_EQ(std::get<GridSpec>(loaded.experiment->terrain->surface).columns, 201);
}

TEST(LoadSurface, StepsGoToTheEdgeUnlessCounted) {
  for (const bool counted : {false, true}) {
    const Loaded loaded =
        load_text(std::string("World w { Terrain.Steps g { height = 0.1; run = 0.5; from = 1; ") +
                  (counted ? "count = 3; " : "") + "size = 8; } }");
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const contact::Terrain terrain(*loaded.experiment->terrain);
    EXPECT_NEAR(terrain.query(3.4, 0., 0.).height, counted ? 0.3 : 0.5, 1e-12);
  }
}

TEST(LoadSurface, SaysWhatIsWrongAtThePlace) {
  EXPECT_EQ(
      refusal("Terrain.Rough g { amplitude = 1; wavelength = 0.1; spacing = 1; }"),
      "error 2:1 a spacing of 1 m is too coarse for waves of 0.1 m; make it at most a quarter "
      "of the wavelength\n");
  EXPECT_EQ(refusal("Terrain.Steps g { height = 1; run = 0.01; }"),
            "error 2:1 a run of 0.01 m leaves no tread beside a riser one cell, 0.02 m, wide; "
            "lengthen the run or lower the spacing\n");
  EXPECT_EQ(refusal("Terrain.Rough g { amplitude = -1; wavelength = 0.1; }"),
            "error 2:31 `amplitude` must be at least 0 m, not -1 m\n");
}

class LoadImage : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The terrain of `image` with `fields`.
  Loaded load(const std::string& image, const std::string& fields) const {
    test_support::write_file(folder_ / "Image.PNG", image);
    test_support::write_file(
        folder_ / "image.hook",
        "World w { Terrain.Grid g {\nfile = \"Image.PNG\"; " + fields + " } }");
    return load_file(folder_ / "image.hook");
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("hookpoint_image_" + std::to_string(getpid()));
};

TEST_F(LoadImage, IsCentredAndItsTopIsNorth) {
  const Loaded loaded = load(png_bytes({3, 2, 8, 0, 0, {'\xff', 0, 0, 0, 0, 0}}),
                             "spacing = 0.5; low = -10 mm; high = 20 mm; height = 1; ");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const contact::Terrain terrain(*loaded.experiment->terrain);
  EXPECT_NEAR(terrain.query(-0.5, 0.25, 0.).height, 1.02, 1e-15);
  EXPECT_NEAR(terrain.query(-0.5, -0.25, 0.).height, 0.99, 1e-15);
  EXPECT_NEAR(terrain.query(0.5, 0.25, 0.).height, 0.99, 1e-15);
  EXPECT_TRUE(terrain.query(0.51, 0., 0.).outside);
}

TEST_F(LoadImage, IsRefusedAtItsName) {
  EXPECT_EQ(load("P5 2 2 255 abcd", "low = 0; high = 1;").diagnostics,
            "error 2:8 \"Image.PNG\" cannot be read as heights: it is not a PNG image\n");
  const std::string image = png_bytes({2, 2, 8, 0, 0, "abcd"});
  const std::string cut =
      load(image.substr(0, image.size() - 20), "low = 0; high = 1;").diagnostics;
  EXPECT_TRUE(cut.starts_with(
      "error 2:8 \"Image.PNG\" cannot be read as heights: it is damaged or cut off: "))
      << cut;
  EXPECT_EQ(load(png_bytes({2, 2, 8, 2, 0, "abcdefabcdef"}), "low = 0; high = 1;").diagnostics,
            "error 2:8 \"Image.PNG\" cannot be read as heights: it has colour, a palette or "
            "transparency; heights come from a grayscale image without alpha\n");
  EXPECT_EQ(load(image, "high = 1;").diagnostics,
            "error 2:8 a PNG needs `low`, the height of its black\n");
  EXPECT_EQ(load(image, "low = 0;").diagnostics,
            "error 2:8 a PNG needs `high`, the height of its white\n");
}

TEST(LoadSurface, ATextFileHasNoBlackAndWhite) {
  const std::string bumps =
      (std::filesystem::path(testing::source_folder()) / "configs/terrains/bumps.txt").string();
  EXPECT_EQ(refusal("Terrain.Grid g { file = \"" + bumps + "\"; \nhigh = 1; }"),
            "error 3:8 `high` goes with a PNG; a text file has its heights in metres\n");
}

// A wide box, a point in its middle: on uneven ground it is the deepest of its points that stands
// at the static penetration, m g/k of one point, and no other is deeper.
TEST(LoadSurface, ARobotRestsOnTheHighestOfTheGroundUnderIt) {
  for (const char* at : {"1.3, -0.8", "-1, 1.1", "0, 0"}) {
    const Loaded loaded = load_text(
        std::string(
            "World w { Material m { normal_stiffness = 50000; } Terrain.Rough g { amplitude "
            "= 0.1; wavelength = 0.5; material = m; } Robot r { Base.mobile { rest_on = g; "
            "at = ") +
        at + "; mass = 2; Shape.Box { dimensions = 0.6, 0.5, 0.1; boundary_points = 4; } } } }");
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const RobotSpec& robot = loaded.experiment->robots[0];
    const contact::Terrain terrain(*loaded.experiment->terrain);
    double deepest = -1.;
    for (const Vector3d& p_LP : robot.base.boundary_points) {
      const Vector3d p = robot.location + rotate(robot.orientation, p_LP);
      deepest = std::max(deepest, terrain.query(p).depth);
    }
    const Vector3d z = rotate(robot.orientation, Vector3d{0., 0., 1.});
    const double load = 2. * 9.81 * z.z / 25.;  // the 25 points of its lower face
    EXPECT_NEAR(deepest, load / 50000., 1e-12) << at;
  }
}

}  // namespace
}  // namespace hookpoint
