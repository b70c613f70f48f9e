// Metrics on trajectories whose answers are known by hand: no engine runs here.
#include "studies/measure/metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/metric_scene.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;
using simulation::WorldState;
using testing::block_on_slope;
using testing::measure;

constexpr double pi = 3.14159265358979323846;

/// `measure` of a body with a pull that grows by `rate` [N/s] along x from 0.
std::optional<double> measure_pulled(
    std::string_view name, double rate,
    const std::function<void(const RunContext&, WorldState&)>& move) {
  Experiment experiment = block_on_slope(0., 0.);
  experiment.materials[0].constants.static_friction = 0.5;
  experiment.forces.resize(2);
  experiment.forces[1].robot = 1;  // another robot's: no concern of this one
  const RunContext context = make_context(experiment, 0., 1.);
  const auto metric = find_metric(name)->make(context);
  Observer observer(context, false);
  WorldState world;
  world.bodies.resize(1);
  simulation::WorldInputs inputs;
  inputs.forces.resize(2);
  inputs.forces[1].force = {0., 100., 0.};
  for (int step = 0; step <= 100; ++step) {
    world.time = step * experiment.deltat;
    inputs.forces[0].force = {rate * world.time, 0., 1.};
    move(context, world);
    metric->observe(observer.observe(world, &inputs));
  }
  return metric->value();
}

TEST(SlipOnset, IsTheAngleOfTheDrivingForceWhenTheBodyFirstMoves) {
  // 2 mm/s from t = 0.5 s on; upward motion is no slip. Weight less a lift of 1 N.
  const auto moves = [](const RunContext&, WorldState& world) {
    world.bodies[0].velocity = {0., world.time > 0.495 ? 2e-3 : 0.5e-3, 1.};
    if (world.time > 0.7) world.bodies[0].velocity = {};
    if (std::abs(world.time - 0.3) < 0.005) world.bodies[0].velocity.x = 1.;  // a twitch
  };
  const double angle = std::atan2(8. * 0.5, 8.81);
  EXPECT_NEAR(*measure_pulled("slip_onset", 8., moves), angle, 1e-12);
  EXPECT_NEAR(*measure_pulled("threshold_error", 8., moves), angle - std::atan(0.5), 1e-12);
}

TEST(SlipOnset, SaysNothingOfABodyThatHolds) {
  const auto holds = [](const RunContext&, WorldState&) {};
  EXPECT_FALSE(measure_pulled("slip_onset", 8., holds));
  EXPECT_FALSE(measure_pulled("threshold_error", 8., holds));
}

TEST(Unrest, IsTheSpeedOfAllKineticEnergyAfterSettle) {
  // Inertia 1: a turn of 0.8 rad/s is 0.32 J, as much as 0.8 m/s of the mass 1.
  const auto dies = [](const RunContext&, WorldState& world) {
    world.bodies[0].velocity = {world.time < 0.495 ? 5. : 0., 0., 0.};
    world.bodies[0].angular_velocity = {0., 0.8 * (1. - world.time), 0.};
  };
  EXPECT_NEAR(*measure(block_on_slope(0., 0.), "unrest", 0.5, 1., dies), 0.4, 1e-12);
  EXPECT_EQ(measure(block_on_slope(0., 0.), "restless", 0.5, 1., dies), 1.);
  const auto rests = [](const RunContext&, WorldState& world) {
    world.bodies[0].velocity = {0., 0., 0.9e-3};
  };
  EXPECT_EQ(measure(block_on_slope(0., 0.), "restless", 0.5, 1., rests), 0.);
}

TEST(Restless, IsARunThatTheEngineBrokeOff) {
  const Experiment experiment = block_on_slope(0., 0.);
  const RunContext context = make_context(experiment, 0., 1.);
  EXPECT_EQ(find_metric("restless")->make(context)->value_of_broken_run(), 1.);
  EXPECT_FALSE(find_metric("unrest")->make(context)->value_of_broken_run());
}

