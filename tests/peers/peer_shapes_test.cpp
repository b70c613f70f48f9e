// The shapes of robots in the reference engines under `touch = shapes`: wheels of robots with chains,
// stairs with vertical risers, and what an engine does with a shape that it has not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;
constexpr double degree = std::numbers::pi / 180.;

std::string world(const reference::Peer& peer, const std::string& fields,
                  const std::string& parts) {
  return "World w { engine = " + std::string(peer.name) + "; deltat = 1 ms; gravity = 9.81; " +
         fields + " Material floor { static_friction = 0.8; kinetic_friction = 0.8; } " + parts +
         " }";
}

/// A frame of 1 kg on the axle of a roller of 2 kg, which is its link.
std::string roller(const std::string& touch, const reference::Peer& peer,
                   const std::string& samples = "") {
  return world(
      peer, "touch = " + touch + ";",
      "Terrain.Slope ground { angle = 10 deg; material = floor; } Robot cart { Base.mobile "
      "{ location = 0.1 * sin(10 deg), 0, 0.1 * cos(10 deg); orientation = pi/2, 0, 0; "
      "mass = 1; inertia = 0.01, 0.01, 0.01, 0, 0, 0; } Chain axle { Link wheel { "
      "Shape.Cylinder { radius = 0.1; length = 0.2; mass = 2; " +
          samples + " } } } }");
}

double speed_after(const std::string& text, const reference::Peer& peer, int steps) {
  Running run(text, peer.make);
  run.step(steps);
  return std::hypot(run["cart.velocity.x"], run["cart.velocity.z"]);
}

/// Simbody has none; of one that lies DART's detector finds the contact uphill, and it stands.
bool rolls_cylinders(const reference::Peer& peer) {
  return peer.name != "simbody" && peer.name != "dart";
}
bool has_stairs(const reference::Peer& peer) { return peer.name != "simbody"; }

// 3 kg a = 3 kg g sin - F, J a/r = F r with J = 2 kg r^2/2: a = 3/4 g sin. A rim of eight points stands.
TEST(PeerShapes, AWheelOfARobotWithChainsRolls) {
  const double rolls = 0.75 * g * std::sin(10. * degree);
  for (const reference::Peer& peer : reference::peers()) {
    EXPECT_LT(speed_after(roller("points", peer), peer, 1000), 0.3 * rolls) << peer.name;
    if (!rolls_cylinders(peer)) continue;
    EXPECT_NEAR(speed_after(roller("shapes", peer), peer, 1000), rolls, 0.03 * rolls) << peer.name;
  }
}

// A shape that says how it is to be sampled is so under both.
TEST(PeerShapes, TouchByTheSamplesThatTheFileAsksFor) {
  for (const reference::Peer& peer : reference::peers())
    EXPECT_EQ(speed_after(roller("shapes", peer, "boundary_points = 8;"), peer, 500),
              speed_after(roller("points", peer), peer, 500))
        << peer.name;
}

// Its samples touch in place of the shape, which a notice says; a box has no need of one.
TEST(PeerShapes, ThatAnEngineLacksTouchByTheirSamples) {
  for (const reference::Peer& peer : reference::peers()) {
    const auto notices = [&](const std::string& shape) {
      Running run(world(peer, "",
                        "Terrain.Flat ground { material = floor; } Robot r { Base.mobile { "
                        "location = 0, 0, 0.05; " +
                            shape + " } }"),
                  peer.make);
      run.step(300);
      EXPECT_NEAR(run["r.position.z"], 0.05, 2e-3) << peer.name << shape;
      return run.world().state().notices;
    };
    EXPECT_TRUE(notices("Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; }").empty())
        << peer.name;
    const bool lacks_cones = peer.name != "bullet" && peer.name != "mujoco";
    const auto of_cone = notices(
        "Shape.Legcone { location = 0, 0, -0.05; orientation = 0, -pi/2, 0; length = 0.1; "
        "proximal_radius = 0.05; distal_radius = 0.03; mass = 1; }");
    EXPECT_EQ(std::ranges::any_of(of_cone,
                                  [](const std::string& notice) {
                                    return notice.find("Legcone") != std::string::npos;
                                  }),
              lacks_cones)
        << peer.name;
  }
}

// A riser is vertical: a ball that runs into it has its centre a radius before it, and stays down.
TEST(PeerShapes, ARiserStopsABallARadiusBeforeIt) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!has_stairs(peer)) continue;
    Running run(
        world(peer, "",
              "Terrain.Steps stairs { height = 0.2; run = 0.5; from = 0.5; count = 2; size = "
              "4, 2; material = floor; } Robot ball { Base.mobile { location = 0.3, 0, 0.05; "
              "velocity = 1, 0, 0; Shape.Sphere { radius = 0.05; mass = 1; } } }"),
        peer.make);
    double farthest = 0., highest = 0.;
    for (int i = 0; i < 500; ++i) {
      run.step();
      farthest = std::max(farthest, run["ball.position.x"]);
      highest = std::max(highest, run["ball.position.z"]);
    }
    EXPECT_NEAR(farthest, 0.45, 6e-3) << peer.name;
    EXPECT_LT(highest, 0.08) << peer.name;
  }
}

// 60 % of a sole are over the tread, its centre among them.
TEST(PeerShapes, ASoleStandsOnTheEdgeOfAStep) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!has_stairs(peer)) continue;
    Running run(
        world(peer, "",
              "Terrain.Steps step { height = -0.1; run = 2; from = 0.5; count = 1; size = 3, "
              "1; material = floor; } Robot sole { Base.mobile { location = 0.48, 0, 0.01; "
              "Shape.Box { dimensions = 0.2, 0.1, 0.02; mass = 1; } } }"),
        peer.make);
    run.step(1000);
    EXPECT_NEAR(run["sole.position.z"], 0.01, 2e-3) << peer.name;
  }
}

// g (sin - mu cos) = 0.657 m/s^2, as on its corners. Of MuJoCo and Simbody friction creeps, and the table
// leans.
TEST(PeerShapes, ATableOnBallsSlides) {
  for (const reference::Peer& peer : reference::peers()) {
    if (peer.name == "mujoco" || peer.name == "simbody") continue;
    Running run(
        "World w { engine = " + std::string(peer.name) +
            "; deltat = 1 ms; gravity = 9.81; touch = shapes; Material floor { "
            "static_friction = 0.5; kinetic_friction = 0.5; } Terrain.Slope hill { angle = 30 deg; "
            "material = floor; } Robot table { Base.mobile { rest_on = hill; Shape.Box { dimensions = "
            "0.6, 0.4, 0.05; location = 0, 0, 0.1; mass = 10 kg; contact = false; } For x in "
            "-0.25, 0.25 { For y in -0.15, 0.15 { Shape.Sphere { radius = 30 mm; location = x, y, 0; "
            "mass = 0.1 kg; } } } } } }",
        peer.make);
    const auto speed = [&] { return std::hypot(run["table.velocity.x"], run["table.velocity.z"]); };
    run.step(1000);
    const double before = speed();
    run.step(1000);
    EXPECT_NEAR(speed() - before, g * (std::sin(30. * degree) - 0.5 * std::cos(30. * degree)), 0.01)
        << peer.name;
  }
}

}  // namespace
}  // namespace hookpoint
