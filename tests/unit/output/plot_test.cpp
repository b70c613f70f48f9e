#include "output/figures/plot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <tuple>

#include "output/figures/inline_svg.h"
#include "output/figures/plot_legend.h"
#include "output/figures/plot_scale.h"
#include "output/files/file.h"
#include "tests/support/text.h"

namespace hookpoint::output {
namespace {

using testing::count;

namespace fs = std::filesystem;

Plot sample() {
  Plot plot{.name = "creep",
            .title = "Creep, it's 50 % & more",
            .subtitle = "mu = 0.8",
            .x = {},
            .y = {},
            .series = {}};
  plot.x = {.label = "slope", .unit = "deg"};
  plot.y = {.label = "creep speed", .unit = "m/s", .logarithmic = true};
  plot.series.push_back({"exact", 0, {{5., 10.}, {0., 0.}}, {{5., 10.}, {0., 0.}}, {}});
  plot.series.push_back({"creeps, a lot", 1, {{5., 10.}, {1e-4, 2e-4}}, {}, {}});
  plot.series.push_back({"uphill", 2, {{5.}, {-3e-7}}, {}, {10.}});
  return plot;
}

class Figures : public ::testing::Test {
 protected:
  Figures()
      : folder_(fs::temp_directory_path() / ("hookpoint_plot's_" + std::to_string(::getpid()))) {}
  ~Figures() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST(PlotStyle, FourHundredSeriesLookDifferent) {
  std::set<std::tuple<std::string, int, Dashes>> looks;
  for (int i = 0; i < 400; ++i) {
    const SeriesStyle style = series_style(i);
    looks.emplace(style.color, style.filled_marker(), style.dashes);
    EXPECT_NE(style.dashes, predicted_dashes());
  }
  EXPECT_EQ(looks.size(), 400u);
}

/// CIELAB of "#0072B2" (sRGB, D65).
std::array<double, 3> lab_of(const std::string& color) {
  std::array<double, 3> linear{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double shown = std::stoi(color.substr(1 + 2 * i, 2), nullptr, 16) / 255.;
    linear[i] = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
  }
  const auto [r, g, b] = linear;
  const auto f = [](double t) {
    return t > 216. / 24389. ? std::cbrt(t) : (24389. / 27. * t + 16.) / 116.;
  };
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116. * y - 16., 500. * (x - y), 200. * (y - z)};
}

TEST(PlotStyle, ColoursAreFarApartAndSeenOnWhiteAndOnBlack) {
  for (int i = 0; i < style_colors; ++i) {
    const auto one = lab_of(series_style(i).color);
    EXPECT_GT(one[0], 37.) << i;
    EXPECT_LT(one[0], 73.) << i;
    for (int j = 0; j < i; ++j) {
      const auto other = lab_of(series_style(j).color);
      // A distance of 2.3 is just noticeable (Mahy et al. 1994).
      EXPECT_GT(std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]), 20.)
          << i << " " << j;
    }
  }
}

TEST(PlotData, HoldsEveryPointAsGiven) {
  EXPECT_EQ(plot_data(sample()),
            "series,kind,slope [deg],creep speed [m/s]\n"
            "exact,measured,5,0\nexact,measured,10,0\nexact,predicted,5,0\nexact,predicted,10,0\n"
            "\"creeps, a lot\",measured,5,1e-04\n\"creeps, a lot\",measured,10,2e-04\n"
            "uphill,measured,5,-3e-07\nuphill,unfinished,10,\n");
}

TEST(PlotScale, ZerosAndUnfinishedRunsHaveStripsOfTheirOwn) {
  const Layout layout = lay_out(sample());
  EXPECT_EQ(layout.strips.below_floor, std::vector<int>{0});
  EXPECT_EQ(layout.strips.unfinished, std::vector<int>{2});
  EXPECT_NEAR(layout.y.low / 1e-7, 1., 1e-9);
  EXPECT_NEAR(layout.y.high / 1e-3, 1., 1e-9);
  EXPECT_GT(layout.floor_lane(0), layout.y.range_low);
  EXPECT_LT(layout.floor_lane(0), layout.y.low);
  EXPECT_GT(layout.unfinished_lane(0), layout.y.high);
  EXPECT_LT(layout.unfinished_lane(0), layout.y.range_high);
}

