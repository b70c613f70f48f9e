// From a study's rows to a map, on the made-up study whose numbers are formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "studies/report/figures.h"
#include "tests/support/synthetic_study.h"

namespace hookpoint::studies {
namespace {

using output::HeatMapCell;
using output::HeatMapPanel;

/// Creep over slope (6 values) and step (3), the closed form as the line.
output::HeatMap creep_map(StudyResult study) {
  PlotSpec spec = testing::synthetic_plot("map", "Creep", "slope", "deg");
  spec.y = "dt";
  spec.y_unit = "ms";
  spec.color = spec.outline = "creep_speed";
  spec.color_unit = "m/s";
  study.plots = {spec};
  const Figure figure = make_figure(study, 0);
  EXPECT_EQ(figure.plot.name, "map");
  return *figure.map;
}

const HeatMapCell& cell(const HeatMapPanel& panel, std::size_t column, std::size_t row) {
  return panel.cells.at(6 * row + column);
}

TEST(StudyMap, ACellForEachPairOfValuesAndAPanelForEachSubject) {
  const output::HeatMap map = creep_map(testing::synthetic_study());
  EXPECT_EQ(map.x_values, (std::vector{5., 10., 15., 20., 25., 30.}));
  EXPECT_EQ(map.y_values, (std::vector{0.1, 1., 10.}));
  ASSERT_EQ(map.panels.size(), 5U);  // the sixth is not installed
  EXPECT_EQ(map.panels[1].title, "dts impulse");
  const double form = testing::synthetic_creep(20.);
  EXPECT_DOUBLE_EQ(*cell(map.panels[1], 3, 2).value, 1.002 * form);
  EXPECT_DOUBLE_EQ(*cell(map.panels[1], 3, 2).predicted, form);
  EXPECT_DOUBLE_EQ(*cell(map.panels[3], 0, 2).value, -3.1e-7 * 10.);
}

TEST(StudyMap, AStoppedRunHasNoValueButItsCell) {
  const output::HeatMap map = creep_map(testing::synthetic_study());
  EXPECT_TRUE(cell(map.panels[4], 0, 2).run);
  EXPECT_FALSE(cell(map.panels[4], 0, 2).value);
  EXPECT_TRUE(cell(map.panels[4], 0, 1).value);
}

TEST(StudyMap, DrawsOnlyTheSubjectsThatItsBlockNames) {
  StudyResult study = testing::synthetic_study();
  PlotSpec spec = testing::synthetic_plot("map", "Creep", "slope", "deg");
  spec.y = "dt";
  spec.color = "creep_speed";
  spec.subjects = {1};
  study.plots = {spec};
  const Figure figure = make_figure(study, 0);
  ASSERT_EQ(figure.map->panels.size(), 1U);
  EXPECT_EQ(figure.map->panels[0].title, "dts impulse");
}

TEST(StudyMap, SmallNumbersGetAUnitThatACellCanShow) {
  StudyResult study = testing::synthetic_study();
  PlotSpec spec = testing::synthetic_plot("map", "Depth", "slope", "deg");
  spec.y = "dt";
  spec.color = "penetration_max";
  spec.color_unit = "m";
  spec.log_y = false;
  study.plots = {spec};
  const Figure small = make_figure(study, 0);
  EXPECT_EQ(small.map->color.unit, "um");
  EXPECT_NEAR(*cell(small.map->panels[0], 0, 0).value, 12.26 * std::cos(5. / 57.3), 1e-12);
  study.plots[0].log_y = true;  // a logarithmic colour shows any number
  EXPECT_EQ(make_figure(study, 0).map->color.unit, "m");
  for (RunResult& row : study.rows)
    if (row.metrics[1].measured) *row.metrics[1].measured *= 1e4;  // to 0.12 m
  study.plots[0].log_y = false;
  EXPECT_EQ(make_figure(study, 0).map->color.unit, "m");
  *study.rows[0].metrics[1].measured = 0.0123;  // five signs: too wide beside the others
  study.plots[0].color_unit = "m/s";
  const Figure mixed = make_figure(study, 0);
  EXPECT_EQ(mixed.map->color.unit, "mm/s");
  EXPECT_DOUBLE_EQ(*cell(mixed.map->panels[0], 0, 0).value, 12.3);
  for (const char* unit : {"m^2", "1/s", "kg", ""}) {
    study.plots[0].color_unit = unit;
    EXPECT_EQ(make_figure(study, 0).map->color.unit, unit);
  }
}

TEST(StudyMap, DrawsOnlyWhatItsBlockNames) {
  StudyResult study = testing::synthetic_study();
  PlotSpec spec = testing::synthetic_plot("map", "Creep", "slope", "deg");
  spec.y = "dt";
  spec.color = "creep_speed";
  spec.where = {{"slope", {10., 20.}}};
  study.plots = {spec};
  const Figure figure = make_figure(study, 0);
  ASSERT_EQ(figure.map->panels[1].cells.size(), 6U);
  EXPECT_DOUBLE_EQ(*figure.map->panels[1].cells[3].value, 1.002 * testing::synthetic_creep(20.));
}

}  // namespace
}  // namespace hookpoint::studies
