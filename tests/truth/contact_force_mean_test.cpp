// A body's contact.force is the mean over the last step, whatever the law and the integrator: its
// sum is what the ground has given to momentum.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double mass = 3., gravity = 9.81;

/// A ball thrown on the ground, seen every `dt` [s] (steps are that long).
std::string thrown(const std::string& settings, double dt) {
  return "World w { gravity = 9.81; deltat = " + std::to_string(dt) + "; " + settings + R"(
  Material m { normal_stiffness = 20 kN/m; normal_damping = 60; tangential_stiffness = 20 kN/m;
    tangential_damping = 60; static_friction = 0.4; kinetic_friction = 0.4; restitution = 0.5; }
  Terrain.Flat ground { material = m; }
  Robot ball { Base.mobile { location = 0, 0, 0.15; velocity = 1, 0, -3;
    Shape.Sphere { radius = 0.1; mass = 3; } } } })";
}

void expect_momentum(const std::string& settings, double dt, int steps, double part) {
  SCOPED_TRACE(settings);
  Running run(thrown(settings, dt));
  const auto force_x = run.port("ball.contact.force.x"), force_z = run.port("ball.contact.force.z");
  EXPECT_EQ(*force_z.value, 0.);
  double given_x = 0., given_z = 0.;
  for (int i = 0; i < steps; ++i) {
    run.step();
    given_x += dt * *force_x.value;
    given_z += dt * *force_z.value;
  }
  const double gained_z = mass * (run["ball.velocity.z"] + 3. + gravity * steps * dt);
  const double gained_x = mass * (run["ball.velocity.x"] - 1.);
  EXPECT_GT(gained_z, 8.);
  EXPECT_LT(gained_x, -0.1);
  EXPECT_NEAR(given_z, gained_z, part * gained_z);
  EXPECT_NEAR(given_x, gained_x, part * gained_z);
}

TEST(ContactForce, SumsToTheMomentumUnderEveryLawWithFixedSteps) {
  for (const char* integrator : {"explicit_euler", "semi_implicit_euler", "rk4"}) {
    for (const contact::LawDescription& law : contact::law_table()) {
      if (law.is_impulse_law) continue;
      expect_momentum(
          "integrator = " + std::string(integrator) + "; contact = " + std::string(law.name) + ";",
          1e-4, 3000, 1e-12);
    }
  }
}

TEST(ContactForce, SumsToTheMomentumUnderEveryLawWithAdaptiveSteps) {
  for (const char* integrator : {"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
    for (const contact::LawDescription& law : contact::law_table()) {
      if (law.is_impulse_law) continue;
      const bool explicit_method = std::string(integrator) == "arkode";
      // Which explicit steps do not take a bristle that relaxes within microseconds.
      if (explicit_method && law.bristle_states > 0) continue;
      // Regularised friction holds an explicit method at its limit of stability, where its
      // interpolant is worth less.
      expect_momentum(
          "integrator = " + std::string(integrator) + "; contact = " + std::string(law.name) + ";",
          0.05, 6, explicit_method ? 1e-3 : 1e-4);
    }
  }
}

TEST(ContactForce, SumsToTheMomentumUnderImpulses) {
  for (const char* law : {"impulse", "impulse_reversal"})
    expect_momentum("contact = " + std::string(law) + ";", 0.01, 30, 1e-9);
}

// Nobody pays for it who does not look at it, and whoever looks gets the same motion.
TEST(ContactForce, LookingChangesNoMotion) {
  for (const char* integrator : {"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
    SCOPED_TRACE(integrator);
    const std::string text = thrown("integrator = " + std::string(integrator) + ";", 0.01);
    Running looked(text), left(text);
    looked.port("ball.contact.force.z");
    looked.step(30);
    left.step(30);
    for (const char* trail : {"ball.position.z", "ball.velocity.x", "integrator.steps"})
      EXPECT_EQ(looked[trail], left[trail]) << trail;
    // The interpolant of SUNDIALS 7's ARKODE takes rates of its own.
    if (std::string(integrator).starts_with("cvode")) {
      EXPECT_EQ(looked["integrator.evaluations"], left["integrator.evaluations"]);
    }
  }
}

}  // namespace
}  // namespace hookpoint
