// Robots that are kept in a plane against themselves in space, where nothing pushes them out of it;
// against closed forms where something does; in our engine and in every peer that has such a base.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "reference/engines.h"
#include "simulation/analysis/controller_terms.h"
#include "simulation/analysis/stability.h"
#include "tests/support/folders.h"
#include "tests/support/run_text.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using Settings = std::map<std::string, std::string>;

std::string with(std::string text, const Settings& settings) {
  for (const auto& [name, value] : settings)
    for (std::size_t at; (at = text.find("@" + name)) != std::string::npos;)
      text.replace(at, name.size() + 1, value);
  return text;
}

/// A body with a leg that swings in the plane, thrown so that it tumbles and lands; symmetric.
const std::string tumbling = R"(
World w {
  gravity = 9.81;
  deltat = 0.1 ms;
  @world
  Material m { normal_stiffness = 20 kN/m; normal_damping = 60 N.s/m; tangential_stiffness = 20 kN/m; tangential_damping = 60 N.s/m; regularisation_speed = 0.1 m/s; }
  Terrain.Flat ground { material = m; }
  Robot r {
    Base.@base {
      location = 0, 0, 0.4;
      orientation = 0, 0.3, 0;
      velocity = 1, 0, -0.5;
      angular_velocity = 0, 2, 0;
      mass = 3 kg;
      center_of_mass = 0.02, 0, 0.01;
      inertia = 0.03, 0.04, 0.05, 0, 0, 0;
      For x in 0..1 { For y in 0..1 { ContactPoint p[2 * x + y] { location = 0.3 * x - 0.15, 0.2 * y - 0.1, -0.05; } } }
    }
    Chain arm {
      hip_orientation = -90 deg, 0, 0;
      hip_distance = 0.1, 0, 0.05;
      Link rod { mass = 0.7 kg; center_of_mass = 0.1, 0, 0; inertia = 0.001, 0.004, 0.004, 0, 0, 0; angle = 0.4; rate = 1; damping = 0.02; }
    }
  }
}
)";

const std::array watched{"w.r.position.x", "w.r.position.z", "w.r.angular_velocity.y",
                         "w.r.arm.rod.angle"};

/// Greatest difference of what is watched between planar and free over `steps`.
double difference(const std::string& world, simulation::EngineFactory make, int steps) {
  Running planar(with(tumbling, {{"world", world}, {"base", "planar"}}), make);
  Running free(with(tumbling, {{"world", world}, {"base", "mobile"}}), make);
  double most = 0.;
  for (int i = 0; i < steps; ++i) {
    planar.step();
    free.step();
    for (const char* trail : watched) most = std::max(most, std::abs(planar[trail] - free[trail]));
  }
  return most;
}

TEST(PlanarRobot, MovesAsInSpaceWhereNothingPushesItOutOfItsPlane) {
  for (const char* law : {"hookpoint", "nominal", "hunt_crossley", "lugre", "exponential"})
    EXPECT_LT(difference(std::string("contact = ") + law + ";", simulation::make_dts, 6000), 1e-7)
        << law;
  for (const char* integrator : {"explicit_euler", "rk4", "cvode_bdf"})
    EXPECT_LT(difference(std::string("integrator = ") + integrator + ";", simulation::make_dts,
                         integrator[0] == 'c' ? 1000 : 6000),
              1e-6)
        << integrator;
  for (const char* law : {"impulse", "impulse_reversal"})
    EXPECT_LT(difference(std::string("contact = ") + law + ";", simulation::make_dts, 1500), 1e-6)
        << law;
}

