// A step that fails leaves nothing behind: what a saved state holds, what is published and what the
// integration has cost are those before it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "simulation/analysis/advice_constants.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using simulation::Engine;
using simulation::WorldState;

std::vector<double> saved(Engine& engine) {
  std::vector<double> numbers(engine.resumable()->state_size());
  engine.resumable()->save(numbers);
  return numbers;
}

/// A robot that goes on, and after it in the file one on which a force grows beyond all bounds.
std::string scene(const std::string& settings, const std::string& legs) {
  return "World w { gravity = 9.81; deltat = 5 ms; " + settings + R"(
  Material m { normal_stiffness = 20 kN/m; kinetic_friction = 0.5; static_friction = 0.5; }
  Terrain.Flat ground { material = m; }
  Robot first { Base.mobile { location = 0, 0, 0.13; velocity = 0.3, 0, -1; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1; } })" +
         legs + R"( }
  Robot second { Base.mobile { location = 1, 0, 0.13; velocity = 0.3, 0, -1; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1; } })" +
         legs + R"( }
  Force push { body = second.base; } })";
}

void expect_untouched(const std::string& settings, const std::string& legs) {
  SCOPED_TRACE(settings + legs);
  const Loaded loaded = load_text(scene(settings, legs));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto engine = simulation::make_dts(*loaded.experiment);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(engine->step().ok());
  const std::vector<double> before = saved(*engine);
  const WorldState published = engine->state();
  engine->inputs().forces[0].force.x = 1e308;
  engine->inputs().forces[0].torque.x = 1e308;
  ASSERT_FALSE(engine->step().ok());
  EXPECT_EQ(saved(*engine), before);
  const WorldState& now = engine->state();
  EXPECT_EQ(now.step, published.step);
  EXPECT_EQ(now.notices, published.notices);
  EXPECT_EQ(now.integrator.evaluations, published.integrator.evaluations);
  EXPECT_EQ(now.bodies[0].contact_force, published.bodies[0].contact_force);
  // And it goes on as if nothing had been tried.
  const auto other = simulation::make_dts(*loaded.experiment);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(other->step().ok());
  engine->inputs().forces[0] = {};
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(engine->step().ok());
    ASSERT_TRUE(other->step().ok());
    EXPECT_EQ(saved(*engine), saved(*other));
    EXPECT_EQ(engine->state().bodies.back().contact_force,
              other->state().bodies.back().contact_force);
  }
}

TEST(FailedStep, LeavesNothingBehind) {
  const std::string leg =
      "Chain c { Link l { dhlength = 0.1; mass = 0.1; center_of_mass = 0.05, 0, 0; inertia = 1e-4, "
      "1e-4, 1e-4, 0, 0, 0; friction = 0.02; } }";
  for (const std::string settings :
       {"", "integrator = rk4;", "integrator = cvode_bdf;", "integrator = arkode_imex;",
        "contact = impulse;", "contact = impulse_reversal;"}) {
    expect_untouched(settings, "");
    expect_untouched(settings, leg);
  }
}

TEST(Names, ThatDoNotExistAreErrors) {
  EXPECT_STREQ(simulation::field_named("static_friction").name, "static_friction");
  EXPECT_THROW(simulation::field_named("static_fricton"), std::logic_error);
  Loaded loaded = load_text(scene("contact = impulse;", ""));
  loaded.experiment->contact = "implse";
  EXPECT_THROW(simulation::make_dts(*loaded.experiment), simulation::ExperimentError);
}

}  // namespace
}  // namespace hookpoint
