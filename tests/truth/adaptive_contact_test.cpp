// Adaptive integrators under the engine: bounces, slip and stick against closed forms, whatever the
// output interval; what happens when no step can be found; runs that are resumed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/load_text.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

using simulation::Experiment;

const std::vector<std::string> adaptive{"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"};

Experiment with(Experiment experiment, const std::string& integrator, double deltat,
                double tolerance) {
  experiment.integrator = integrator;
  experiment.deltat = deltat;
  experiment.relative_tolerance = tolerance;
  experiment.absolute_tolerance = 0.01 * tolerance;
  return experiment;
}

/// A world after `duration`.
simulation::WorldState run(const Experiment& experiment, double duration) {
  const auto engine = simulation::make_dts(experiment);
  const long steps = std::lround(duration / experiment.deltat);
  for (long i = 0; i < steps; ++i) {
    const simulation::StepStatus status = engine->step();
    EXPECT_TRUE(status.ok()) << experiment.integrator << ": " << status.advice;
    if (!status.ok()) break;
  }
  return engine->state();
}

constexpr const char* ball = R"(
World w {
  gravity = 9.81;
  Material m { normal_stiffness = 10 kN/m; normal_damping = 0; tangential_stiffness = 10 kN/m; tangential_damping = 0; }
  Terrain.Flat ground { material = m; }
  Robot ball { Base.mobile { location = 0, 0, 0.5; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; ContactPoint p { location = 0, 0, 0; } } }
}
)";

TEST(AdaptiveContact, BouncesOnAnUndampedSpringForEver) {
  const double w = std::sqrt(1e4), v0 = std::sqrt(2. * 9.81 * 0.5);
  const double flight = 2. * v0 / 9.81;
  const double contact = 2. * (std::numbers::pi - std::atan(v0 * w / 9.81)) / w;
  const double bounces = 3.;
  for (const std::string& integrator : adaptive) {
    const double deltat = (flight + contact) / 10.;
    const simulation::WorldState state =
        run(with(*load_text(ball).experiment, integrator, deltat, 1e-9), bounces * 10. * deltat);
    EXPECT_NEAR(state.bodies[0].position.z, 0.5, 1e-5) << integrator;
    EXPECT_NEAR(state.bodies[0].velocity.z, 0., 1e-5) << integrator;
    EXPECT_EQ(state.integrator.events, 2. * bounces) << integrator;
  }
}

/// The damper's force jumps at touch-down. Without gravity the clamped spring-damper throws back
/// e = exp(-(zeta/sqrt(1 - zeta^2)) acos(2 zeta^2 - 1)) of the speed.
TEST(AdaptiveContact, ReboundsAsTheClampedSpringDamperDoes) {
  const double zeta = 0.25, damping = 2. * zeta * std::sqrt(1e4);
  const double e = std::exp(-zeta / std::sqrt(1. - zeta * zeta) * std::acos(2. * zeta * zeta - 1.));
  for (const std::string& integrator : adaptive) {
    Experiment damped = with(*load_text(ball).experiment, integrator, 0.01, 1e-10);
    damped.gravity = {};
    damped.robots[0].location.z = 0.11;  // touches between two outputs
    damped.robots[0].velocity.z = -2.;
    for (simulation::MaterialSpec& material : damped.materials)
      material.constants.normal_damping = damping;
    const simulation::WorldState state = run(damped, 0.2);
    EXPECT_NEAR(state.bodies[0].velocity.z, 2. * e, 1e-7) << integrator;
    EXPECT_EQ(state.integrator.events, 2.) << integrator;
    // No step meets the jump of the touch-down, at 0.055 s: it would cost some ten rejections.
    EXPECT_LE(run(damped, 0.06).integrator.rejected, 4.) << integrator;
  }
}

/// The block of Fig. 5 sticks: let go at once, it comes to rest m g sin/(n k_t) downhill.
TEST(AdaptiveContact, SticksOnASlopeWhereFrictionHolds) {
  for (const std::string& integrator : adaptive) {
    const Experiment block =
        with(testing::load_scene("scenes/sloped_block.hook", {{"slope", "10 deg"}}), integrator,
             0.01, 1e-6);
    const auto engine = simulation::make_dts(block);
    std::vector<simulation::BodyState> bodies;
    for (int i = 0; i < 300; ++i) {
      ASSERT_TRUE(engine->step().ok());
      if (i == 199) bodies = engine->state().bodies;
    }
    EXPECT_LE(norm(engine->state().bodies[0].position - bodies[0].position), 1e-9) << integrator;
    EXPECT_EQ(engine->state().bodies[0].contacts, 4);
  }
}

/// Thrown at 1 m/s with mu = 0.5: v0^2/(2 mu g) less the stretch e0 = mu m g/(4 k_t) of its hooks.
TEST(AdaptiveContact, BrakesByCoulombWhateverTheOutputInterval) {
  const double distance = 1. / (2. * 0.5 * 9.81);
  const double e0 = 0.5 * 9.81 / (4. * 20e3);
  for (const std::string& integrator : adaptive) {
    for (const double deltat : {1e-3, 0.1}) {
      const simulation::WorldState state = run(
          with(testing::load_scene("scenes/braking_block.hook", {}), integrator, deltat, 1e-7), 1.);
      // Friction acts 5 cm under the centre of mass and tips the block forward on its springs, by
      // about as much again.
      EXPECT_NEAR(state.bodies[0].position.x, distance - e0, 3. * e0) << integrator << deltat;
      EXPECT_LE(norm(state.bodies[0].velocity), 1e-6) << integrator << deltat;
    }
  }
}

