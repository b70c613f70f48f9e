// Differences of traces that have parts: vectors, and orientations as rotations.
#include "studies/measurements/trace_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hookpoint::studies {
namespace {

TracePlan orientation(const std::vector<double>& measured) {
  TracePlan trace;
  trace.parts = {"q.w", "q.x", "q.y", "q.z"};
  trace.weight = 2.;
  trace.measured.width = 4;
  trace.measured.time = std::vector<double>(measured.size() / 4, 0.);
  trace.measured.value = measured;
  return trace;
}

/// About z.
std::vector<double> turned(double angle) {
  return {std::cos(0.5 * angle), 0., 0., std::sin(0.5 * angle)};
}

TEST(TraceResidual, OfAnOrientationIsTheRotationTheShorterWayRound) {
  const TracePlan trace = orientation(turned(0.3));
  std::vector<double> residuals(3);
  for (const double angle : {0.3, 0.5, -2.5, 0.3 + 1.9 * std::numbers::pi}) {
    for (const double side : {1., -1.}) {
      std::vector<double> model = turned(angle);
      for (double& part : model) part *= side;
      set_residuals(trace, 0, model, residuals);
      const double shorter = std::remainder(angle - 0.3, 2. * std::numbers::pi);
      EXPECT_NEAR(residuals[2], 2. * shorter, 1e-12) << angle;
      EXPECT_NEAR(residuals[0], 0., 1e-12);
      const std::vector<double> back = modelled(trace, 0, residuals);
      EXPECT_NEAR(std::abs(back[0] * model[0] + back[3] * model[3]), 1., 1e-12) << angle;
    }
  }
}

TEST(TraceResidual, CurveAfterCurveAndTheirMeanDistance) {
  std::vector<TracePlan> traces;
  traces.reserve(2);
  TracePlan& place = traces.emplace_back();
  place.parts = {"p.x", "p.y", "p.z"};
  place.port_unit = "mm";
  place.unit_of_port = 1e-3;
  place.weight = 10.;
  place.measured = {{0., 1.}, {1., 2., 3., 4., 5., 6.}, 3, {}};
  traces.push_back(orientation(turned(0.)));
  EXPECT_EQ(traces[0].residuals() + traces[1].residuals(), 9U);
  std::vector<double> residuals(9);
  const std::span<double> of_place = std::span(residuals).first(6);
  set_residuals(place, 0, std::vector<double>{1.3, 2.4, 3.}, of_place);
  set_residuals(place, 1, std::vector<double>{4., 5., 6.}, of_place);
  EXPECT_NEAR(residuals[0], 3., 1e-12);
  EXPECT_NEAR(residuals[2], 4., 1e-12);
  EXPECT_NEAR(distance(place, 0, of_place), 5., 1e-12);
  EXPECT_NEAR(modelled(place, 0, of_place)[1], 2400., 1e-9);
  EXPECT_EQ(measured(place, 1), (std::vector<double>{4000., 5000., 6000.}));
  set_residuals(traces[1], 0, turned(0.25), std::span(residuals).last(3));
  // 2.5 over both samples of the one, 0.5 of the other.
  EXPECT_NEAR(mean_distance(traces, residuals), 0.5 * (2.5 + 0.5), 1e-12);
  residuals[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(residuals_of(residuals, place, 0).empty());
  EXPECT_EQ(residuals_of(residuals, traces[1], 6).size(), 3U);
}

}  // namespace
}  // namespace hookpoint::studies
