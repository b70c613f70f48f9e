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

}  // namespace
}  // namespace hookpoint
