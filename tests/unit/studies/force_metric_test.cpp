// Metrics of forces, work and friction, on states made up so that each number is known
// by hand: no engine runs here.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "studies/measure/metric.h"
#include "tests/support/metric_scene.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;
using simulation::GroundForceTime;
using simulation::WorldState;
using testing::block_on_slope;
using testing::measure;

constexpr double gravity = 9.81;

/// A block that weighs 9.81 N, mu_s 0.5, mu_k 0.4.
Experiment rough_block() {
  Experiment experiment = block_on_slope(0., 0.);
  experiment.materials[0].constants.static_friction = 0.5;
  experiment.materials[0].constants.kinetic_friction = 0.4;
  return experiment;
}

/// The block under `force` at its four corners, each a quarter, with `velocity`.
auto pushed(const Vector3d& force, const Vector3d& velocity) {
  return [=](const RunContext& context, WorldState& world) {
    world.ground_force_time = GroundForceTime::last_step;
    world.bodies[0].velocity = velocity;
    world.ground_forces.clear();
    for (const Vector3d& corner : context.robot_spec().base.boundary_points)
      world.ground_forces.push_back({0, corner, 0.25 * force});
  };
}

struct Residuals {
  double normal, cone, dissipation;
};

void expect_residuals(const Experiment& experiment,
                      const std::function<void(const RunContext&, WorldState&)>& move,
                      const Residuals& expected) {
  const auto of = [&](const char* part) {
    return measure(experiment, std::string("force_residual") + part, 0., 1., move).value_or(-1.);
  };
  EXPECT_NEAR(of("_normal"), expected.normal, 1e-12);
  EXPECT_NEAR(of("_cone"), expected.cone, 1e-12);
  EXPECT_NEAR(of("_dissipation"), expected.dissipation, 1e-12);
  EXPECT_NEAR(of(""), expected.normal + expected.cone + expected.dissipation, 1e-12);
}

TEST(ForceResidual, OfABlockThatRestsOrSlidesAsCoulombSaysIsNone) {
  expect_residuals(rough_block(), pushed({0., 0., gravity}, {}), {0., 0., 0.});
  expect_residuals(rough_block(), pushed({0.3 * gravity, 0., gravity}, {}), {0., 0., 0.});
  expect_residuals(rough_block(), pushed({-0.4 * gravity, 0., gravity}, {2., 0., 0.}),
                   {0., 0., 0.});
}

TEST(ForceResidual, NormalForceIsAgainstTheGroundThatTheBodyStaysOn) {
  // A pull of 3 N; 10 N while the contact opens at 0.2 m/s; 10 N while it closes at 0.25 mm/s,
  // a quarter of the speed from which a contact moves.
  Experiment smooth = rough_block();
  smooth.materials[0].constants.static_friction = smooth.materials[0].constants.kinetic_friction =
      0.;
  expect_residuals(smooth, pushed({0., 0., -3.}, {}), {3., 0., 0.});
  expect_residuals(smooth, pushed({0., 0., 10.}, {0., 0., 0.2}), {10., 0., 0.});
  expect_residuals(smooth, pushed({0., 0., 10.}, {0., 0., -0.25e-3}), {2.5, 0., 0.});
}

TEST(ForceResidual, NothingPushesAcrossAGap) {
  const auto lifted = [](double gap) {
    return [gap](const RunContext& context, WorldState& world) {
      pushed({0., 0., 10.}, {})(context, world);
      world.bodies[0].position.z += gap;
    };
  };
  expect_residuals(rough_block(), lifted(0.05e-3), {0., 0., 0.});  // a peer's margin
  expect_residuals(rough_block(), lifted(1e-3), {10., 0., 0.});
}

TEST(ForceResidual, FrictionStaysInItsCone) {
  // (3, 4) is 5 N where 0.5 * 8 N are allowed.
  expect_residuals(rough_block(), pushed({3., 4., 8.}, {}), {0., 1., 0.});
  // Adhesion lets nothing be carried along the ground either.
  expect_residuals(rough_block(), pushed({2., 0., -1.}, {}), {1., 2., 0.});
}

