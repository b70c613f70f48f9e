// Obstacles and belts in the reference engines, and friction of the materials of both sides.
#include <gtest/gtest.h>

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
  return "World w { engine = " + std::string(peer.name) + "; deltat = 0.2 ms; gravity = 9.81; " +
         fields + " Material floor { static_friction = 0.4; kinetic_friction = 0.4; } " + parts +
         " }";
}

std::string box(const std::string& location, const std::string& more = "") {
  return "Robot box { Base.mobile { location = " + location +
         "; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; " + more + " } } }";
}

const std::string level = "Terrain.Flat ground { material = floor; } ";

bool has_obstacles(const reference::Peer& peer) { return peer.name != "simbody"; }

TEST(PeerObstacles, ABoxStandsOnOne) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!has_obstacles(peer)) continue;
    Running run(world(peer, "",
                      level +
                          "Obstacle.Box post { dimensions = 0.3, 0.3, 0.4; location = 0, 0, 0.2; "
                          "material = floor; } " +
                          box("0, 0, 0.45")),
                peer.make);
    run.step(5000);
    EXPECT_NEAR(run["box.position.z"], 0.45, 2e-3) << peer.name;
  }
}

TEST(PeerObstacles, AWallThatMovesPushesABoxAlong) {
  for (const reference::Peer& peer : reference::peers()) {
    if (!has_obstacles(peer)) continue;
    Running run(world(peer, "",
                      level +
                          "Obstacle.Box wall { dimensions = 0.1, 1, 0.2; location = -0.2, 0, "
                          "0.11; velocity = 0.3, 0, 0; material = floor; } " +
                          box("0, 0, 0.05")),
                peer.make);
    run.step(10000);  // 2 s: the wall's face is at -0.15 + 0.6
    EXPECT_NEAR(run["wall.position.x"], -0.2 + 0.6, 1e-9) << peer.name;
    EXPECT_NEAR(run["box.position.x"], 0.5, 0.01) << peer.name;
    EXPECT_NEAR(run["box.velocity.x"], 0.3, 0.05) << peer.name;
  }
}

/// A box put down at rest on what moves at 0.5 m/s slips by v^2/(2 mu g), then rides.
void expect_ride(const reference::Peer& peer, const std::string& parts, double z) {
  Running run(world(peer, "", parts + box("0, 0, " + std::to_string(z))), peer.make);
  run.step(5000);
  EXPECT_NEAR(run["box.velocity.x"], 0.5, 0.01) << peer.name;
  EXPECT_NEAR(0.5 - run["box.position.x"], 0.25 / (2. * 0.4 * g), 2e-3) << peer.name;
  EXPECT_NEAR(run["box.position.y"], 0., 1e-3) << peer.name;
}

TEST(PeerObstacles, ABoxRidesAPlateThatMoves) {
  for (const reference::Peer& peer : reference::peers())
    if (has_obstacles(peer))
      expect_ride(peer,
                  level +
                      "Obstacle.Box plate { dimensions = 1, 1, 0.2; location = 0, 0, 0.3; velocity "
                      "= 0.5, 0, 0; material = floor; } ",
                  0.45);
}

TEST(PeerObstacles, ABoxRidesABelt) {
  for (const reference::Peer& peer : reference::peers())
    if (has_obstacles(peer))
      expect_ride(peer, "Terrain.Flat belt { material = floor; velocity = 0.5, 0, 0; } ", 0.05);
}

// What an engine has not it names, with what to do.
TEST(PeerObstacles, SaysWhatDoesNotMove) {
  for (const reference::Peer& peer : reference::peers()) {
    const std::string text = world(
        peer, "",
        "Terrain.Flat lift { material = floor; frame_velocity = 0, 0, 0.1; } " + box("0, 0, 0.05"));
    try {
      Running run(text, peer.make);
      ADD_FAILURE() << peer.name;
    } catch (const simulation::ExperimentError& error) {
      EXPECT_NE(std::string(error.what()).find("make what moves an Obstacle"), std::string::npos)
          << error.what();
    }
  }
}

/// Acceleration down a slope of a box of 0.8 on ground of 0.5 [m/s^2].
double slide(const reference::Peer& peer, double angle, const std::string& combine,
             const std::string& settings) {
  const std::string slope = std::to_string(angle);
  Running run(
      world(peer, "settings = " + settings + "; combine = " + combine + ";",
            "Material rubber { static_friction = 0.8; kinetic_friction = 0.8; } Material slab "
            "{ static_friction = 0.5; kinetic_friction = 0.5; } Terrain.Slope ground { angle "
            "= " +
                slope +
                " deg; material = slab; } Robot box { Base.mobile { rest_on = "
                "ground; Shape.Box { dimensions = 0.2, 0.2, 0.04; mass = 1; material = rubber; } "
                "} }"),
      peer.make);
  const auto speed = [&] { return std::hypot(run["box.velocity.x"], run["box.velocity.z"]); };
  run.step(2000);
  const double before = speed();
  run.step(2000);
  return (speed() - before) / 0.4;
}

