// What lies on the flat end of a drum, a cone or a disc, or beside it, against closed forms: the side
// behind the end, however deep the body is inside of it, is no way out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, friction = 0.3, speed = 0.8;

const std::string material =
    "Material s { normal_stiffness = 50 kN/m; normal_damping = 100; tangential_stiffness = 50 kN/m; "
    "tangential_damping = 100; static_friction = 0.3; kinetic_friction = 0.3; } ";

struct Solid {
  std::string name;
  std::string text;
  double height = 0.;  ///< of its origin over the end on which it lies
};

/// Standing on the floor, or lying on something, with 1 kg.
const std::vector<Solid> uppers{
    {"tin", "Shape.Cylinder { radius = 0.05; length = 0.02; mass = 1 kg; }", 0.01},
    {"box", "Shape.Box { dimensions = 0.1, 0.08, 0.02; mass = 1 kg; }", 0.01},
    {"hull",
     "Shape.Hull { points = -0.05,-0.05,-0.01, 0.05,-0.05,-0.01, 0.05,0.05,-0.01, "
     "-0.05,0.05,-0.01, 0,0,0.01; mass = 1 kg; }",
     0.01},
    {"disc", "Shape.Disc { radius = 0.05; mass = 1 kg; }", 0.},
    {"cone",
     "Shape.Legcone { length = 0.03; proximal_radius = 0.05; distal_radius = 0.01; orientation = 0, "
     "-pi/2, 0; mass = 1 kg; }",
     0.}};

/// With an end at z = 0.
const std::vector<Solid> lowers{
    {"drum", "Shape.Cylinder { radius = 0.5; length = 0.2; location = 0,0,-0.1; }"},
    {"plate", "Shape.Cylinder { radius = 0.5; length = 0.02; location = 0,0,-0.01; }"},
    {"cone",
     "Shape.Legcone { length = 0.3; proximal_radius = 0.7; distal_radius = 0.5; orientation = 0, "
     "-pi/2, 0; location = 0,0,-0.3; }"},
    {"wide cone",
     "Shape.Legcone { length = 0.3; proximal_radius = 0.3; distal_radius = 0.5; orientation = 0, "
     "-pi/2, 0; location = 0,0,-0.3; }"},
    {"disc", "Shape.Disc { radius = 0.5; }"}};

std::string on(const Solid& lower, const Solid& upper, const std::string& place,
               const std::string& fields) {
  return "World w { " + fields + " " + material + " Robot l { Base.fixed { material = s; " +
         lower.text + " } } Robot b { Base.mobile { " + place + " " + upper.text + " } } }";
}

// v^2 / (2 mu g), inward over the middle and outward.
TEST(RoundEnds, BodiesSlideOnThemAsOnAPlane) {
  const double way = speed * speed / (2. * friction * g);
  for (const Solid& lower : lowers) {
    for (const Solid& upper : uppers) {
      for (const double from : {-0.2, 0.1}) {
        Running run(on(lower, upper,
                       fmt::format("location = {}, 0.05, {}; velocity = {}, 0, 0;", from,
                                   upper.height + 1e-4, speed),
                       "deltat = 0.1 ms;"));
        run.step(5000);
        EXPECT_NEAR(run["w.b.position.x"] - from, way, 0.02 * way)
            << upper.name << " on " << lower.name << " from " << from;
        EXPECT_NEAR(run["w.b.position.y"], 0.05, 5e-4) << upper.name << " on " << lower.name;
      }
    }
  }
}

// Placed exactly, a micrometre inside and above: it stays, and sinks by m g / (n k) on n places of
// stiffness k, three at least.
TEST(RoundEnds, WhatTouchesAtTheStartRests) {
  for (const Solid& lower : lowers) {
    for (const Solid& upper : uppers) {
      for (const double above : {0., -1e-6, 1e-6}) {
        // Of two discs in one plane nobody can say which is above.
        if (above <= 0. && lower.name == upper.name) continue;
        Running run(on(lower, upper, fmt::format("location = 0.3, 0, {};", upper.height + above),
                       "deltat = 0.1 ms;"));
        run.step(3000);
        const std::string who = fmt::format("{} on {}, {} m above", upper.name, lower.name, above);
        EXPECT_NEAR(run["w.b.position.x"], 0.3, 1e-5) << who;
        EXPECT_LT(run["w.b.position.z"] - upper.height, 1e-6) << who;
        EXPECT_GT(run["w.b.position.z"] - upper.height, -1.2 * g / (3. * 50e3)) << who;
      }
    }
  }
}