TEST(ForceResidual, FrictionOpposesSlipWithAllThatItHas) {
  // N = 10 N, 4 N of friction: half of it, across the slip, and along the slip.
  expect_residuals(rough_block(), pushed({-2., 0., 10.}, {1., 0., 0.}), {0., 0., 2.});
  expect_residuals(rough_block(), pushed({0., -4., 10.}, {1., 0., 0.}), {0., 0., 4.});
  expect_residuals(rough_block(), pushed({4., 0., 10.}, {1., 0., 0.}), {0., 0., 8.});
  // A creep of 0.1 mm/s is a tenth of the speed from which it slips.
  expect_residuals(rough_block(), pushed({-2., 0., 10.}, {1e-4, 0., 0.}), {0., 0., 0.2});
}

TEST(ForceResidual, IsTheMeanSinceSettleOverTheContactsOfItsOwnRobot) {
  const auto changing = [](const RunContext& context, WorldState& world) {
    pushed({0., 0.,
            world.time < 0.5 - 1e-9 ? -100.
            : world.step % 2 == 0   ? -1.
                                    : -3.},
           {})(context, world);
    world.ground_forces.push_back({7, {}, {0., 0., -1000.}});  // another robot's
  };
  EXPECT_NEAR(*measure(rough_block(), "force_residual", 0.5, 0.99, changing), 2., 1e-12);
}

TEST(ForceResidual, SaysNothingOfAnEngineThatDoesNotTellItsForces) {
  const auto silent = [](const RunContext&, WorldState&) {};
  EXPECT_FALSE(measure(rough_block(), "force_residual", 0., 1., silent));
  EXPECT_FALSE(measure(rough_block(), "energy_residual", 0., 1., silent));
}

/// Slides at v0 - a t with friction `friction` as engines with held forces step it: the force of a
/// step changes the speed first.
auto braked(double friction, GroundForceTime time) {
  return [=](const RunContext& context, WorldState& world) {
    pushed({world.step > 0 || time == GroundForceTime::now ? -friction : 0., 0., gravity},
           {5. - 2. * world.time, 0., 0.})(context, world);
    world.ground_force_time = time;
    world.bodies[0].position.x += (5. - world.time) * world.time;
  };
}

TEST(EnergyResidual, OfABlockBrakedByItsFrictionIsNone) {
  for (const auto time : {GroundForceTime::last_step, GroundForceTime::now})
    EXPECT_NEAR(*measure(rough_block(), "energy_residual", 0., 1., braked(2., time)), 0., 1e-12);
}

TEST(EnergyResidual, IsWhatForcesDoNotAccountForPerEnergyExchanged) {
  // From 5 to 3 m/s the block gives 8 J over 4 m. A published friction of 1.5 N accounts for 6 J;
  // 12.5 J of motion and 6 J of work were exchanged.
  for (const auto time : {GroundForceTime::last_step, GroundForceTime::now})
    EXPECT_NEAR(*measure(rough_block(), "energy_residual", 0., 1., braked(1.5, time)), 2. / 18.5,
                1e-12);
}

TEST(EnergyResidual, OfABlockThatRestsIsNone) {
  EXPECT_EQ(*measure(rough_block(), "energy_residual", 0., 1., pushed({0., 0., gravity}, {})), 0.);
}

TEST(EnergyResidual, CountsHeightOnceAndTheForcesTurningMoment) {
  // Lifted 2 m by 9.81 N at its corners, at 2 m/s throughout: 19.62 J each way, 2 J of motion.
  const auto lifted = [](double force) {
    return [force](const RunContext& context, WorldState& world) {
      pushed({0., 0., force}, {0., 0., 2.})(context, world);
      world.bodies[0].position.z += 2. * world.time;
    };
  };
  EXPECT_NEAR(*measure(rough_block(), "energy_residual", 0., 1., lifted(gravity)), 0., 1e-12);
  EXPECT_NEAR(*measure(rough_block(), "energy_residual", 0., 1., lifted(0.)), 19.62 / 21.62, 1e-12);
  // A pair of forces of 1 N, 0.2 m apart, spins it up by 0.2 rad/s^2 from rest (inertia 1): the
  // body is shown unturned, so that the couple keeps its arm.
  const auto spun = [](const RunContext&, WorldState& world) {
    world.ground_force_time = GroundForceTime::last_step;
    world.bodies[0].angular_velocity = {0., 0., 0.2 * world.time};
    world.ground_forces = {{0, {0., 0.1, 0.}, {-1., 0., 0.}}, {0, {0., -0.1, 0.}, {1., 0., 0.}}};
  };
  EXPECT_NEAR(*measure(rough_block(), "energy_residual", 0., 1., spun), 0., 1e-12);
}