TEST(StableStep, IsTheBoundOfAPointOnASpringAndADamper) {
  // m = 1 kg, k = 1e4 N/m, c = 10 N s/m, half as stiff along the ground: dt^2 k + 2 dt c = 4 m.
  Experiment point = block_on_slope(0., 0.);
  point.robots[0].base.boundary_points = {{0., 0., 0.}};
  point.robots[0].location = {0., 0., -1e-4};
  auto& constants = point.materials[0].constants;
  constants.normal_stiffness = 1e4;
  constants.normal_damping = constants.tangential_damping = 10.;
  constants.tangential_stiffness = 5e3;
  const auto rests = [](const RunContext&, WorldState&) {};
  const double bound = (std::sqrt(10. * 10. + 4. * 1e4) - 10.) / 1e4;
  EXPECT_NEAR(*measure(point, "stable_step", 0., 0.1, rests), bound, 1e-6 * bound);
  const RunContext context = make_context(point, 0., 1.);
  EXPECT_NEAR(*find_metric("stable_step")->make(context)->value_of_broken_run(), bound,
              1e-6 * bound);
  for (const char* other : {"impulse", "impulse_reversal"}) {
    point.contact = other;
    EXPECT_FALSE(measure(point, "stable_step", 0., 0.1, rests)) << other;
  }
  point.contact = "hookpoint";
  point.engine = "ode";
  EXPECT_FALSE(measure(point, "stable_step", 0., 0.1, rests));
}

/// Moves the body downhill by s(t).
auto downhill(std::function<double(double)> s) {
  return [s](const RunContext& context, WorldState& world) {
    world.bodies[0].position += s(world.time) * context.downhill;
  };
}

TEST(Context, DownhillPointsAlongTheAzimuthAndDown) {
  const RunContext context = make_context(block_on_slope(20. * pi / 180., 30. * pi / 180.), 0., 1.);
  EXPECT_NEAR(context.downhill.x, std::cos(pi / 9.) * std::cos(pi / 6.), 1e-14);
  EXPECT_NEAR(context.downhill.y, std::cos(pi / 9.) * std::sin(pi / 6.), 1e-14);
  EXPECT_NEAR(context.downhill.z, -std::sin(pi / 9.), 1e-14);
  EXPECT_NEAR(context.weight, 9.81, 1e-14);
}

TEST(Context, OnTheLevelTheInitialVelocityDrives) {
  Experiment experiment = block_on_slope(0., 0.);
  experiment.robots[0].velocity = {0., -2., 0.};
  EXPECT_NEAR(make_context(experiment, 0., 1.).downhill.y, -1., 1e-15);
}

TEST(Context, AWorldWithoutMobileRobotIsRefused) {
  Experiment experiment = block_on_slope(0.1, 0.);
  experiment.robots[0].mobile = false;
  EXPECT_THROW(make_context(experiment, 0., 1.), simulation::ExperimentError);
}

TEST(CreepSpeed, IsTheSlopeAfterSettleWhateverCameBefore) {
  const auto value =
      measure(block_on_slope(0.3, 0.7), "creep_speed", 2., 10.,
              downhill([](double t) { return t < 1.5 ? 5. * t * t : 1. + 3e-5 * t; }));
  EXPECT_NEAR(*value, 3e-5, 1e-14);
}

TEST(CreepSpeed, OfAParabolaIsTheSpeedHalfWay) {
  const auto value = measure(block_on_slope(0.3, 0.), "creep_speed", 1., 4.,
                             downhill([](double t) { return 0.5 * 1.7 * t * t; }));
  EXPECT_NEAR(*value, 1.7 * 2.5, 1e-11);
}

TEST(CreepSideways, IsTheSlopeAcrossTheFallWhateverTheAzimuth) {
  for (const double azimuth : {0., 0.7, -2.}) {
    const auto aside = [](const RunContext& context, WorldState& world) {
      const double t = world.time;
      world.bodies[0].position +=
          3e-5 * t * context.downhill + 0.1 * t * t * context.normal +
          (t < 1.5 ? 5. : 1. - 4e-6 * t) * cross(context.normal, context.downhill);
    };
    EXPECT_NEAR(*measure(block_on_slope(0.3, azimuth), "creep_sideways", 2., 10., aside), -4e-6,
                1e-14);
  }
}

