// A quadratic surface over places: its least point from formulas that are known.
#include "studies/calibrate/response_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hookpoint::studies {
namespace {

/// Two things whose errors are least at places of their own, with a ripple on them.
std::vector<double> errors_at(const UnitPoint& point, double ripple) {
  const double x = point[0], y = point[1];
  const double wave = ripple * std::sin(300. * x + 211. * y);
  return {1. + 2. * (x - 0.3) * (x - 0.3) + (y - 0.6) * (y - 0.6) + wave,
          2. + 2. * (x - 0.5) * (x - 0.5) + (y - 0.4) * (y - 0.4) - wave};
}

std::vector<PlacedErrors> grid(double ripple) {
  std::vector<PlacedErrors> looked;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      looked.push_back({{i / 11., j / 11.}, errors_at({i / 11., j / 11.}, ripple)});
  return looked;
}

TEST(ResponseSurface, IsLeastWhereTheWeighedSumOfTheThingsIs) {
  const auto surface = ResponseSurface::fit(grid(0.));
  ASSERT_TRUE(surface);
  const auto at = [&](std::vector<int> times) { return *surface->least(times); };
  // Of equal parabolas the weighed mean of where each is least.
  const std::vector<std::pair<std::vector<int>, UnitPoint>> known{
      {{1, 0}, {0.3, 0.6}}, {{0, 1}, {0.5, 0.4}}, {{1, 1}, {0.4, 0.5}}, {{3, 1}, {0.35, 0.55}}};
  for (const auto& [times, point] : known) {
    EXPECT_NEAR(at(times)[0], point[0], 1e-12);
    EXPECT_NEAR(at(times)[1], point[1], 1e-12);
  }
}

// The best places alone count: what is far off may be of any shape.
TEST(ResponseSurface, IsOfTheBestPlacesAndSmoothsTheirRipple) {
  std::vector<PlacedErrors> looked = grid(1e-3);
  for (PlacedErrors& one : looked)
    if (one.errors[0] + one.errors[1] > 3.2)
      for (double& error : one.errors) error += 10. * one.point[0];
  const auto surface = ResponseSurface::fit(looked);
  ASSERT_TRUE(surface);
  const UnitPoint point = *surface->least(std::vector<int>{1, 1});
  EXPECT_NEAR(point[0], 0.4, 0.02);
  EXPECT_NEAR(point[1], 0.5, 0.02);
}

TEST(ResponseSurface, HasNoLeastPlaceWhereItIsNotConvexOrNotKnown) {
  const auto surface = ResponseSurface::fit(grid(0.));
  ASSERT_TRUE(surface);
  EXPECT_TRUE(surface->least(std::vector<int>{1, 0}));
  EXPECT_FALSE(surface->least(std::vector<int>{-1, 0}));
  EXPECT_FALSE(ResponseSurface::fit({}));
  std::vector<PlacedErrors> few = grid(0.);
  few.resize(17);
  EXPECT_FALSE(ResponseSurface::fit(few));
  std::vector<PlacedErrors> line = grid(0.);
  for (PlacedErrors& one : line) one.point[1] = 0.5;
  EXPECT_FALSE(ResponseSurface::fit(line));
}

}  // namespace
}  // namespace hookpoint::studies