TEST(PlotScale, LinearTicksAreRoundNumbers) {
  Plot plot = sample();
  plot.y.logarithmic = false;
  plot.series = {{"line", 0, {{0., 30.}, {-1., 1.}}, {}, {}}};
  EXPECT_EQ(lay_out(plot).x.ticks, "('0' 0, '5' 5, '10' 10, '15' 15, '20' 20, '25' 25, '30' 30)");
}

/// Three curves that end within a tenth of a decade, one far below, one that stops half-way.
Plot crowded() {
  Plot plot = sample();
  plot.series.clear();
  for (const double end : {1.1e-4, 1e-4, 1.2e-4, 1e-7})
    plot.series.push_back({"curve", 0, {{5., 10.}, {1e-6, end}}, {}, {}});
  plot.series.push_back({"short", 0, {{5., 6.}, {1e-6, 1e-6}}, {}, {}});
  return plot;
}

TEST(PlotLegend, StandsInTheOrderOfTheCurvesEnds) {
  const Plot plot = crowded();
  std::vector<std::size_t> order;
  std::vector<bool> leads;
  for (const LegendEntry& entry : place_legend(plot, lay_out(plot), {0., 400., 17.})) {
    order.push_back(entry.series);
    leads.push_back(entry.leads);
  }
  EXPECT_EQ(order, (std::vector<std::size_t>{2, 0, 1, 4, 3}));
  EXPECT_EQ(leads, (std::vector<bool>{true, true, true, false, true}));
}

TEST(PlotLegend, EntriesKeepTheirDistanceAndLieAsNearAsTheyCan) {
  const Plot plot = crowded();
  const Layout layout = lay_out(plot);
  const auto entries = place_legend(plot, layout, {0., 400., 17.});
  for (std::size_t i = 1; i < entries.size(); ++i)
    EXPECT_GE(entries[i - 1].height - entries[i].height, 17. - 1e-9);
  EXPECT_NEAR(entries[3].height, 400. * layout.y.fraction(1e-6), 1e-9);
  // The three that crowd are centred on the mean of their ends: least squares with fixed gaps.
  const double mean =
      400. * (layout.y.fraction(1e-4) + layout.y.fraction(1.1e-4) + layout.y.fraction(1.2e-4)) / 3.;
  EXPECT_NEAR(entries[1].height, mean, 1e-9);
}

TEST(PlotLegend, StaysInItsRoom) {
  const Plot plot = crowded();
  const auto entries = place_legend(plot, lay_out(plot), {10., 90., 20.});
  EXPECT_NEAR(entries.front().height, 90., 1e-9);
  EXPECT_NEAR(entries.back().height, 10., 1e-9);
}

TEST(PlotScale, AnEmptyOrConstantPlotStillHasAxes) {
  Plot plot = sample();
  plot.series.clear();
  EXPECT_LT(lay_out(plot).x.range_low, lay_out(plot).x.range_high);
  plot.series = {{"constant", 0, {{1., 1.}, {2., 2.}}, {}, {}}};
  EXPECT_LT(lay_out(plot).x.range_low, lay_out(plot).x.range_high);
  EXPECT_LT(lay_out(plot).y.range_low, lay_out(plot).y.range_high);
}

TEST_F(Figures, AreTheSameBytesEachTime) {
  const PlotOutcome first = draw(sample(), folder_);
  ASSERT_TRUE(first.drawn) << first.message;
  const PlotOutcome second = draw(sample(), folder_);
  EXPECT_EQ(first.svg, second.svg);
  EXPECT_EQ(count(first.svg, "</svg>"), 1u);
  for (const char* name : {"creep.csv", "creep.gp", "creep.svg"})
    EXPECT_TRUE(fs::exists(folder_ / name));
}

