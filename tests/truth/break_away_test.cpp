// A point that is pulled along the ground until static friction no longer holds it, and slides on
// under kinetic friction: closed form, adaptive integrators within their tolerance, random cases.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "contact/force_law.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/drawn.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

struct Case {
  double mass, stiffness, damping_ratio, static_friction, kinetic_friction;
  double pull;      ///< over mu_s m g, more than 1
  double duration;  ///< of the slide, over the way to the break-away
};

Case any_case(std::mt19937_64& random) {
  const auto number = [&](double low, double high) {
    return test_support::drawn(random, low, high);
  };
  Case drawn{};
  drawn.mass = number(0.5, 5.);
  drawn.stiffness = number(2e3, 5e4);
  drawn.damping_ratio = number(0., 0.3);
  drawn.kinetic_friction = number(0.2, 0.6);
  drawn.static_friction = drawn.kinetic_friction + number(0.05, 0.4);
  drawn.pull = number(1.05, 1.6);
  drawn.duration = number(1.5, 4.);
  return drawn;
}

/// Sticking, m x'' + c x' + k x = F from rest at 0 (its spring unbent): x and x' at `t`.
struct Motion {
  double x, v;
};
Motion sticking(const Case& drawn, double t) {
  const double w = std::sqrt(drawn.stiffness / drawn.mass), z = drawn.damping_ratio;
  const double shift = drawn.pull * drawn.static_friction * drawn.mass * g / drawn.stiffness;
  const double damped = w * std::sqrt(1. - z * z), decay = std::exp(-z * w * t);
  const double sine = std::sin(damped * t), cosine = std::cos(damped * t);
  return {shift * (1. - decay * (cosine + z * w / damped * sine)),
          shift * decay * (w * w / damped) * sine};
}

/// When k x + c x' first is mu_s m g.
double break_away(const Case& drawn) {
  const double w = std::sqrt(drawn.stiffness / drawn.mass);
  const double c = 2. * drawn.damping_ratio * drawn.mass * w;
  const auto left = [&](double t) {
    const Motion motion = sticking(drawn, t);
    return drawn.static_friction * drawn.mass * g - drawn.stiffness * motion.x - c * motion.v;
  };
  double low = 0., high = 1e-3 / w;
  while (left(high) > 0.) low = high, high += 1e-3 / w;
  for (int i = 0; i < 100; ++i) (left(0.5 * (low + high)) > 0. ? low : high) = 0.5 * (low + high);
  return low;
}

simulation::Experiment pulled_point(const Case& drawn, const std::string& law) {
  Loaded loaded = load_text(R"(
World w {
  gravity = 9.81;
  Material m { normal_damping = 0; }
  Terrain.Flat ground { material = m; }
  Robot r { Base.mobile { mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; ContactPoint p { location = 0, 0, 0; } } }
  Force pull { body = r.base; force = 0, 0, 0; }
}
)");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  simulation::Experiment experiment = *loaded.experiment;
  experiment.contact = law;
  const double weight = drawn.mass * g;
  for (simulation::MaterialSpec& material : experiment.materials) {
    auto& constants = material.constants;
    constants.tangential_stiffness = drawn.stiffness;
    constants.tangential_damping =
        2. * drawn.damping_ratio * std::sqrt(drawn.stiffness * drawn.mass);
    constants.static_friction = drawn.static_friction;
    constants.kinetic_friction = drawn.kinetic_friction;
    constants.normal_stiffness = 1e6;
    constants.nominal_stiffness = 1e6;
  }
  simulation::RobotSpec& robot = experiment.robots[0];
  robot.base.mass.mass = drawn.mass;
  const auto& constants = experiment.materials[0].constants;
  robot.location.z = -contact::find_force_law(law)->static_depth(weight, constants);
  return experiment;
}

TEST(BreakAway, IsOnTimeUnderEveryAdaptiveIntegrator) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10})
    for (const char* integrator : {"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
      std::mt19937_64 random(20);
      for (int i = 0; i < 30; ++i) {
        const Case drawn = any_case(random);
        const char* law = std::array{"hookpoint", "nominal", "azad_featherstone"}[i % 3];
        simulation::Experiment experiment = pulled_point(drawn, law);
        experiment.integrator = integrator;
        experiment.relative_tolerance = tolerance;
        experiment.absolute_tolerance = 1e-2 * tolerance;
        const double breaks = break_away(drawn);
        const double slides = drawn.duration * breaks;
        experiment.deltat = breaks + slides;
        const auto engine = simulation::make_dts(experiment);
        const double pull = drawn.pull * drawn.static_friction * drawn.mass * g;
        engine->inputs().forces.at(0).force = {pull, 0., 0.};
        const simulation::StepStatus status = engine->step();
        ASSERT_TRUE(status.ok()) << integrator << " " << status.advice;
        const Motion at_break = sticking(drawn, breaks);
        const double acceleration = pull / drawn.mass - drawn.kinetic_friction * g;
        const double x = at_break.x + at_break.v * slides + 0.5 * acceleration * slides * slides;
        EXPECT_NEAR(engine->state().bodies[0].position.x, x, 1e3 * tolerance * x)
            << integrator << " " << tolerance << " " << law << " case " << i;
      }
    }
}

}  // namespace
}  // namespace hookpoint
