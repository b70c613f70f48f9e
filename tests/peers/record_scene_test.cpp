// The scene of an MCAP record, read back by @mcap/core and held against the schemas that Foxglove
// publishes: poses as a CSV record of the same run has them, shapes where the language puts them.
#include "tests/support/record_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/support/command.h"
#include "tests/support/read_record.h"

namespace hookpoint {
namespace {

using Lines = std::vector<std::vector<std::string>>;

/// Two robots: one of each shape with a chain, which falls and turns, one without a shape.
constexpr const char* scene = R"(World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.25;
  Material clay { normal_stiffness = 1e4; }
  Material ice { normal_stiffness = 1e4; }
  Terrain.Flat ground {
    size = 4; material = clay;
    Patch { from = 0,0; to = 1,1; material = ice; }
  }
  Robot bot[1] {
    Base.mobile {
      location = 0.1,0.2,1; orientation = 0.1, 0.2, 0.3; angular_velocity = 1, -2, 3; mass = 2;
      Shape.Box { dimensions = 0.3, 0.2, 0.1; location = 0, 0, 0.5; }
      Shape.Sphere { radius = 0.25; location = 1, 0, 0; }
    }
    Chain arm {
      hip_distance = 0.1, 0, 0;
      Link upper {
        mass = 1; rate = 2;
        Shape.Legcone { length = 0.4; proximal_radius = 0.03; distal_radius = 0.01; }
      }
      Link lower {
        dhlength = 0.4; mass = 1;
        Shape.Legcone { length = 0.2; proximal_radius = 0.01; distal_radius = 0.02; location = 0, 0, 1; orientation = 0, 0, 90 deg; }
        Shape.Cylinder { radius = 0.05; length = 0.3; }
      }
    }
  }
  Robot ball { Base.mobile { location = 0,0,9; mass = 1; inertia = 1,1,1,0,0,0; } }
  RECORDS
}
)";

std::string with(const std::string& records) {
  std::string text = scene;
  return text.replace(text.find("RECORDS"), 7, records);
}

const std::vector<std::string> bodies{"w.bot[1].base", "w.bot[1].arm.upper", "w.bot[1].arm.lower",
                                      "w.ball.base"};

std::string all_poses() {
  std::string trails;
  for (const std::string& body : bodies)
    for (const char* port : {".location", ".orientation"})
      trails += (trails.empty() ? "" : ", ") + body.substr(2) + port;
  return trails;
}

Lines lines_of(const std::string& text, const std::string& kind) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (std::vector<std::string> fields = testing::split_fields(line); fields[0] == kind)
      lines.push_back(std::move(fields));
  return lines;
}

std::vector<double> numbers(const std::vector<std::string>& fields, std::size_t from) {
  std::vector<double> values;
  for (std::size_t i = from; i < fields.size(); ++i) values.push_back(std::stod(fields[i]));
  return values;
}

class RecordScene : public ::testing::Test {
 protected:
  void run(const std::string& records, const std::string& options = "") {
    place_.file("run.hook", with(records));
    const testing::CommandResult result = place_.hookpoint("run run.hook --out out " + options);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  /// What read_scene.mjs prints of a file.
  void read(const std::string& file, bool cut_off = false) {
    const testing::Reader reader = testing::scene_reader(cut_off);
    ASSERT_EQ(reader.missing, "");
    if (!reader.out_of_reach.empty()) GTEST_SKIP() << "out of reach: " << reader.out_of_reach;
    const testing::Reading reading = testing::run_reader(reader.command + "'" + file + "'", true);
    ASSERT_EQ(reading.status, 0) << reading.output;
    text_ = reading.output;
  }
  std::string out(const std::string& name) const {
    return (place_.folder() / "out" / name).string();
  }
  Lines lines(const std::string& kind) const { return lines_of(text_, kind); }

  testing::Workplace place_;
  std::string text_;
};

TEST_F(RecordScene, PosesAreThoseOfTheCsvRecord) {
  run("Record seen { format = mcap; trails = time; rate = 100 Hz; }\n"
      "Record poses { trails = " +
      all_poses() + "; rate = 100 Hz; }");
  read(out("seen.mcap"));
  if (IsSkipped() || HasFatalFailure()) return;
  const Lines topics = lines("topic");
  ASSERT_EQ(topics.size(), 2u);
  EXPECT_EQ(topics[0],
            (std::vector<std::string>{"topic", "/tf", "foxglove.FrameTransforms", "26"}));
  EXPECT_EQ(topics[1], (std::vector<std::string>{"topic", "/scene", "foxglove.SceneUpdate", "1"}));

  const Lines transforms = lines("transform");
  std::istringstream table(place_.read("out/poses.csv"));
  std::string line;
  std::getline(table, line);
  std::size_t at = 0;
  for (int row = 0; std::getline(table, line); ++row) {
    std::replace(line.begin(), line.end(), ',', '\t');
    const std::vector<double> values = numbers(testing::split_fields(line), 1);
    ASSERT_EQ(values.size(), 7 * bodies.size());
    for (std::size_t body = 0; body < bodies.size(); ++body, ++at) {
      ASSERT_LT(at, transforms.size());
      const std::vector<std::string>& transform = transforms[at];
      const int nanoseconds = row * 10'000'000;
      EXPECT_EQ(transform[1], std::to_string(nanoseconds));
      EXPECT_EQ(transform[2], "0");
      EXPECT_EQ(transform[3], std::to_string(nanoseconds));
      EXPECT_EQ(transform[4], "world");
      EXPECT_EQ(transform[5], bodies[body]);
      const std::vector<double> pose = numbers(transform, 6);
      ASSERT_EQ(pose.size(), 7u);
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(pose[i]),
                  std::bit_cast<std::uint64_t>(values[7 * body + i]))
            << bodies[body] << " row " << row << " number " << i;
    }
  }
  EXPECT_EQ(at, transforms.size());
  EXPECT_EQ(at, 26 * bodies.size());
  // Free fall of the ball by hand, so that not both are wrong alike: semi-implicit Euler is ahead
  // of g t^2/2 by g t dt/2.
  EXPECT_NEAR(numbers(transforms.back(), 6)[2], 9. - 9.81 * 0.25 * (0.25 + 1e-3) / 2., 1e-12);
}

