// What plots draw: no extreme is lost, however long the run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/view/session/history.h"
#include "apps/view/session/traces.h"

namespace hookpoint::view {
namespace {

using Row = std::vector<double>;

TEST(Traces, KeepEverySampleWhileThereIsRoom) {
  Traces traces(1000);
  EXPECT_TRUE(traces.add("a"));
  EXPECT_FALSE(traces.add("a"));
  for (int i = 0; i < 100; ++i) traces.sample(0.1 * i, Row{double(i)});
  const auto extract = traces.extract({"a"}, 1., 2.05, 1000);
  ASSERT_EQ(extract.times.size(), 11U);
  EXPECT_EQ(extract.times.front(), 1.);
  EXPECT_EQ(extract.values[0].front(), 10.);
  EXPECT_EQ(extract.values[0].back(), 20.);
}

TEST(Traces, AColumnThatBeginsLateIsUnknownBefore) {
  Traces traces(1000);
  traces.add("a");
  traces.sample(0., Row{1.});
  traces.add("b");
  traces.sample(1., Row{2., 3.});
  const auto extract = traces.extract({"b", "a", "c"}, 0., 5., 100);
  EXPECT_TRUE(std::isnan(extract.values[0][0]));
  EXPECT_EQ(extract.values[0][1], 3.);
  EXPECT_EQ(extract.values[1], (Row{1., 2.}));
  EXPECT_TRUE(std::isnan(extract.values[2][1]));
}

/// A spike of one sample in a hundred thousand is there at every zoom, once up and once down, at
/// its place to within a stretch.
TEST(Traces, NeverLoseAnExtreme) {
  constexpr int count = 100'000, up = 34'567, down = 71'234;
  Traces traces(1000);
  traces.add("a");
  for (int i = 0; i < count; ++i)
    traces.sample(i, Row{i == up ? 5. : i == down ? -7. : std::sin(0.001 * i)});
  for (const std::size_t points : {2UL, 10UL, 100UL, 100'000UL}) {
    const auto extract = traces.extract({"a"}, 0., count, points);
    EXPECT_LE(extract.times.size(), std::max<std::size_t>(1000, points) + 2);
    EXPECT_TRUE(std::ranges::is_sorted(extract.times));
    EXPECT_EQ(*std::ranges::max_element(extract.values[0]), 5.);
    EXPECT_EQ(*std::ranges::min_element(extract.values[0]), -7.);
  }
  const auto extract = traces.extract({"a"}, 0., count, 100'000);
  const auto at = std::ranges::max_element(extract.values[0]) - extract.values[0].begin();
  EXPECT_NEAR(extract.times[static_cast<std::size_t>(at)], up, count / 250.);
}

TEST(Traces, ForgetWhatARunThatWentBackNeverReached) {
  Traces traces(1000);
  traces.add("a");
  for (int i = 0; i < 10; ++i) traces.sample(i, Row{double(i)});
  traces.cut(4.);
  traces.sample(5., Row{-5.});
  const auto extract = traces.extract({"a"}, 0., 100., 100);
  EXPECT_EQ(extract.values[0], (Row{0., 1., 2., 3., 4., -5.}));
}

}  // namespace
}  // namespace hookpoint::view
