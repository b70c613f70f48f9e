// A run that is saved at one moment and goes on in another world is the run that was never stopped,
// to the last bit of every port: under each law, each integrator, and with everything that signals
// remember.
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using simulation::Experiment;
using simulation::Port;

class Observed {
 public:
  explicit Observed(const Experiment& experiment)
      : world(experiment, simulation::make_dts(experiment)), ports(world.ports()) {
    for (const Port& port : ports) {
      if (port.lazy != nullptr) port.lazy->begin();
    }
  }
  void run_to(std::int64_t step) {
    while (world.state().step < step) {
      const simulation::StepStatus status = world.step();
      ASSERT_TRUE(status.ok()) << status.body << ": " << status.advice;
    }
  }
  std::vector<double> values() const {
    std::vector<double> values;
    for (const Port& port : ports) values.push_back(*port.value);
    return values;
  }
  std::vector<double> state() const {
    std::vector<double> state(world.state_size());
    world.save(state);
    return state;
  }

  simulation::World world;
  std::vector<Port> ports;
};

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_same_ports(const Observed& resumed, const std::vector<double>& expected) {
  const std::vector<double> values = resumed.values();
  ASSERT_EQ(values.size(), expected.size());
  int told = 0;
  for (std::size_t i = 0; i < values.size() && told < 5; ++i) {
    if (bits(values[i]) == bits(expected[i])) continue;
    ADD_FAILURE() << resumed.ports[i].trail << " is " << values[i] << ", not " << expected[i];
    ++told;
  }
}

/// Runs to `last` once, saving on the way at each of `moments`; then from each saved state, in a
/// world of its own.
void expect_exact(const Experiment& experiment, const std::vector<std::int64_t>& moments,
                  std::int64_t last) {
  Observed whole(experiment);
  std::vector<std::vector<double>> states, nexts;
  for (const std::int64_t moment : moments) {
    whole.run_to(moment);
    states.push_back(whole.state());
    whole.run_to(moment + 1);
    nexts.push_back(whole.values());
  }
  whole.run_to(last);
  const std::vector<double> end = whole.values(), end_state = whole.state();
  for (std::size_t i = 0; i < moments.size(); ++i) {
    SCOPED_TRACE("resumed after step " + std::to_string(moments[i]));
    Observed resumed(experiment);
    resumed.run_to(i % 2 == 0 ? 0 : 7);  // where it was before does not matter
    resumed.world.restore(states[i]);
    resumed.run_to(moments[i] + 1);
    expect_same_ports(resumed, nexts[i]);
    resumed.run_to(last);
    expect_same_ports(resumed, end);
    EXPECT_EQ(bits(resumed.state().back()), bits(end_state.back()));
  }
}

Experiment loaded(const testing::Workplace& place, const std::string& text) {
  const Loaded result = load_file(place.file("scene.hook", text));
  if (!result.experiment) throw std::runtime_error(result.diagnostics);
  return *result.experiment;
}

/// Everything that remembers: both ways of delay, rates that are no whole number of steps, noise,
/// drifting sensors, a file, a push, a slider, feedback by contact.
std::string walking(const std::string& gait) {
  return R"(World world {
  gravity = 9.81; deltat = 0.5 ms; duration = 2 s; seed = 7;
  Include "materials/rigid_floor.hook" (load = 7 N, allowance = 0.7 mm, damping_ratio = 0.1);
  Terrain.Flat ground { material = rigid_floor; }
  Include "robots/hexapod18.hook" (height = 0.1 m);
  Include "controllers/)" +
         gait + R"(.hook";
  Include "controllers/hexapod_pd.hook" (robot = hexapod, gait = gait);
  Push shove { body = hexapod.base; force = 3, -4, 1; from = 0.6; to = 0.75; edge = 40 ms; }
  Force wind { body = hexapod.leg[2].tibia; force = 0, 0, 0; }
}
Data command { file = "speed.csv"; column = "v"; rate = 37 Hz; }
Wire FROM command.output TO world.gait.forward { rate = 70 Hz; delay = 7 ms; noise = 5 mm/s; }
Sensor.IMU imu {
  body = world.hexapod.base; rate = 300 Hz; delay = 4 ms; mounting = 0.05, 0, 0.02;
  accelerometer_noise = 0.05; gyroscope_noise = 0.01; gyroscope_walk = 0.02; accelerometer_walk = 0.1;
}
Gain turning { rate = 90 Hz; gain = 0.1; Wire FROM imu.gyroscope.z TO input; }
Wire FROM turning.output TO world.gait.turn { delay = 1 ms; }
Signal.Noise gust { standard_deviation = 0.2; seed = 3; rate = 45 Hz; Wire FROM output TO world.wind.force.y; }
Expression smooth { rate = 130 Hz; formula = "(time > 0.3 s ? 0.2 * shake : 0) + 0.8 * previous"; Input shake { Wire FROM imu.gyroscope.y { delay = 6 ms; } } }
StateMachine pulse {
  State off { output = "smooth"; }
  State on { output = "1 + time_in_state / 1 s"; }
  Transition up { from = off; to = on; when = "time_in_state >= 61 ms || smooth > 0.05"; }
  Transition down { from = on; to = off; when = "time_in_state > 23 ms"; }
}
Sensor.Foot foot { body = world.hexapod.leg[0].tibia; rate = 190 Hz; noise = 0.1 N; }
Probe felt { Wire FROM foot.normal TO input { delay = 20 ms; rate = 333 Hz; } }
Probe shaken { Wire FROM world.hexapod.leg[4].tibia.linear_acceleration.x TO input { delay = 3 ms; } }
)";
}