void expect_numbers(const std::vector<std::string>& line, const std::vector<double>& expected) {
  const std::vector<double> found = numbers(line, 2);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-15) << line[0] << " of " << line[1] << ", number " << i;
}

TEST_F(RecordScene, ShapesStandWhereTheLanguagePutsThem) {
  run("Record seen { format = mcap; trails = time; }");
  read(out("seen.mcap"));
  if (IsSkipped() || HasFatalFailure()) return;
  const Lines entities = lines("entity");
  ASSERT_EQ(entities.size(), 5u) << "three bodies with shapes, two materials";
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const std::vector<std::string>& entity = entities[i];
    EXPECT_EQ(entity[1] + entity[2] + entity[3], "000") << "at the first row";
    EXPECT_EQ(entity[4], i < 3 ? bodies[i] : i == 3 ? "w.ground[0]" : "w.ground[1]");
    EXPECT_EQ(entity[5], i < 3 ? bodies[i] : "world") << "it moves with its frame";
    EXPECT_EQ(entity[6], "true");
    EXPECT_EQ(entity[7], "0") << "it stays";
  }
  const Lines cubes = lines("cube"), spheres = lines("sphere"), cylinders = lines("cylinder");
  ASSERT_EQ(cubes.size(), 1u);
  expect_numbers(cubes[0], {0., 0., 0.5, 1., 0., 0., 0., 0.3, 0.2, 0.1});
  ASSERT_EQ(spheres.size(), 1u);
  expect_numbers(spheres[0], {1., 0., 0., 1., 0., 0., 0., 0.5, 0.5, 0.5});
  ASSERT_EQ(cylinders.size(), 3u);
  // A legcone's middle is at half its length along x, its z turned to x: by 90 degrees about y.
  const double half = std::sqrt(0.5);
  EXPECT_EQ(cylinders[0][1], "w.bot[1].arm.upper");
  expect_numbers(cylinders[0], {0.2, 0., 0., half, 0., half, 0., 0.06, 0.06, 0.4, 1., 1. / 3.});
  // Turned about z by 90 degrees besides: (1 + k)(1 + j)/2 = (1 - i + j + k)/2.
  expect_numbers(cylinders[1], {0., 0.1, 1., 0.5, -0.5, 0.5, 0.5, 0.04, 0.04, 0.2, 0.5, 1.});
  expect_numbers(cylinders[2], {0., 0., 0., 1., 0., 0., 0., 0.1, 0.1, 0.3, 1., 1.});
}