TEST(SlipAcceleration, IsExactForAParabola) {
  const auto value = measure(block_on_slope(0.3, 0.), "slip_acceleration", 1., 4.,
                             downhill([](double t) { return 0.3 - 2. * t + 0.5 * 1.7 * t * t; }));
  EXPECT_NEAR(*value, 1.7, 1e-11);
}

TEST(SettleShift, IsTheDisplacementAtSettle) {
  const auto value = measure(block_on_slope(0.3, 0.), "settle_shift", 1., 2.,
                             downhill([](double t) { return 0.25 * t; }));
  EXPECT_NEAR(*value, 0.25, 1e-14);
}

TEST(StickDisplacement, IgnoresThatTheBodyLeansOnItsFeet) {
  // A rotation about the feet moves the origin 0.05 * 1e-4 downhill; the feet move 1e-6.
  const auto value = measure(block_on_slope(0.2, 0.), "stick_displacement", 0.5, 1.,
                             [](const RunContext& context, WorldState& world) {
                               if (world.step == 0) return;
                               const Vector3d across = cross(context.normal, context.downhill);
                               const Quaterniond lean = exponential(1e-4 * across);
                               const Vector3d arm = context.start;
                               world.bodies[0].orientation = lean * world.bodies[0].orientation;
                               world.bodies[0].position =
                                   rotate(lean, arm) + 1e-6 * context.downhill;
                             });
  EXPECT_NEAR(*value, 1e-6, 1e-9);
}

TEST(Penetration, MaxMeanAndRmsOfTheDepthsAlongTheNormal) {
  // Sunk by 2 mm along the normal, leaning by 0.005 rad: the points go 0.5 mm up and down,
  // depths 1.5 and 2.5 mm.
  const auto sunk = [](const RunContext& context, WorldState& world) {
    const Vector3d across = cross(context.normal, context.downhill);
    const Quaterniond lean = exponential(0.005 * across);
    world.bodies[0].orientation = lean * world.bodies[0].orientation;
    const Vector3d arm = context.start;
    world.bodies[0].position = rotate(lean, arm) - 0.002 * context.normal;
  };
  const Experiment experiment = block_on_slope(0.4, 0.5);
  const double shift = 0.1 * std::sin(0.005);
  EXPECT_NEAR(*measure(experiment, "penetration_max", 0., 0.1, sunk), 0.002 + shift, 1e-12);
  EXPECT_NEAR(*measure(experiment, "penetration_mean", 0., 0.1, sunk), 0.002, 1e-12);
  EXPECT_NEAR(*measure(experiment, "penetration_rms", 0., 0.1, sunk), std::hypot(0.002, shift),
              1e-12);
}

TEST(Penetration, LooksOnlyAfterSettle) {
  const auto value = measure(block_on_slope(0.4, 0.), "penetration_max", 0.5, 1.,
                             [](const RunContext& context, WorldState& world) {
                               world.bodies[0].position +=
                                   (world.time < 0.4 ? -0.01 : 0.01) * context.normal;
                             });
  EXPECT_EQ(*value, 0.);
}

TEST(ContactBreaks, CountsEveryContactLostPerSecond) {
  // Four contacts that become two and four again, ten times a second: twenty losses a second.
  const auto value = measure(block_on_slope(0.2, 0.), "contact_breaks", 1., 3.,
                             [](const RunContext&, WorldState& world) {
                               world.bodies[0].contacts = world.step % 10 < 5 ? 4 : 2;
                             });
  EXPECT_NEAR(*value, 20., 1.01);
}

TEST(Impacts, AreCountedAfterSettleAndAbsentForAForceLaw) {
  const auto counting = [](const RunContext&, WorldState& world) {
    world.impacts = 3 * world.step;
  };
  EXPECT_NEAR(*measure(block_on_slope(0.2, 0.), "impacts", 1., 3., counting), 300., 1e-9);
  EXPECT_FALSE(
      measure(block_on_slope(0.2, 0.), "impacts", 1., 3., downhill([](double) { return 0.; })));
}