// Nothing touches: nothing moves.
TEST(RoundEnds, AWideEndPushesNothingThatIsAboveIt) {
  std::vector<Solid> above = uppers;
  above.push_back(
      {"capsule",
       "Shape.Capsule { radius = 0.03; length = 0.1; orientation = 0, pi/2, 0; mass = 1 kg; }",
       0.03});
  for (const double radius : {0.2, 0.3, 0.36}) {
    const Solid cone{
        "cone", fmt::format("Shape.Legcone {{ length = 0.3; proximal_radius = {}; distal_radius "
                            "= 0.4; orientation = 0, -pi/2, 0; location = 0,0,-0.3; }}",
                            radius)};
    for (const Solid& upper : above) {
      for (const double gap : {0.01, 0.1, 0.2}) {
        Running run(on(cone, upper, fmt::format("location = 0.013, 0.007, {};", upper.height + gap),
                       "gravity = 0; deltat = 0.1 ms;"));
        run.step(500);
        EXPECT_EQ(run["w.b.velocity.z"], 0.) << upper.name << " " << gap << " m above, " << radius;
        EXPECT_EQ(run["w.b.velocity.x"], 0.) << upper.name << " " << gap << " m above, " << radius;
      }
    }
  }
}

// A side still holds what comes against it between the ends: a box that is pushed by F sinks in by F/k
// at each of the places where an edge of it crosses the side.
TEST(RoundEnds, ASideHoldsWhatIsPushedAgainstIt) {
  Running run(
      "World w { gravity = 0; deltat = 0.1 ms; " + material +
      "Robot l { Base.fixed { material = s; Shape.Cylinder { radius = 0.2; length = 0.5; } } } "
      "Robot b { Base.mobile { location = 0.2501, 0, 0; orientation = pi/4, 0, 0; Shape.Box { "
      "dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } } Force push { body = b.base; force = -20, 0, 0; } }");
  run.step(10000);
  EXPECT_NEAR(run["w.b.position.x"], 0.25, 1e-3);
  EXPECT_NEAR(run["w.b.velocity.x"], 0., 1e-3);
}

/// Cubes that touch with equal faces, one turned by right angles: their corners coincide to rounding, and
/// belong to the faces that press. On four corners they sink in by 2 m g / 4 k and m g / 4 k, on two, where
/// the others are beside the other cube to rounding, by twice that.
TEST(RoundEnds, EqualCubesStandOnEachOtherHoweverTheyAreTurned) {
  for (const char* turn : {"0, 0, 0", "pi/2, 0, 0", "0, pi/2, 0", "0, 0, pi/2", "pi, 0, 0",
                           "pi/2, 0, pi/2", "pi/2, pi/2, 0"}) {
    for (const double above : {0., 1e-7, -1e-7, 1e-4}) {
      Running run(
          "World w { deltat = 0.1 ms; " + material +
          "Terrain.Flat floor { material = s; } Robot a { Base.mobile { location = 0, 0, "
          "0.05; material = s; Shape.Box { dimensions = 0.1,0.1,0.1; mass = 1; } } } " +
          fmt::format("Robot b {{ Base.mobile {{ location = 0, 0, {}; orientation = {}; "
                      "material = s; Shape.Box {{ dimensions = 0.1,0.1,0.1; mass = 1; }} }} "
                      "}} }}",
                      0.15 + above, turn));
      run.step(5000);
      const std::string who = fmt::format("turned by {}, {} m above", turn, above);
      constexpr double sinkage = 3. * g / (4. * 50e3);
      EXPECT_NEAR(run["w.b.position.x"], 0., 2. * sinkage) << who;
      EXPECT_NEAR(run["w.b.position.y"], 0., 2. * sinkage) << who;
      EXPECT_LT(run["w.b.position.z"], 0.15 - 0.99 * sinkage) << who;
      EXPECT_GT(run["w.b.position.z"], 0.15 - 2.01 * sinkage) << who;
    }
  }
}

}  // namespace
}  // namespace hookpoint
