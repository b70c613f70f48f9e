// Notes of a figure's caption, against curves whose distance is known.
#include "studies/report/figure_notes.h"

#include <gtest/gtest.h>

namespace hookpoint::studies {
namespace {

output::Series curve(const char* label, std::vector<double> y) {
  output::Series series;
  series.label = label;
  series.measured = {{0., 1.}, std::move(y)};
  return series;
}

output::Plot plot_of(std::vector<output::Series> series) {
  output::Plot plot;
  plot.series = std::move(series);
  return plot;
}

TEST(FigureNotes, CurvesWithinAMarkerOfOneAnotherAreNamedTogether) {
  // The axis is 1 high, so a marker 0.01.
  const output::Plot plot =
      plot_of({curve("ode", {0., 1.}), curve("dart", {0.009, 0.991}), curve("simbody", {0., 0.98}),
               curve("bullet", {0.5, 0.5}), curve("mujoco", {0.5, 0.5})});
  EXPECT_EQ(coinciding_note({plot}),
            " Coincide, one marker hides the others: ode = dart; bullet = mujoco.");
  // In another panel bullet and mujoco are apart.
  output::Plot other = plot;
  other.series[4].measured.y = {0.5, 0.6};
  EXPECT_EQ(coinciding_note({plot, other}), " Coincide, one marker hides the others: ode = dart.");
  // At other places of x nothing hides.
  output::Plot shifted = plot_of({curve("ode", {0., 1.}), curve("dart", {0., 1.})});
  shifted.series[1].measured.x = {0., 2.};
  EXPECT_EQ(coinciding_note({shifted}), "");
  shifted.series[1] = curve("reference", {0., 1.});
  shifted.series[1].reference = true;
  EXPECT_EQ(coinciding_note({shifted}), "");
}

TEST(FigureNotes, OnALogarithmicAxisAMarkerIsAPartOfItsDecades) {
  // Two decades, a marker 0.02 of one: a factor of 1.047.
  output::Plot plot = plot_of({curve("a", {1., 100.}), curve("b", {1.04, 100.}),
                               curve("c", {1.06, 100.}), curve("d", {-1., 100.})});
  plot.y.logarithmic = true;
  EXPECT_EQ(coinciding_note({plot}), " Coincide, one marker hides the others: a = b.");
  // What counts as zero has a lane of its own below the axis.
  output::Plot zeros = plot_of({curve("a", {0., 1.}), curve("b", {0., 1.})});
  zeros.y.logarithmic = true;
  EXPECT_EQ(coinciding_note({zeros}), "");
}

TEST(FigureNotes, AFlatZeroIsToldWithItsReason) {
  PlotSpec spec;
  spec.x = "time";
  spec.y = "displacement";
  const output::Plot drop = plot_of({curve("a", {0., 1e-15}), curve("b", {0., 0.})});
  EXPECT_EQ(vanishing_note(spec, {drop}),
            " All that is measured here is zero: displacement is along the ground, and what goes "
            "straight down has none.");
  EXPECT_EQ(vanishing_note(spec, {drop, plot_of({curve("a", {0., 1.})})}), "");
  EXPECT_EQ(vanishing_note(spec, {plot_of({})}), "");
  spec.x = "slope";
  EXPECT_EQ(vanishing_note(spec, {drop}), " All that is measured here is zero.");
}

TEST(FigureNotes, WhatALogarithmicAxisHasNoPlaceForStandsAtItsEdge) {
  output::Plot plot = plot_of({curve("a", {1., 2.})});
  plot.x.label = "slope";
  EXPECT_EQ(edge_note({plot}), "");
  plot.x.logarithmic = true;
  EXPECT_EQ(edge_note({plot}),
            " At the left edge: slope of 0 or less, for which a logarithmic axis has no place.");
  plot.series[0].measured.x = {0.5, 1.};
  EXPECT_EQ(edge_note({plot}), "");
  plot.series[0].unfinished = {-1.};
  EXPECT_NE(edge_note({plot_of({}), plot}), "");
}

}  // namespace
}  // namespace hookpoint::studies