class ResumedWalk : public ::testing::TestWithParam<const char*> {};

TEST_P(ResumedWalk, IsTheWalkThatWasNeverStopped) {
  const testing::Workplace place;
  place.file("speed.csv", "time,v\n0,0.02\n0.4,0.1\n0.9,0.06\n2,0.12\n");
  const Experiment experiment = loaded(place, walking(GetParam()));
  // Before the first sample has arrived, in the stand, in the push, on the walk, one step before
  // the end.
  expect_exact(experiment, {1, 13, 901, 1333, 2000, 2399}, 2400);
}

INSTANTIATE_TEST_SUITE_P(Gaits, ResumedWalk, ::testing::Values("tripod", "cruse"));

/// A block that is thrown on a slope, bounces, tumbles and slides.
std::string thrown(const std::string& world) {
  return R"(World w {
  gravity = 9.81; deltat = 0.5 ms; )" +
         world + R"(
  Material surface { normal_stiffness = 20 kN/m; normal_damping = 40; tangential_stiffness = 20 kN/m;
    tangential_damping = 40; static_friction = 0.9; kinetic_friction = 0.25; restitution = 0.4; }
  Terrain.Slope ground { angle = 15 deg; material = surface; }
  Robot block { Base.mobile { location = 0, 0, 0.12; velocity = 0.5, 0.2, 0; angular_velocity = 0.5, 2, -1;
    Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
}
)";
}

TEST(ResumedThrow, IsExactUnderEveryLaw) {
  const testing::Workplace place;
  for (const contact::LawDescription& law : contact::law_table()) {
    SCOPED_TRACE(law.name);
    const std::string name(law.name);
    expect_exact(loaded(place, thrown("contact = " + name + ";")), {1, 120, 377, 599}, 600);
  }
}

// A slide goes on by kinetic friction only because each point remembers that it slides.
TEST(ResumedSlide, GoesOnSliding) {
  const testing::Workplace place;
  const Experiment experiment = loaded(place, R"(World w {
  gravity = 9.81; deltat = 0.5 ms;
  Material surface { normal_stiffness = 20 kN/m; normal_damping = 40; tangential_stiffness = 20 kN/m;
    tangential_damping = 1; static_friction = 1.2; kinetic_friction = 0.25; }
  Terrain.Flat ground { material = surface; }
  Robot block { Base.mobile { location = 0, 0, 0.0499; velocity = 0.2, 0, 0;
    Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
}
)");
  expect_exact(experiment, {60, 100}, 150);
}

TEST(ResumedLegs, AreExactUnderEveryLaw) {
  const std::filesystem::path configs = testing::source_folder() + "/configs";
  for (const contact::LawDescription& law : contact::law_table()) {
    SCOPED_TRACE(law.name);
    const Loaded result = load_file(configs / "scenes/standing_hexapod.hook",
                                    {{}, {{"world.contact", std::string(law.name)}}});
    ASSERT_TRUE(result.experiment) << result.diagnostics;
    expect_exact(*result.experiment, {1, 23}, 40);
  }
}

TEST(ResumedThrow, IsExactUnderEveryIntegrator) {
  const testing::Workplace place;
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    SCOPED_TRACE(stepper.name);
    const std::string name(stepper.name);
    expect_exact(loaded(place, thrown("integrator = " + name + ";")), {1, 120, 377}, 500);
  }
}

TEST(ResumedThrow, BristlesAreExactUnderAdaptiveIntegrators) {
  const testing::Workplace place;
  for (const char* law : {"lugre", "exponential"}) {
    SCOPED_TRACE(law);
    expect_exact(
        loaded(place, thrown(std::string("integrator = cvode_bdf; contact = ") + law + ";")),
        {1, 120}, 200);
  }
}

// Where dry friction of joints is hooked goes along.
TEST(ResumedDryJoints, AreExactUnderEveryIntegratorAndImpulseLaw) {
  const testing::Workplace place;
  std::vector<std::string> settings{"contact = impulse;"};
  for (const integrators::StepperDescription& stepper : integrators::stepper_table())
    settings.push_back("integrator = " + std::string(stepper.name) + ";");
  for (const std::string& setting : settings) {
    SCOPED_TRACE(setting);
    expect_exact(loaded(place, "World w { deltat = 2 ms; " + setting + R"(
  Robot arm { Base.fixed { location = 0, 0, 2; orientation = 0, 90 deg, 0; } Chain c {
    Link a { mass = 1; center_of_mass = 0.2, 0, 0; inertia = 0.01, 0.01, 0.01, 0, 0, 0; static_friction = 0.6; friction = 0.4; stribeck_velocity = 0.3; rate = 2; }
    Link b { dhlength = 0.4; joint = prismatic; mass = 1; inertia = 0.01, 0.01, 0.01, 0, 0, 0; static_friction = 1.4; friction = 1;
      lower_limit = -0.05; stiffness = 300; } } } }
)"),
                 {1, 60, 200, 333}, 400);
  }
}

TEST(Resumed, PausedAndQuitRunsStayWhatTheyAre) {
  const testing::Workplace place;
  const Experiment experiment = loaded(place, thrown("") + R"(
Signal.Step stop { start = 50 ms; Wire FROM output TO Simulator.quit; }
)");
  Observed whole(experiment);
  whole.run_to(150);
  EXPECT_EQ(whole.world.ended(), "Simulator.quit is true");
  Observed resumed(experiment);
  resumed.world.restore(whole.state());
  EXPECT_EQ(resumed.world.ended(), "Simulator.quit is true");
}

}  // namespace
}  // namespace hookpoint