TEST(StoppingDistance, NeedsABodyAtRest) {
  Experiment experiment = block_on_slope(0., 0.);
  experiment.robots[0].velocity = {1., 0., 0.};
  const auto braking = [](double until) {
    return [until](const RunContext& context, WorldState& world) {
      const double t = std::min(world.time, until);
      world.bodies[0].position += (t - 0.5 * t * t) * context.downhill;
      world.bodies[0].velocity = (1. - t) * context.downhill;
    };
  };
  EXPECT_NEAR(*measure(experiment, "stopping_distance", 0., 2., braking(1.)), 0.5, 1e-14);
  EXPECT_FALSE(measure(experiment, "stopping_distance", 0., 2., braking(0.5)));
}

TEST(DirectionError, IsTheAngleToDownhill) {
  const auto oblique = [](const RunContext& context, WorldState& world) {
    const Vector3d across = cross(context.normal, context.downhill);
    world.bodies[0].position +=
        world.time * (std::cos(0.1) * context.downhill - std::sin(0.1) * across);
  };
  EXPECT_NEAR(*measure(block_on_slope(0.2, 0.7), "direction_error", 0.5, 2., oblique), 0.1, 1e-12);
}

TEST(SlipDistance, IsThePathNotTheDisplacementAndOnlyUnderLoad) {
  const auto shaken = [](const RunContext& context, WorldState& world) {
    world.bodies[0].contact_force = (world.time < 0.505 ? 9.81 : 0.) * context.normal;
    world.bodies[0].position += (world.step % 2 == 0 ? 0. : 1e-3) * context.downhill;
  };
  EXPECT_NEAR(*measure(block_on_slope(0.2, 0.), "slip_distance", 0., 1., shaken), 50e-3, 1e-12);
}

TEST(EnergyGain, IsTheGreatestRiseAboveTheStart) {
  // Lifted by 1 cm and let down: m g h; and a spin of 2 rad/s of inertia 1 adds 2 J.
  const auto lifted = [](const RunContext&, WorldState& world) {
    if (world.step == 5) world.bodies[0].position.z += 0.01;
    if (world.step == 5) world.bodies[0].angular_velocity = {0., 0., 2.};
  };
  EXPECT_NEAR(*measure(block_on_slope(0., 0.), "energy_gain", 0., 0.1, lifted), 9.81 * 0.01 + 2.,
              1e-12);
}

TEST(SpinMax, IsTheGreatestAngularSpeedAfterSettle) {
  const auto turned = [](const RunContext&, WorldState& world) {
    const auto rows = static_cast<double>(world.step);
    world.bodies[0].angular_velocity = {0., -0.3 * (10. - rows), 0.4 * (10. - rows)};
  };
  EXPECT_NEAR(*measure(block_on_slope(0., 0.), "spin_max", 0.03, 0.12, turned), 3.5, 1e-12);
}

/// A flight of 1 s: p0 + v t + g t^2/2, at a constant spin of 3 rad/s (inertia 1).
void fly(const RunContext& context, WorldState& world) {
  const Vector3d v0{1., 2., 5.}, g = context.experiment->gravity;
  world.bodies[0].position += world.time * v0 + 0.5 * world.time * world.time * g;
  world.bodies[0].velocity = v0 + world.time * g;
  world.bodies[0].angular_velocity = {0., 0., 3.};
}

TEST(Conservation, AFreeFlightDriftsInNothing) {
  for (const char* metric : {"energy_drift", "momentum_drift", "angular_momentum_drift"})
    EXPECT_NEAR(*measure(block_on_slope(0., 0.), metric, 0., 1., fly), 0., 1e-12) << metric;
}

TEST(Conservation, DriftsAreTheGreatestChangesEitherWay) {
  // Half way the body loses 1 m/s of its 2 m/s along y and 1 rad/s of its spin, and has them again
  // at the end: 1.5 J and 2.5 J, 1 kg m/s, 1 kg m^2/s.
  const auto slowed = [](const RunContext& context, WorldState& world) {
    fly(context, world);
    if (world.step != 50) return;
    world.bodies[0].velocity.y -= 1.;
    world.bodies[0].angular_velocity.z -= 1.;
  };
  const Experiment experiment = block_on_slope(0., 0.);
  EXPECT_NEAR(*measure(experiment, "energy_drift", 0., 1., slowed), 1.5 + 2.5, 1e-12);
  EXPECT_NEAR(*measure(experiment, "momentum_drift", 0., 1., slowed), 1., 1e-12);
  EXPECT_NEAR(*measure(experiment, "angular_momentum_drift", 0., 1., slowed), 1., 1e-12);
}

