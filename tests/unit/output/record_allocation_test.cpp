// A row allocates nothing, nor does the end of a block: counted at operator new. The HDF5 library
// allocates by itself (malloc, at the end of a block only); ours around it does not.
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/command.h"
#include "tests/support/record_scene.h"

namespace hookpoint {
namespace {

TEST(RecordAllocation, RowsAllocateNothing) {
  const testing::Workplace place;
  std::vector<std::vector<double>> rows;
  for (int k = 0; k < 1200; ++k) rows.push_back(testing::awkward_row(k));
  for (const output::RecordFormat& format : output::record_formats()) {
    const auto writer =
        output::make_record_writer(format.name, place.folder() / "run", testing::awkward_header());
    const long before = testing::allocation_count();
    for (int k = 0; k < 1200; ++k) writer->row(testing::awkward_time(k), rows[k]);
    EXPECT_EQ(testing::allocation_count() - before, 0) << format.name;
    writer->close();
  }
}

TEST(RecordAllocation, RowsWithPosesAllocateNothing) {
  const testing::Workplace place;
  output::RecordHeader header = testing::awkward_header();
  output::SceneSurface ground{"w.ground", "clay", {}, {}, {}};
  for (int i = 0; i < 20'000; ++i) ground.vertices.push_back({0.1 * i, 1. / (i + 1.), -0.5});
  for (std::uint32_t i = 2; i < 20'000; ++i) ground.triangles.push_back({0, i - 1, i});
  header.scene.ground = {ground};
  for (int i = 0; i < 19; ++i)
    header.scene.bodies.push_back(
        {"w.bot.leg[" + std::to_string(i) + "]", {{output::SceneSphere{0.1 * i}, {}, {}}}});
  const auto writer = output::make_record_writer("mcap", place.folder() / "run", header);
  std::vector<double> row = testing::awkward_row(0);
  row.resize(row.size() + 19 * output::numbers_of_pose, -1.2345678901234567e-300);
  const long before = testing::allocation_count();
  for (int k = 0; k < 1200; ++k) writer->row(testing::awkward_time(k), row);
  EXPECT_EQ(testing::allocation_count() - before, 0);
  writer->close();
}

}  // namespace
}  // namespace hookpoint