/// A hook with a strong damper follows its sliding point slowly: e = mu N/k_t (1 - exp(-k_t
/// t/c_t)). Each internal step relaxes it over that step's own length.
TEST(AdaptiveContact, HookRelaxesOverTheTimeThatPasses) {
  Experiment sliding = *load_text(R"(
World w {
  Material m { normal_stiffness = 10 kN/m; normal_damping = 200; tangential_stiffness = 100 N/m; tangential_damping = 50 N.s/m;
               static_friction = 0.3; kinetic_friction = 0.3; }
  Terrain.Flat ground { material = m; }
  Robot r { Base.mobile { location = 0, 0, -0.981 mm; velocity = 2, 0, 0; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0;
                          ContactPoint p { location = 0, 0, 0; } } }
}
)")
                            .experiment;
  for (const std::string& integrator : adaptive) {
    const auto engine = simulation::make_dts(with(sliding, integrator, 0.05, 1e-6));
    engine->publish_details();
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(engine->step().ok());
    const double steady = 0.3 * 9.81 / 100.;
    const simulation::PointState& point = engine->state().points.at(0);
    EXPECT_NEAR(point.position.x - point.hook.x, steady * (1. - std::exp(-0.4)), 0.1 * steady)
        << integrator;
  }
}

/// Bristles that relax slowly are still bent as the ball lifts off: it lands with new ones, also
/// within one interval.
TEST(AdaptiveContact, LandsWithAnUnbentBristleWhateverTheOutputInterval) {
  Experiment skids = *load_text(ball).experiment;
  skids.robots[0].velocity = {1., 0., 0.};
  auto& ground = skids.materials[0].constants;
  ground.tangential_stiffness = 1e3;
  ground.tangential_damping = 100.;
  for (const char* law : {"azad_featherstone", "elastoplastic", "exponential", "lugre"}) {
    skids.contact = law;
    const auto speed = [&](double interval) {
      return run(with(skids, "cvode_adams", interval, 1e-9), 1.2).bodies[0].velocity.x;
    };
    EXPECT_LE(speed(1.2), 0.9) << law;
    EXPECT_NEAR(speed(1.2), speed(0.002), 1e-5) << law;
  }
}

TEST(AdaptiveContact, AgreesOnACurvedSlide) {
  const Experiment block = testing::load_scene("scenes/work_precision_block.hook", {});
  const Vector3d reference = run(with(block, "rk4", 2e-5, 1.), 0.5).bodies[0].position;
  for (const std::string& integrator : adaptive) {
    const simulation::WorldState state = run(with(block, integrator, 0.01, 1e-7), 0.5);
    EXPECT_LE(norm(state.bodies[0].position - reference), 3e-6) << integrator;
    EXPECT_GT(state.integrator.events, 0.) << integrator;
  }
}

/// A tilted box falls, and corners of it touch, slip and lift off within long intervals.
Experiment tilted_box(const std::string& law) {
  Experiment box = *load_text(R"(
World w {
  gravity = 9.81;
  Material m { normal_stiffness = 20 kN/m; normal_damping = 40; tangential_stiffness = 20 kN/m;
               tangential_damping = 40; static_friction = 0.8; kinetic_friction = 0.8; }
  Terrain.Flat ground { material = m; }
  Robot box { Base.mobile { location = 0, 0, 70 mm; orientation = 5 deg, 3.5 deg, 0;
                            Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
}
)")
                        .experiment;
  box.contact = law;
  return box;
}

/// Where a load vanishes the stretch does too, and no event may hang on its being exactly 0; after
/// an event the first step that is tried may be ten thousand times too long.
TEST(AdaptiveContact, ATiltedBoxFallsAtEveryUsualTolerance) {
  for (const char* law : {"hookpoint", "hookpoint_reset", "nominal", "hunt_crossley",
                          "azad_featherstone", "lugre", "elastoplastic", "exponential"}) {
    const Experiment under = tilted_box(law);
    const auto place = [&](double tolerance, double duration) {
      return run(with(under, "arkode", 0.1, tolerance), duration).bodies[0].position;
    };
    // Later it tumbles from corner to corner, which magnifies every error.
    const Vector3d finest = place(1e-9, 0.1);
    for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-10}) {
      EXPECT_LE(norm(place(tolerance, 0.1) - finest), 1e-5) << law << " " << tolerance;
      place(tolerance, 0.3);
    }
  }
}