TEST(Rebound, IsSpeedAfterOverSpeedBefore) {
  const auto bounce = [](const RunContext& context, WorldState& world) {
    world.bodies[0].velocity = (world.step < 50 ? -2. : 0.5) * context.normal + context.downhill;
  };
  EXPECT_NEAR(*measure(block_on_slope(0.3, 0.), "rebound", 0., 1., bounce), 0.25, 1e-14);
  EXPECT_FALSE(
      measure(block_on_slope(0.3, 0.), "rebound", 0., 1., downhill([](double) { return 0.; })));
}

TEST(SupportForce, IsTheMeanAlongTheNormalAfterSettle) {
  const auto shaken = [](const RunContext& context, WorldState& world) {
    const double force = world.time < 0.495 ? 100. : world.step % 2 == 0 ? 9. : 11.;
    world.bodies[0].contact_force = force * context.normal + 5. * context.downhill;
  };
  EXPECT_NEAR(*measure(block_on_slope(0.3, 0.), "support_force", 0.5, 0.99, shaken), 10., 1e-12);
}

/// A base, a link that turns 0.5 m along its x, and one that slides along the z of that link.
TEST(JointGap, IsHowFarALinkIsFromWhereItsJointLetsItBe) {
  Experiment experiment = block_on_slope(0., 0.);
  simulation::LinkSpec turns, slides;
  turns.angle = 0.3;
  slides.joint = simulation::JointKind::prismatic;
  slides.a = 0.2;
  experiment.robots[0].chains.resize(1);
  experiment.robots[0].chains[0].hip_distance = {0.5, 0., 0.};
  experiment.robots[0].chains[0].links = {turns, slides};
  const RunContext context = make_context(experiment, 0.5, 1.);
  const auto measured = [&](const Vector3d& first, const Vector3d& second) {
    const auto metric = find_metric("joint_gap")->make(context);
    Observer observer(context, false);
    WorldState world;
    world.bodies.resize(3);
    for (const double time : {0., 1.}) {
      world.time = time;
      world.bodies[0].position = {1., 0., 0.};
      world.bodies[0].orientation = world.bodies[1].orientation =
          exponential(Vector3d{0., 0., pi / 2.});
      world.bodies[1].position = Vector3d{1., 0.5, 0.} + first;
      world.bodies[2].position = world.bodies[1].position + Vector3d{0., 0.2, 0.} + second;
      if (time == 0.) world.bodies[1].position = {};  // before `settle`
      metric->observe(observer.observe(world));
    }
    return *metric->value();
  };
  EXPECT_NEAR(measured({}, {0., 0., 0.7}), 0., 1e-15);
  EXPECT_NEAR(measured({0., 3e-3, 4e-3}, {}), 5e-3, 1e-15);
  EXPECT_NEAR(measured({}, {3e-3, 4e-3, 0.7}), 5e-3, 1e-15);
  EXPECT_FALSE(
      measure(block_on_slope(0., 0.), "joint_gap", 0., 1., [](const RunContext&, WorldState&) {}));
}

TEST(TruthError, IsTheDistanceFromTheRigidBlock) {
  // Without friction the block slides with g sin. This one lags behind by 3 mm at 0.7 s.
  const auto lagging = downhill([](double t) {
    return 0.5 * 9.81 * std::sin(0.3) * t * t - (std::abs(t - 0.7) < 1e-9 ? 3e-3 : 0.);
  });
  Experiment experiment = block_on_slope(0.3, 0.);
  auto& constants = experiment.materials[0].constants;
  constants.static_friction = constants.kinetic_friction = 0.;
  EXPECT_NEAR(*measure(experiment, "truth_error", 0., 1., lagging), 3e-3, 1e-12);
}

}  // namespace
}  // namespace hookpoint::studies