// Two steps of the compass walker: what it does in space is plane.
TEST(PlanarRobot, WalksAsInSpace) {
  std::string text =
      testing::read_file(testing::source_folder() + "/configs/scenes/compass_walker.hook");
  Running free(text);
  text.replace(text.find("Base.mobile"), 11, "Base.planar");
  Running planar(text);
  constexpr int steps = 150000;
  free.step(steps);
  planar.step(steps);
  for (const char* trail : {"walker.position.x", "walker.position.z", "walker.leg[0].rod.angle",
                            "walker.leg[1].rod.angle"})
    EXPECT_NEAR(planar[trail], free[trail], 1e-10) << trail;
  EXPECT_GT(planar["walker.position.x"], 0.8) << "it has walked";
  EXPECT_EQ(planar["walker.position.y"], 0.);
}

TEST(PlanarRobot, PeersHaveThePlaneOrSayWhyNot) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!peer.found()) continue;
    const std::string name(peer.name);
    const std::string world = "engine = " + name + ";";
    if (name == "bullet") {
      EXPECT_THROW(difference(world, peer.make, 1), simulation::ExperimentError);
      continue;
    }
    // Until it lands: an engine's contact solver sees another system of equations.
    EXPECT_LT(difference(world, peer.make, 1500), 1e-6) << name;
  }
}

/// A body with a moment and a force of 5 N across its plane, and weight across it where the plane
/// is xy.
const std::string pushed = R"(
World w {
  gravity = 9.81;
  deltat = 1 ms;
  @world
  Robot r { Base.planar { plane = @plane; mass = 2 kg; inertia = 0.2, 0.25, 0.3, 0.01, 0.02, 0.03; center_of_mass = 0.1, 0.05, 0.02; } }
  Force f { body = r.base; point = 0.1, 0.05, 0.02; force = 3, 4, 5; }
}
)";

TEST(PlanarRobot, NothingLeadsItOutOfItsPlane) {
  struct Plane {
    const char *name, *normal, *first, *second;
    double along_first, along_second;  // of the force and the weight [N]
  };
  const double W = 2. * 9.81;
  std::vector<std::pair<std::string, simulation::EngineFactory>> engines{
      {"dts", simulation::make_dts}};
  for (const reference::Peer& peer : reference::peers())
    if (peer.found() && peer.name != std::string_view("bullet"))
      engines.emplace_back(peer.name, peer.make);
  for (const auto& [engine, make] : engines)
    for (const Plane& plane :
         {Plane{"xz", "y", "x", "z", 3., 5. - W}, Plane{"yz", "x", "y", "z", 4., 5. - W},
          Plane{"xy", "z", "x", "y", 3., 4.}}) {
      Running run(with(pushed, {{"world", "engine = " + engine + ";"}, {"plane", plane.name}}),
                  make);
      run.step(200);
      const std::string what = engine + " " + plane.name;
      const double t = 0.2, tolerance = engine == "dts" ? 0. : 1e-9;
      EXPECT_NEAR(run["w.r.position." + std::string(plane.normal)], 0., tolerance) << what;
      for (const std::string axis : {"x", "y", "z"}) {
        if (axis == plane.normal) continue;
        EXPECT_NEAR(run["w.r.angular_velocity." + axis], 0., tolerance) << what;
      }
      // The force acts at the centre of mass: no turn, s = F t^2/2m, to the first order of the
      // step.
      EXPECT_NEAR(run["w.r.position." + std::string(plane.first)], plane.along_first / 4. * t * t,
                  0.01 * t)
          << what;
      EXPECT_NEAR(run["w.r.position." + std::string(plane.second)], plane.along_second / 4. * t * t,
                  0.01 * t)
          << what;
    }
}