// It sticks up to tan = mu and slides with g (sin - mu cos) beyond, mu = 0.8 x 0.5 and min(0.8, 0.5),
// which no engine makes of two coefficients by itself in both cases.
TEST(PeerMaterials, TheCriticalSlopeIsThatOfBothSides) {
  for (const auto& [combine, mu] : {std::pair{"product", 0.4}, std::pair{"minimum", 0.5}})
    for (const reference::Peer& peer : reference::peers())
      for (const char* settings : {"default", "matched"}) {
        const double critical = std::atan(mu) / degree;
        EXPECT_NEAR(slide(peer, critical - 1.5, combine, settings), 0., 0.02)
            << peer.name << settings << combine;
        const double angle = (critical + 4.) * degree;
        const double slides = g * (std::sin(angle) - mu * std::cos(angle));
        EXPECT_NEAR(slide(peer, critical + 4., combine, settings), slides, 0.05 * slides)
            << peer.name << settings << combine;
      }
}

// A sled of which the front pad, of 0.1, carries N1 and the rear one, of 0.7, N2: N1 + N2 = m g cos and
// (N1 - N2) l = h (mu1 N1 + mu2 N2). dWorldStep and DART take mu N of the loads without friction, which are equal.
TEST(PeerMaterials, ShapesOfOneBodyHaveTheirOwn) {
  const double l = 0.1, h = 0.05, front = 0.1, rear = 0.7;
  const double share = (l + h * rear) / (2. * l + h * (rear - front));
  for (const reference::Peer& peer : reference::peers()) {
    Running run(
        world(
            peer, "",
            "Material steel { static_friction = 0.1; kinetic_friction = 0.1; } Material "
            "rubber { static_friction = 0.7; kinetic_friction = 0.7; } Terrain.Slope ground "
            "{ angle = 30 deg; material = floor; } Robot box { Base.mobile { location = "
            "0.025, 0, 0.05 * cos(30 deg); orientation = 0, 30 deg, 0; mass = 2; center_of_mass = 0, 0, 0; inertia = "
            "0.02, 0.02, 0.02, 0, 0, 0; Shape.Box { dimensions = 0.01, 0.2, 0.01; location = "
            "0.1, 0, -0.045; material = steel; } Shape.Box { dimensions = 0.01, 0.2, 0.01; "
            "location = -0.1, 0, -0.045; material = rubber; } } }"),
        peer.make);
    const auto speed = [&] { return std::hypot(run["box.velocity.x"], run["box.velocity.z"]); };
    run.step(1000);
    const double before = speed();
    run.step(1500);
    const bool even = peer.name == "ode" || peer.name == "dart";
    const double mu = even ? 0.5 * (front + rear) : share * front + (1. - share) * rear;
    const double slides = g * (0.5 - mu * std::sqrt(0.75));
    EXPECT_NEAR((speed() - before) / 0.3, slides, 0.05 * slides) << peer.name;
  }
}

// At `matched` four corners of 20 kN/m on ground of 60 kN/m are springs of 15 kN/m: depth m g/(4 k).
TEST(PeerMaterials, SpringsOfBothSidesAreInSeries) {
  for (const reference::Peer& peer : reference::peers()) {
    Running run(
        world(peer, "settings = matched;",
              "Material soft { normal_stiffness = 20000; normal_damping = 200; } Material hard "
              "{ normal_stiffness = 60000; normal_damping = 600; } Terrain.Flat ground { "
              "material = hard; } " +
                  box("0, 0, 0.05", "material = soft;")),
        peer.make);
    run.step(5000);
    EXPECT_NEAR(0.05 - run["box.position.z"], g / (4. * 15000.), 2e-6) << peer.name;
  }
}

// Gravity that a wire drives would be that of the start.
TEST(PeerObstacles, GravityIsNotDriven) {
  for (const reference::Peer& peer : reference::peers()) {
    const std::string text =
        world(peer, "",
              level + box("0, 0, 0.05") + " Signal.Sine s { amplitude = 1; Wire TO gravity.x; }");
    EXPECT_THROW(Running(text, peer.make), simulation::ExperimentError) << peer.name;
  }
}

}  // namespace
}  // namespace hookpoint