// A gate at 0.5 m/s along x, ground that sinks at 0.2 m/s.
TEST_F(RecordScene, ObstaclesAndGroundThatMoveHaveTheirOwnFrames) {
  place_.file("run.hook", R"(World w {
  deltat = 1 ms; duration = 0.1;
  Terrain.Flat ground { size = 2; frame_velocity = 0, 0, -0.2; }
  Obstacle.Box gate { dimensions = 0.1, 1, 0.5; location = 1, 2, 3; velocity = 0.5, 0, 0; }
  Obstacle.Sphere ball { radius = 0.1; mass = 1; free = true; location = 0, 0, 9; }
  Record seen { format = mcap; trails = time; rate = 10 Hz; }
})");
  const testing::CommandResult result = place_.hookpoint("run run.hook --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  read(out("seen.mcap"));
  if (IsSkipped() || HasFatalFailure()) return;
  const Lines entities = lines("entity"), transforms = lines("transform");
  ASSERT_EQ(entities.size(), 3u);
  EXPECT_EQ(entities[1][5], "w.gate");
  EXPECT_EQ(entities[2][4], "w.ground[0]");
  EXPECT_EQ(entities[2][5], "w.ground");
  ASSERT_EQ(transforms.size(), 6u) << "two rows";
  EXPECT_EQ(transforms[3][5], "w.ball.base");
  EXPECT_EQ(transforms[4][5], "w.gate");
  EXPECT_EQ(transforms[5][5], "w.ground");
  EXPECT_NEAR(numbers(transforms[4], 6)[0], 1.05, 1e-12);
  EXPECT_NEAR(numbers(transforms[5], 6)[2], -0.02, 1e-12);
}

TEST_F(RecordScene, GroundIsTrianglesOfEachMaterial) {
  run("Record seen { format = mcap; trails = time; }");
  read(out("seen.mcap"));
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(lines("material"),
            (Lines{{"material", "w.ground[0]", "clay"}, {"material", "w.ground[1]", "ice"}}));
  std::map<std::string, double> areas;
  for (const std::vector<std::string>& triangle : lines("triangle")) {
    const std::vector<double> p = numbers(triangle, 2);
    ASSERT_EQ(p.size(), 9u);
    areas[triangle[1]] += 0.5 * ((p[3] - p[0]) * (p[7] - p[1]) - (p[4] - p[1]) * (p[6] - p[0]));
    EXPECT_EQ(p[2], 0.);
  }
  EXPECT_DOUBLE_EQ(areas["w.ground[0]"], 15.);
  EXPECT_DOUBLE_EQ(areas["w.ground[1]"], 1.);
}

TEST_F(RecordScene, LeftOutItLeavesTheChannelsAsTheyAre) {
  run("Record plain { format = mcap; trails = " + all_poses() +
      "; scene = false; }\nRecord seen { format = mcap; trails = " + all_poses() + "; }");
  read(out("plain.mcap"));
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(text_, "") << "neither topics nor messages";
  const std::string channels = testing::reader_of("mcap").command;
  const auto data = [&](const std::string& file) {
    const testing::Reading reading = testing::run_reader(channels + "'" + out(file) + "'");
    EXPECT_EQ(reading.status, 0);
    Lines lines = lines_of(reading.output, "data");
    EXPECT_EQ(lines.size(), 7 * bodies.size());
    return lines;
  };
  EXPECT_EQ(data("plain.mcap"), data("seen.mcap"));
}

TEST_F(RecordScene, IsThereInWhatAKilledRunLeaves) {
  output::RecordHeader header = testing::awkward_header();
  header.scene.bodies = {{"w.ball", {{output::SceneSphere{0.5}, {}, {}}}}};
  const std::filesystem::path path = place_.folder() / "run.mcap";
  testing::run_and_die([&] {
    const auto record = output::make_record_writer("mcap", path, header);
    for (int k = 0; k < 1100; ++k) {
      std::vector<double> row = testing::awkward_row(k);
      for (int i = 0; i < 7; ++i) row.push_back(i == 3 ? 1. : 0.);
      if (k == 7) row.back() = std::nan("");
      record->row(5. + testing::awkward_time(k), row);
    }
    ::kill(::getpid(), SIGKILL);
  });
  read(path.string() + ".partial", true);
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(lines("topic").size(), 2u);
  ASSERT_EQ(lines("entity").size(), 1u);
  EXPECT_EQ(lines("entity")[0][1], "5000000000") << "where the rows begin";
  EXPECT_EQ(lines("transform").size(), 1023u) << "of two blocks; a pose that is no number is none";
}

TEST_F(RecordScene, OnlyMcapHasOne) {
  place_.file("run.hook", with("Record a { trails = time; scene = true; }\n"
                               "Record b { trails = time; scene = false; }"));
  const testing::CommandResult result = place_.hookpoint("run run.hook --out out");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(
      result.err.find("format csv has no scene: leave this out, or record with format = mcap"),
      std::string::npos)
      << result.err;
}

TEST_F(RecordScene, SameRunSameBytes) {
  run("Record seen { format = mcap; trails = time; }");
  const std::string first = place_.read("out/seen.mcap");
  std::filesystem::remove_all(place_.folder() / "out");
  run("Record seen { format = mcap; trails = time; }");
  EXPECT_EQ(first, place_.read("out/seen.mcap"));
}

}  // namespace
}  // namespace hookpoint