/// What a joint and a hip publish is of the whole of the forces, also where an integrator takes
/// them apart. Without friction the ground carries half the weight, however the bar lies.
TEST(AdaptiveContact, ALyingArmIsStillUnderEveryIntegrator) {
  const Experiment arm = *load_text(R"(
World w {
  gravity = 9.81;
  Material m { normal_stiffness = 10 kN/m; normal_damping = 200; static_friction = 0; kinetic_friction = 0; }
  Terrain.Flat ground { material = m; }
  Robot r {
    Base.fixed { location = 0, 0, 0.1; }
    Chain arm {
      hip_orientation = 90 deg, 0, 0;
      Link bar {
        angle = -11.5 deg; mass = 1 kg; center_of_mass = 0.25, 0, 0; inertia = 0.01, 0.02, 0.02, 0, 0, 0;
        ContactPoint tip { location = 0.5, 0, 0; }
      }
    }
  }
}
)")
                              .experiment;
  for (const auto& method : integrators::stepper_table()) {
    Experiment experiment = arm;
    experiment.integrator = method.name;
    experiment.deltat = 1e-3;
    const auto engine = simulation::make_dts(experiment);
    engine->publish_details();
    for (int i = 0; i < 3000; ++i) ASSERT_TRUE(engine->step().ok()) << method.name;
    const simulation::WorldState& state = engine->state();
    EXPECT_NEAR(state.joints.at(0).acceleration, 0., 1e-3) << method.name;
    const double on_ground = state.bodies.at(1).contact_force.z;
    EXPECT_NEAR(on_ground, 9.81 / 2., 1e-6) << method.name;
    EXPECT_NEAR(state.chains.at(0).hip_force.z, on_ground - 9.81, 1e-3) << method.name;
  }
}

TEST(AdaptiveContact, SaysWhatToChangeWhenAStepIsTooLong) {
  Experiment hard = with(*load_text(ball).experiment, "cvode_adams", 1., 1e-6);
  hard.robots[0].location.z = 0.;
  for (simulation::MaterialSpec& material : hard.materials)
    material.constants.normal_stiffness = 1e14;
  const auto engine = simulation::make_dts(hard);
  const simulation::StepStatus status = engine->step();
  EXPECT_EQ(status.kind, simulation::StepStatus::Kind::solver_failed);
  EXPECT_NE(status.advice.find("evaluations"), std::string::npos) << status.advice;
  EXPECT_EQ(engine->state().time, 0.);
}

TEST(AdaptiveContact, SaysWhatToChangeWhenItFindsNoStep) {
  Experiment block = testing::load_scene("scenes/sloped_block.hook", {});
  block.integrator = "cvode_bdf";
  block.relative_tolerance = 1e-18;
  block.absolute_tolerance = 1e-30;
  const auto engine = simulation::make_dts(block);
  const Vector3d before = engine->state().bodies[0].position;
  const simulation::StepStatus status = engine->step();
  EXPECT_EQ(status.kind, simulation::StepStatus::Kind::solver_failed);
  EXPECT_NE(status.advice.find("relative_tolerance"), std::string::npos) << status.advice;
  EXPECT_EQ(engine->state().bodies[0].position.x, before.x);
  EXPECT_EQ(engine->state().time, 0.);
}

TEST(AdaptiveContact, GoesOnBitForBitFromASavedState) {
  for (const std::string& integrator : adaptive) {
    const Experiment block =
        with(testing::load_scene("scenes/work_precision_block.hook", {}), integrator, 0.01, 1e-6);
    const auto engine = simulation::make_dts(block);
    for (int i = 0; i < 7; ++i) ASSERT_TRUE(engine->step().ok());
    std::vector<double> numbers(engine->resumable()->state_size());
    engine->resumable()->save(numbers);
    const auto resumed = simulation::make_dts(block);
    resumed->resumable()->restore(numbers);
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(engine->step().ok());
      ASSERT_TRUE(resumed->step().ok());
    }
    const simulation::BodyState &a = engine->state().bodies[0], &b = resumed->state().bodies[0];
    EXPECT_EQ(a.position.x, b.position.x) << integrator;
    EXPECT_EQ(a.velocity.y, b.velocity.y) << integrator;
    EXPECT_EQ(a.angular_velocity.z, b.angular_velocity.z) << integrator;
    EXPECT_EQ(engine->state().integrator.evaluations, resumed->state().integrator.evaluations);
  }
}

TEST(AdaptiveContact, CannotBePairedWithAnImpulseLaw) {
  const auto text = [](const std::string& fields) {
    return "World w { " + fields +
           " Robot r { Base.mobile { mass = 1; inertia = 1,1,1,0,0,0; } } }";
  };
  for (const std::string& integrator : adaptive) {
    const Loaded loaded = load_text(text("contact = impulse; integrator = " + integrator + ";"));
    EXPECT_FALSE(loaded.experiment);
    EXPECT_NE(loaded.diagnostics.find("cannot be paired with " + integrator), std::string::npos);
  }
  const Loaded warned = load_text(text("integrator = rk4; relative_tolerance = 1e-3;"));
  EXPECT_TRUE(warned.experiment);
  EXPECT_NE(warned.diagnostics.find("warning"), std::string::npos) << warned.diagnostics;
  EXPECT_EQ(load_text(text("integrator = arkode; relative_tolerance = 1e-3;")).diagnostics, "");
}

}  // namespace
}  // namespace hookpoint