// A Plot in a loop is called `creep[1]`.
TEST_F(Figures, MayHaveANameWithAnIndex) {
  Plot plot = sample();
  plot.name = "creep[1]";
  const PlotOutcome outcome = draw(plot, folder_);
  EXPECT_TRUE(outcome.drawn) << outcome.message;
  EXPECT_TRUE(fs::exists(folder_ / "creep[1].svg"));
}

TEST_F(Figures, DrawEveryPoint) {
  const PlotOutcome outcome = draw(sample(), folder_);
  ASSERT_TRUE(outcome.drawn) << outcome.message;
  // Circle of `exact`, hollow: two zeros in the strip and the legend's note; filled only in the
  // legend.
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt5' transform"), 3u);
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt6' transform"), 1u);
  // Square of `creeps`: two points and the legend.
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt4' transform"), 3u);
  // Cross: the unfinished run and the legend.
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt1' transform"), 2u);
}

/// Two panels: a curve that one lacks, and a line that the other lacks.
PanelPlot two_panels() {
  PanelPlot panels{.name = "panels", .title = "Two", .subtitle = "", .panels = {}};
  Plot first = sample();
  first.title = "dt = 1 ms, mu = 1";
  first.series = {{"ours", 0, {{5., 10.}, {1e-4, 1e-3}}, {}, {}}, {"theirs", 1, {}, {}, {}}};
  first.series.push_back({"rigid", 0, {}, {{5., 10.}, {2e-4, 2e-4}}, {}, true});
  Plot second = first;
  second.title = "dt = 2 ms, mu = 1";
  second.series[1].measured = {{5., 20.}, {1e-7, 2e-7}};
  second.series[2].predicted = {};
  panels.panels = {first, second};
  return panels;
}

TEST(PlotData, OfPanelsNamesThePanel) {
  EXPECT_EQ(panel_data(two_panels()),
            "series,kind,slope [deg],creep speed [m/s],panel\n"
            "ours,measured,5,1e-04,\"dt = 1 ms, mu = 1\"\n"
            "ours,measured,10,0.001,\"dt = 1 ms, mu = 1\"\n"
            "rigid,reference,5,2e-04,\"dt = 1 ms, mu = 1\"\n"
            "rigid,reference,10,2e-04,\"dt = 1 ms, mu = 1\"\n"
            "ours,measured,5,1e-04,\"dt = 2 ms, mu = 1\"\n"
            "ours,measured,10,0.001,\"dt = 2 ms, mu = 1\"\n"
            "theirs,measured,5,1e-07,\"dt = 2 ms, mu = 1\"\n"
            "theirs,measured,20,2e-07,\"dt = 2 ms, mu = 1\"\n");
}

TEST(PlotScript, PanelsShareTheirAxesUnlessTheyHaveTheirOwn) {
  PanelPlot panels = two_panels();
  const std::string same = panel_script(panels);
  EXPECT_EQ(count(same, "set xrange [4.4:20.6]"), 2u);
  EXPECT_EQ(count(same, "set yrange [1e-07:0.001]"), 2u);
  panels.own_axes = true;
  const std::string own = panel_script(panels);
  EXPECT_EQ(count(own, "set xrange [4.4:20.6]"), 2u);
  EXPECT_EQ(count(own, "set yrange [1e-04:0.001]"), 1u);
  EXPECT_EQ(count(own, "set yrange [1e-07:0.001]"), 1u);
}

