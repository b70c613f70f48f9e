// The distance of a run from its own limit, where the limit is known: semi-implicit Euler falls g t
// dt/2 too far, so that its self error is that of an eighth of the step less than that of the
// whole.
#include <gtest/gtest.h>

#include "reference/engines.h"
#include "reference/ode/engine.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "studies/measure/metric.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

constexpr const char* falling = R"(
World w { gravity = 9.81; Robot r { Base.mobile { mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; } } }
)";

constexpr const char* over_ground = R"(
World w {
  gravity = 9.81;
  Material stone {}
  Terrain.Flat ground { material = stone; }
  Robot r { Base.mobile { location = 0, 0, 20; Shape.Sphere { radius = 0.1; mass = 1 kg; } } }
}
)";

std::optional<double> measure(const char* name, simulation::Experiment experiment,
                              simulation::EngineFactory make, double deltat) {
  experiment.deltat = deltat;
  studies::RunContext context = studies::make_context(experiment, 0., 1.);
  context.make = make;
  const auto metric = studies::find_metric(name)->make(context);
  studies::Observer observer(context, false);
  simulation::World world(experiment, make(experiment));
  metric->observe(observer.observe(world.state()));
  for (int i = 0; i < std::lround(1. / deltat); ++i) {
    EXPECT_TRUE(world.step().ok());
    metric->observe(observer.observe(world.state()));
  }
  return metric->value();
}

std::optional<double> measure(const char* name, simulation::Experiment experiment,
                              const std::string& integrator, double deltat) {
  experiment.integrator = integrator;
  return measure(name, std::move(experiment), simulation::make_dts, deltat);
}

TEST(SelfError, IsTheDistanceFromTheLimitOfSmallSteps) {
  const simulation::Experiment experiment = *load_text(falling).experiment;
  for (const double deltat : {0.01, 0.005}) {
    const double whole = 9.81 * 1. * deltat / 2.;
    EXPECT_NEAR(measure("self_error", experiment, "semi_implicit_euler", deltat).value(),
                whole * 7. / 8., 1e-12);
    EXPECT_NEAR(measure("reference_error", experiment, "semi_implicit_euler", deltat).value(),
                whole, 1e-9);
  }
  EXPECT_LE(measure("self_error", experiment, "rk4", 0.01).value(), 1e-13);
  EXPECT_LE(measure("self_error", experiment, "arkode", 0.01).value(), 1e-9);
}

TEST(ReferenceError, IsThatOfAPeerTooWhereNothingTouches) {
  simulation::Experiment experiment = *load_text(falling).experiment;
  // ODE's step is semi-implicit Euler's, too.
  experiment.engine = "ode";
  EXPECT_NEAR(measure("reference_error", experiment, reference::ode_peer.make, 0.01).value(),
              9.81 * 0.01 / 2., 1e-9);
  experiment = *load_text(over_ground).experiment;
  experiment.engine = "ode";
  EXPECT_FALSE(measure("reference_error", experiment, reference::ode_peer.make, 0.01));
}

TEST(IntegratorMetrics, CountWhatFixedStepsCost) {
  const simulation::Experiment experiment = *load_text(falling).experiment;
  EXPECT_EQ(measure("evaluations", experiment, "rk4", 0.01), 400.);
  EXPECT_EQ(measure("evaluations", experiment, "explicit_euler", 0.01), 100.);
  EXPECT_EQ(measure("integrator_steps", experiment, "rk4", 0.01), 100.);
  EXPECT_EQ(measure("rejected_steps", experiment, "rk4", 0.01), 0.);
}

}  // namespace
}  // namespace hookpoint
