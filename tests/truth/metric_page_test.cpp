// docs/adding_a_metric.md: the metric that it adds is compiled from the page, and measures and
// predicts what the page says: cos(slope) of a block at rest, 2 of one that undamped springs catch.
// ctest: alone
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"
#include "tests/support/metric_scene.h"
#include "tests/support/run_text.h"

namespace hookpoint::studies {

std::span<const MetricDefinition> load_metrics();

namespace {

const MetricDefinition& load_factor() { return load_metrics().front(); }

/// A box of 2 kg on four corners: `start` of its base, on a ground of `angle` [deg] and `damping`.
std::string block(const std::string& start, double angle, double damping) {
  return "World w { gravity = 9.81; deltat = 20 us; contact = hookpoint; Material m { "
         "normal_stiffness = 20 kN/m; normal_damping = " +
         std::to_string(damping) +
         "; static_friction = 0.8; kinetic_friction = 0.7; } Terrain.Slope s { angle = " +
         std::to_string(angle) + " deg; material = m; } Robot b { Base.mobile { " + start +
         " Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 2 kg; } } } }";
}

double measured(const simulation::Experiment& experiment, double settle, double duration) {
  const RunContext context = make_context(experiment, settle, duration);
  const auto metric = load_factor().make(context);
  Observer observer(context, load_factor().needs.points);
  simulation::World world(experiment, simulation::make_dts(experiment));
  if (load_factor().needs.contact_force) world.publish_contact_forces();
  metric->observe(observer.observe(world.state()));
  for (long step = 0; step < std::lround(duration / experiment.deltat); ++step) {
    EXPECT_TRUE(world.step().ok());
    metric->observe(observer.observe(world.state()));
  }
  return metric->value().value();
}

TEST(MetricOfThePage, MeasuresAndPredictsTheCosineOfTheSlopeAtRest) {
  for (const double angle : {0., 10., 25.}) {
    SCOPED_TRACE(angle);
    const Loaded loaded = load_text(block("rest_on = s;", angle, 100.));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const double expected = std::cos(angle * std::numbers::pi / 180.);
    const RunContext context = make_context(*loaded.experiment, 0.02, 0.1);
    const Prediction predicted = load_factor().predict(context, {});
    ASSERT_TRUE(predicted) << predicted.why();
    EXPECT_NEAR(*predicted, expected, 1e-12);
    EXPECT_NEAR(measured(*loaded.experiment, 0.02, 0.1), expected, 1e-9);
  }
}

// A mass that a slack spring catches at rest goes as far past its balance as it began above it:
// m g - k d = -m g at the end, so that the spring then bears 2 m g.
TEST(MetricOfThePage, MeasuresTwiceTheWeightOnSlackUndampedSprings) {
  const Loaded loaded = load_text(block("location = 0, 0, 0.05;", 0., 0.));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_NEAR(measured(*loaded.experiment, 0., 0.1), 2., 1e-4);
  const Prediction none = load_factor().predict(make_context(*loaded.experiment, 0., 0.1), {});
  EXPECT_NE(none.why().find("settle = 0"), std::string::npos) << none.why();
}

TEST(MetricOfThePage, PredictsNothingOfABlockThatSlides) {
  const Loaded loaded = load_text(block("rest_on = s;", 45., 100.));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_FALSE(load_factor().predict(make_context(*loaded.experiment, 0.02, 0.1), {}));
}

TEST(MetricOfThePage, TakesTheLargestLoadAfterSettling) {
  const simulation::Experiment experiment = testing::block_on_slope(0.3, 0.);
  const RunContext context = make_context(experiment, 0.05, 0.1);
  const auto metric = load_factor().make(context);
  Observer observer(context, false);
  simulation::WorldState world;
  world.bodies.resize(1);
  // 1 kg: twice the weight before `settle`, half of it and 1.5 times after.
  const double loads[] = {2., 2., 2., 2., 2., 0.5, 1.5, 0.5};
  for (int step = 0; step < 8; ++step) {
    world.step = step;
    world.time = step * experiment.deltat;
    world.bodies[0].position = context.start;
    world.bodies[0].orientation = experiment.robots[0].orientation;
    world.bodies[0].contact_force = loads[step] * context.weight * context.normal;
    metric->observe(observer.observe(world));
  }
  EXPECT_NEAR(*metric->value(), 1.5, 1e-12);
}

TEST(MetricOfThePage, NeedsWhatItReads) {
  EXPECT_TRUE(load_factor().needs.contact_force);
  EXPECT_FALSE(load_factor().needs.points);
}

// A row without a place, a place without a row, a name twice.
TEST(MetricTable, HasARowForEachNameOfItsOrder) {
  std::vector<std::string_view> names;
  for (const MetricDefinition& metric : metric_table()) names.push_back(metric.name);
  EXPECT_EQ(names, std::vector(metric_order().begin(), metric_order().end()));
}

// What fills a value: a class for a run, a function of processor time.
TEST(MetricTable, HasTheFunctionsOfEachScope) {
  for (const MetricDefinition& metric : metric_table()) {
    SCOPED_TRACE(metric.name);
    EXPECT_EQ(metric.make != nullptr,
              metric.scope == MetricScope::run || metric.scope == MetricScope::sweep);
    EXPECT_EQ(metric.of_step_time != nullptr, metric.timing());
  }
}

}  // namespace
}  // namespace hookpoint::studies