TEST(EnergyResidual, CountsTheWorkOfJointsAndExternalForces) {
  // A link that turns from 0 to 2 rad/s about an axis of its own under 1.5 N m beside a pull of 2 N
  // on the base, 1 kg, that starts from rest.
  Experiment experiment = rough_block();
  experiment.terrain.reset();
  experiment.gravity = {};
  simulation::LinkSpec link;
  link.body.mass = {1., {}, {1., 1., 0.75, 0., 0., 0.}};
  experiment.robots[0].chains.resize(1);
  experiment.robots[0].chains[0].links.push_back(link);
  experiment.forces.resize(1);
  const RunContext context = make_context(experiment, 0., 1.);
  const auto residual = [&](double torque, double pull) {
    const auto metric = find_metric("energy_residual")->make(context);
    Observer observer(context, false);
    WorldState world;
    world.bodies.resize(2);
    world.joints.resize(1);
    simulation::WorldInputs inputs;
    inputs.forces.resize(1);
    inputs.forces[0].force = {pull, 0., 0.};
    for (int step = 0; step <= 100; ++step) {
      world.time = 0.01 * step;
      world.bodies[0].velocity = {2. * world.time, 0., 0.};
      world.bodies[1].angular_velocity = {0., 0., 2. * world.time};
      world.joints[0] = {world.time * world.time, 2. * world.time, 2., torque};
      metric->observe(observer.observe(world, &inputs));
    }
    return *metric->value();
  };
  // 2 J of the base and 1.5 J of the link at the end.
  EXPECT_NEAR(residual(1.5, 2.), 0., 1e-12);
  EXPECT_NEAR(residual(0., 2.), 1.5 / (3.5 + 2.), 1e-12);
  EXPECT_NEAR(residual(1.5, 0.), 2. / (3.5 + 1.5), 1e-12);
}

// Of a wheel that turns with 100 rad/s beside a block that swings to and fro along x with 1 J.
TEST(NumericalEnergy, IsHeldAgainstWhatTakesPartInTheMotion) {
  Experiment experiment = rough_block();
  experiment.gravity = {};
  simulation::LinkSpec wheel;
  wheel.body.mass = {1., {}, {1., 1., 2., 0., 0., 0.}};
  wheel.stiffness = 0.5;
  experiment.robots[0].chains.resize(1);
  experiment.robots[0].chains[0].links.push_back(wheel);
  const RunContext context = make_context(experiment, 0.5, 2.);
  for (const auto& [name, expected] :
       {std::pair{"numerical_energy", 0.3}, {"numerical_energy_part", 0.3 / 5.}}) {
    const auto metric = find_metric(name)->make(context);
    EXPECT_FALSE(metric->value());
    Observer observer(context, false);
    WorldState world;
    world.bodies.resize(2);
    world.joints.resize(1);
    for (int step = 0; step <= 200; ++step) {
      world.time = 0.01 * step;
      // The block has 1 J and 0, the joint's spring 4 J and 1: half of 1 + 3; drives took 3 J.
      world.bodies[0].velocity = {std::sqrt(2.) * std::cos(2. * M_PI * world.time), 0., 0.};
      world.bodies[1].angular_velocity = {0., 0., 100.};
      world.joints[0].angle = 3. + std::cos(4. * M_PI * world.time);
      Observation observation = observer.observe(world);
      observation.numerical_energy = 0.2 * world.time;
      observation.driven_work = -2. * world.time;
      metric->observe(observation);
    }
    EXPECT_NEAR(*metric->value(), expected, 1e-12) << name;
  }
}

TEST(Friction, IsWhatSlowsTheSlide) {
  // On 0.3 rad with mu = 0.25 a = g (sin - 0.25 cos).
  const auto slides = [](const RunContext& context, WorldState& world) {
    const double a = gravity * (std::sin(0.3) - 0.25 * std::cos(0.3));
    world.bodies[0].position += 0.5 * a * world.time * world.time * context.downhill;
  };
  EXPECT_NEAR(*measure(block_on_slope(0.3, 0.7), "friction", 0.2, 1., slides), 0.25, 1e-10);
  const auto holds = [](const RunContext&, WorldState&) {};
  EXPECT_NEAR(*measure(block_on_slope(0.3, 0.7), "friction", 0.2, 1., holds), std::tan(0.3), 1e-12);
  Experiment pulled = block_on_slope(0.3, 0.7);
  pulled.forces.resize(1);
  EXPECT_FALSE(measure(pulled, "friction", 0.2, 1., holds));
}

}  // namespace
}  // namespace hookpoint::studies