TEST(PlanarRobot, KeepsEnergyAndMomentumInFlight) {
  std::string text =
      with(tumbling, {{"world", "gravity = 0; integrator = rk4;"}, {"base", "planar"}});
  text.replace(text.find("  gravity = 9.81;\n"), 18, "");
  text.replace(text.find("damping = 0.02; "), 16, "");
  text.replace(text.find("0, 0, 0.4"), 9, "0, 0, 9.4");
  Running run(text);
  const double before = run["w.r.kinetic_energy"];
  const double x = run["w.r.center_of_mass.x"], z = run["w.r.center_of_mass.z"];
  run.step(1);
  const double vx = (run["w.r.center_of_mass.x"] - x) / 1e-4;
  const double vz = (run["w.r.center_of_mass.z"] - z) / 1e-4;
  run.step(9999);
  EXPECT_NEAR(run["w.r.kinetic_energy"], before, 1e-9 * before);
  EXPECT_NEAR(run["w.r.center_of_mass.x"], x + vx, 1e-8);
  EXPECT_NEAR(run["w.r.center_of_mass.z"], z + vz, 1e-8);
  EXPECT_EQ(run["w.r.position.y"], 0.);
}

TEST(PlanarRobot, ItsLargestStepIsThatOfWhatItCanDo) {
  // One point carries it below its centre: what turns about x has no part in the plane.
  const std::string text = R"(
World w {
  gravity = 9.81;
  Material m { normal_stiffness = 10 kN/m; normal_damping = 20 N.s/m; tangential_stiffness = 10 kN/m; tangential_damping = 20 N.s/m; }
  Terrain.Flat ground { material = m; }
  Robot r { Base.@base { rest_on = ground; mass = 1 kg; inertia = @roll, 10, 10, 0, 0, 0; ContactPoint p { location = 0, 0, -0.2; } } }
}
)";
  const auto bound = [&](const char* base, const char* roll) {
    const Loaded loaded = load_text(with(text, {{"base", base}, {"roll", roll}}));
    return simulation::stability_bound(*loaded.experiment).step;
  };
  EXPECT_LT(bound("mobile", "1e-4"), 0.1 * bound("planar", "1e-4"));
  EXPECT_NEAR(bound("planar", "1e-4"), bound("mobile", "10"), 1e-3 * bound("mobile", "10"));
}

TEST(PlanarRobot, HasThreeCoordinatesForControllers) {
  const Loaded loaded = load_text(with(tumbling, {{"world", ""}, {"base", "planar"}}));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::ControllerTerms planar(*loaded.experiment, 0);
  const Loaded in_space = load_text(with(tumbling, {{"world", ""}, {"base", "mobile"}}));
  const simulation::ControllerTerms free(*in_space.experiment, 0);
  std::vector<std::string> names;
  for (const auto& coordinate : planar.coordinates()) names.push_back(coordinate.trail);
  EXPECT_EQ(names, (std::vector<std::string>{"r.base.angular_velocity.y", "r.base.velocity.x",
                                             "r.base.velocity.z", "r.arm.rod.rate"}));
  const std::vector<double> M = planar.mass_matrix(), all = free.mass_matrix();
  const std::array<std::size_t, 4> of{1, 3, 5, 6};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_EQ(M[4 * i + j], all[7 * of[i] + of[j]]) << i << " " << j;
  const simulation::LinearisedRobot linear = planar.linearised({0.});
  EXPECT_EQ(linear.A.size(), 64u);
  EXPECT_EQ(linear.B.size(), 8u);
}

TEST(PlanarRobot, SaysWhatLeadsOutOfThePlaneAtTheStart) {
  const auto said = [](const std::string& fields) {
    return load_text("World w { Robot r { Base.planar { mass = 1; inertia = 1, 1, 1, 0, 0, 0; " +
                     fields + " } } }")
        .diagnostics;
  };
  EXPECT_NE(said("velocity = 0, 1, 0;").find("leads out of the plane xz"), std::string::npos);
  EXPECT_NE(said("angular_velocity = 1, 1, 0;").find("turns about y alone"), std::string::npos);
  EXPECT_NE(said("plane = yx;").find("yz, xz"), std::string::npos);
  EXPECT_EQ(said("velocity = 1, 0, 1; angular_velocity = 0, 1, 0;"), "");
}

}  // namespace
}  // namespace hookpoint
