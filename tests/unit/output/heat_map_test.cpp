#include "output/figures/heat_map.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/text.h"

namespace hookpoint::output {
namespace {

using testing::count;

/// Two columns, three rows: a value each but one that stopped and one that was not run; the closed
/// form differs between the columns of the upper two rows.
HeatMap sample() {
  HeatMap map;
  map.name = "map";
  map.title = "It's a map of a_b";
  map.x = {.label = "delay", .unit = "ms"};
  map.y = {.label = "rate", .unit = "Hz"};
  map.color = {.label = "walking speed", .unit = "m/s"};
  map.x_values = {0., 20.};
  map.y_values = {50., 100., 1000.};
  map.panels.push_back({"joint loops",
                        {{true, 0.25, 0.},
                         {false, {}, {}},
                         {true, 0.5, 0.},
                         {true, {}, 1.},
                         {true, 0.75, 0.},
                         {true, 1., 1.}}});
  return map;
}

TEST(HeatMapData, ARowForEveryRunInOrder) {
  EXPECT_EQ(heat_map_data(sample()),
            "panel,delay [ms],rate [Hz],walking speed [m/s],column,row\n"
            "joint loops,0,50,0.25,0,0\n"
            "joint loops,0,100,0.5,0,1\n"
            "joint loops,20,100,,1,1\n"
            "joint loops,0,1000,0.75,0,2\n"
            "joint loops,20,1000,1,1,2\n");
}

TEST(HeatMapScript, TheLineGoesBetweenCellsWhoseClosedFormsDiffer) {
  const std::string script = heat_map_script(sample());
  EXPECT_EQ(count(script, "set arrow from"), 2U);
  EXPECT_NE(script.find("from 0.5,0.5 to 0.5,1.5"), std::string::npos);
  EXPECT_NE(script.find("from 0.5,1.5 to 0.5,2.5"), std::string::npos);
  HeatMap turned = sample();
  std::swap(turned.x_values, turned.y_values);  // now three columns and two rows
  EXPECT_NE(heat_map_script(turned).find("from -0.5,0.5 to 0.5,0.5"), std::string::npos);
}

TEST(HeatMapScript, ExplainsOnlyWhatIsThere) {
  HeatMap map = sample();
  EXPECT_NE(heat_map_script(map).find("Dashed: closed form"), std::string::npos);
  EXPECT_NE(heat_map_script(map).find("no value"), std::string::npos);
  for (HeatMapCell& cell : map.panels[0].cells) cell = {true, 1., {}};
  EXPECT_EQ(heat_map_script(map).find("Dashed"), std::string::npos);
  EXPECT_EQ(heat_map_script(map).find("no value"), std::string::npos);
}

/// 200 x 100 cells, one without a run and one without a value.
HeatMap large() {
  HeatMap map = sample();
  map.x_values.resize(200);
  map.y_values.resize(100);
  map.panels[0].cells.assign(std::size_t{200} * 100, {true, 1., {}});
  for (std::size_t i = 0; i < map.panels[0].cells.size(); ++i)
    map.panels[0].cells[i].value = static_cast<double>(i % 200);
  map.panels[0].cells[17] = {};
  map.panels[0].cells[42] = {true, {}, {}};
  return map;
}

TEST(HeatMapScript, VeryManyCellsAreOnePictureWithFewTicks) {
  const HeatMap map = large();
  EXPECT_TRUE(crowded(map));
  EXPECT_FALSE(crowded(sample()));
  EXPECT_EQ(count(heat_map_data(map), "\n"), 200U * 100U + 1U);  // a picture has no holes
  const std::string script = heat_map_script(map);
  EXPECT_EQ(script.find("boxxyerror"), std::string::npos);
  EXPECT_EQ(script.find("labels"), std::string::npos);
  EXPECT_NE(script.find("White: no value"), std::string::npos);
  EXPECT_EQ(script.find("×"), std::string::npos);
  const std::size_t ticks = script.find("xtics nomirror");
  EXPECT_LT(count(script.substr(ticks, script.find('\n', ticks) - ticks), "'"), 2U * 13U);
}

TEST(HeatMapScript, ALogarithmicColourBeginsAtItsFloor) {
  HeatMap map = sample();
  map.panels[0].cells[0].value = 1e-16;
  EXPECT_EQ(heat_map_script(map).find("logscale cb"), std::string::npos);
  map.color.logarithmic = true;
  map.color.floor = 1e-9;
  const std::string script = heat_map_script(map);
  EXPECT_NE(script.find("logscale cb"), std::string::npos);
  EXPECT_NE(script.find("set cbrange [1e-09:1]"), std::string::npos);
  EXPECT_NE(script.find("shade(v) = v < 1e-09 ? 1e-09 : v"), std::string::npos);
}

TEST(HeatMapScript, CellsAreAsWideAsTheirNumbersAndTicksAsk) {
  HeatMap map = sample();
  const auto width = [&] {
    const std::string script = heat_map_script(map);
    const auto at = script.find("svg size ") + 9;
    return std::stod(script.substr(at, script.find(',', at) - at));
  };
  const double narrow = width();
  map.panels[0].cells[0].value = -0.0766;  // four digits more than 0.25 and a sign
  EXPECT_GE(width(), narrow + 2. * 5.);
  map.panels[0].cells[0].value = 0.25;
  map.x_values[0] = 0.09487;
  EXPECT_GE(width(), narrow + 2. * 15.);
}

// Names that would make the drawing too wide side by side stand upright below their columns.
TEST(HeatMapScript, ManyLongNamesStandUpright) {
  HeatMap map = sample();
  map.x.names = {"mujoco_3_14_recommended", "ode_quickstep_default"};
  map.x_values = {0., 1.};
  EXPECT_EQ(heat_map_script(map).find("rotate"), std::string::npos) << "two have room";
  for (int i = 2; i < 40; ++i) {
    map.x.names.push_back("bullet_recommended");
    map.x_values.push_back(i);
  }
  map.panels[0].cells.resize(40 * map.y_values.size());
  EXPECT_NE(heat_map_script(map).find("set xtics nomirror rotate"), std::string::npos);
}

// The blue of the greatest is that of the least where less is better.
TEST(HeatMapScript, TheBetterEndIsBlue) {
  HeatMap map = sample();
  EXPECT_NE(heat_map_script(map).find("(0 '#f6b26b'"), std::string::npos);
  map.less_is_better = true;
  EXPECT_NE(heat_map_script(map).find("(0 '#7fb8e6'"), std::string::npos);
}

TEST(HeatMapScript, PanelsThatDoNotFitSideBySideStandInRows) {
  HeatMap map = sample();
  // 92 px each and 40 between them: 12 in the 1580 px beside the margins.
  for (int i = 1; i < 13; ++i) map.panels.push_back(map.panels[0]);
  const std::string script = heat_map_script(map);
  EXPECT_NE(script.find("svg size 1764,524 "), std::string::npos) << script.substr(0, 300);
  EXPECT_EQ(count(script, "set ytics scale 0 nomirror ("), 2U);
  EXPECT_EQ(count(script, "unset colorbox"), 12U);
  EXPECT_EQ(count(heat_map_script(sample()), "set ytics scale 0 nomirror ("), 1U);
}

TEST(HeatMap, IsDrawnWithItsNumbersAndItsCross) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("hookpoint_map_" + std::to_string(getpid()));
  const PlotOutcome outcome = draw(sample(), folder);
  ASSERT_TRUE(outcome.drawn) << outcome.message;
  for (const char* text : {"It's a map of a_b", "joint loops", "0.25", "0.75", "walking speed"})
    EXPECT_NE(outcome.svg.find(text), std::string::npos) << text;
  HeatMap without = sample();
  without.panels[0].cells[3].value = 0.6;
  const PlotOutcome other = draw(without, folder);
  EXPECT_NE(other.svg.find("0.6"), std::string::npos);
  EXPECT_EQ(outcome.svg.find(">0.6<"), std::string::npos);
  // A run without a value has no coloured cell.
  EXPECT_EQ(count(other.svg, "<polygon"), count(outcome.svg, "<polygon") + 1);
  HeatMap many = large();
  for (const bool logarithmic : {false, true}) {
    many.color.logarithmic = logarithmic;
    many.color.floor = 1e-3;
    const PlotOutcome picture = draw(many, folder);
    ASSERT_TRUE(picture.drawn) << picture.message;
    EXPECT_EQ(count(picture.svg, "<image"), 1U);
    EXPECT_LT(picture.svg.size(), 200'000U);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace hookpoint::output