TEST_F(Figures, PanelsAreDrawnWithOneLegend) {
  const PlotOutcome outcome = draw(two_panels(), folder_);
  ASSERT_TRUE(outcome.drawn) << outcome.message;
  // Circles of `ours`: two points a panel and the legend; squares of `theirs`: in one panel only.
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt6' transform"), 5u);
  EXPECT_EQ(count(outcome.svg, "<use xlink:href='#gpPt4' transform"), 3u);
  EXPECT_EQ(count(outcome.svg, ">rigid<"), 1u);
  EXPECT_EQ(count(outcome.svg, "dt = 2 ms"), 1u);
  EXPECT_EQ(count(inline_svg(outcome.svg, "p", "").value(), "rgb(  0,   0,   0)"), 0u);
}

/// Text that would be a command if a line of gnuplot's could end in it, or a shell read it.
std::string hostile(const fs::path& mark) {
  const std::string command = "touch " + mark.string();
  return "x'\nsystem(\"" + command + "\")\n#\r`" + command + "`$(" + command + ")\"; !" + command +
         "\n!" + command + "\n@" + command + "\\";
}

TEST_F(Figures, NoTextIsACommand) {
  const fs::path mark = folder_ / "stolen";
  Plot plot = sample();
  plot.title = plot.subtitle = plot.x.label = plot.x.unit = hostile(mark);
  plot.y.label = plot.y.unit = plot.series[0].label = plot.title;
  const PlotOutcome outcome = draw(plot, folder_);
  EXPECT_TRUE(outcome.drawn) << outcome.message;
  EXPECT_FALSE(fs::exists(mark));
  PanelPlot panels = two_panels();
  for (Plot& panel : panels.panels) panel.title = hostile(mark);
  panels.title = panels.subtitle = hostile(mark);
  EXPECT_TRUE(draw(panels, folder_).drawn);
  EXPECT_FALSE(fs::exists(mark));
}

TEST_F(Figures, ANameThatIsACommandIsRefused) {
  for (const std::string name : {"< touch stolen", "| touch stolen", "../away", "a\nb", ""}) {
    Plot plot = sample();
    plot.name = name;
    EXPECT_THROW(draw(plot, folder_), FileError) << name;
  }
}

TEST_F(Figures, AProgramInTheFolderOfResultsIsNotRun) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "gnuplot") << "#!/bin/sh\ntouch stolen\n";
  fs::permissions(folder_ / "gnuplot", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (".::" + path).c_str(), 1);
  EXPECT_TRUE(draw(sample(), folder_).drawn);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(folder_ / "stolen"));
}

TEST_F(Figures, AMissingGnuplotIsSaidAndLeavesDataAndScript) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const PlotOutcome outcome = draw(sample(), folder_);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(outcome.drawn);
  EXPECT_NE(outcome.message.find("gnuplot is not installed"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "creep.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "creep.svg"));
}

TEST_F(Figures, InsideAPageKeepTheirIdsApart) {
  const PlotOutcome outcome = draw(sample(), folder_);
  ASSERT_TRUE(outcome.drawn) << outcome.message;
  const std::string inlined = inline_svg(outcome.svg, "creep", "speed < \"0\" & more").value();
  EXPECT_EQ(inlined.rfind("<svg role=\"img\" "
                          "aria-label=\"speed &lt; &quot;0&quot; &amp; more\"",
                          0),
            0u)
      << inlined.substr(0, 100);
  EXPECT_EQ(count(inlined, "\"#gp"), 0u);
  EXPECT_EQ(count(inlined, "id=\"gp"), 0u);
  EXPECT_EQ(count(inlined, "href="), count(inlined, "href=\"#creep-gp"));
  EXPECT_GT(count(inlined, "href="), 10u);
  EXPECT_EQ(count(inlined, "black"), 0u);
  EXPECT_EQ(count(inlined, "#ffffff"), 0u);
  EXPECT_EQ(count(inlined, "<text"), count(outcome.svg, "<text"));
}

TEST_F(Figures, WhatIsNoDrawingGoesIntoNoPage) {
  for (const char* text : {"", "creep", "<svg", "<svg><g></svg>", "<html></html>"})
    EXPECT_FALSE(inline_svg(text, "creep", "")) << text;
}

}  // namespace
}  // namespace hookpoint::output
