// Shapes that touch as they are: wheels, edges, grooves, corners, stairs and other bodies, against
// closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;
const double deg = std::numbers::pi / 180.;

/// A World with one Material, `ground`.
std::string yard(const std::string& fields, const std::string& content,
                 const std::string& material = "static_friction = 0.8;") {
  return std::string("World yard { touch = shapes; ") +
         (fields.find("gravity") == fields.npos ? "gravity = 9.81; " : "") + fields +
         " Material ground { normal_stiffness = 100 kN/m; normal_damping = 300 N.s/m; "
         "tangential_stiffness = 100 kN/m; tangential_damping = 300 N.s/m; " +
         material + " } " + content + " }";
}
const std::string slope = "Terrain.Slope floor { angle = 5 deg; material = ground; } ";
const std::string flat = "Terrain.Flat floor { material = ground; } ";

/// A shape of radius 0.09 whose centre lies 0.09 m over the slope, let go.
std::string rolling(const std::string& shape) {
  return slope + "Robot wheel { Base.mobile { location = 0.09*sin(5 deg), 0, 0.09*cos(5 deg); " +
         shape + " } }";
}

double downhill_speed(Running& run) {
  return run["yard.wheel.velocity.x"] * std::cos(5. * deg) -
         run["yard.wheel.velocity.z"] * std::sin(5. * deg);
}

// a = g sin / (1 + I/(m r^2)): 2/3 of g sin for a solid cylinder, 1/2 for a tube, whatever its material.
TEST(ShapeContact, CylindersRollDown) {
  const std::string tube =
      "mass = 2 kg; inertia = 0.01, 2*0.09^2, 0.01, 0, 0, 0; Shape.Cylinder { orientation = pi/2, 0, "
      "0; radius = 0.09; length = 0.04; }";
  const std::string solid =
      "orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.09; length = 0.04; mass = 2 kg; }";
  for (const auto& [shape, part] : {std::pair{solid, 2. / 3.}, std::pair{tube, 0.5}}) {
    Running run(yard("deltat = 0.1 ms;", rolling(shape)));
    run.step(2000);
    const double before = downhill_speed(run);
    run.step(5000);
    EXPECT_NEAR((downhill_speed(run) - before) / 0.5, part * g * std::sin(5. * deg), 1e-4);
  }
}

// Every law and a Runge-Kutta method: the truth does not depend on them.
TEST(ShapeContact, AWheelRollsUnderEveryLaw) {
  const std::string solid =
      "orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.09; length = 0.04; mass = 2 kg; }";
  for (const char* law : {"hookpoint_reset", "nominal", "hunt_crossley", "azad_featherstone",
                          "lugre", "elastoplastic", "exponential"}) {
    Running run(yard(std::string("deltat = 0.05 ms; contact = ") + law + "; ", rolling(solid)));
    run.step(8000);
    const double before = downhill_speed(run);
    run.step(8000);
    EXPECT_NEAR((downhill_speed(run) - before) / 0.4, 2. / 3. * g * std::sin(5. * deg), 0.01)
        << law;
  }
}

// A tin stands on three points of its rim, k each; lying it stands on two.
TEST(ShapeContact, ATinStandsAndLies) {
  Running run(
      yard("deltat = 0.1 ms;",
           flat + "Robot up { Base.mobile { location = 0, 0, 0.1; Shape.Cylinder { radius = "
                  "0.05; length = 0.2; mass = 1 kg; } } } Robot down { Base.mobile { location = "
                  "1, 0, 0.05; orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.05; length "
                  "= 0.2; mass = 1 kg; } } }"));
  run.step(20000);
  EXPECT_NEAR(run["yard.up.position.z"], 0.1 - g / 3e5, 1e-9);
  EXPECT_NEAR(run["yard.down.position.z"], 0.05 - g / 2e5, 1e-9);
  EXPECT_NEAR(run["yard.up.position.x"], 0., 1e-9);
}

const char* const stairs_down =
    "Terrain.Steps stairs { height = -0.17; run = 3; from = 0.5; count = 1; spacing = 10 mm; size = 4, "
    "1; material = ground; } ";

std::string sole(double over) {
  return stairs_down + std::string("Robot foot { Base.mobile { location = 0.5 - 0.12 + 0.24*") +
         std::to_string(over) +
         ", 0, 0.02; Shape.Box { dimensions = 0.24, 0.12, 0.04; mass = 20 kg; } } }";
}

TEST(ShapeContact, ASoleWithItsCentreOverTheTreadStands) {
  Running run(yard("deltat = 0.1 ms;", sole(0.4)));
  run.step(20000);
  EXPECT_NEAR(run["yard.foot.position.z"], 0.0195, 5e-4);
  EXPECT_NEAR(run["yard.foot.orientation.y"], 0., 5e-3);
  EXPECT_LT(std::abs(run["yard.foot.angular_velocity.y"]), 1e-6);
}

// Its centre d past the nosing and h above it, it turns about the nosing: what its centre has lost in
// height at the angle q is in the turn, I w^2/2 = m g (h (1 - cos q) + d sin q).
TEST(ShapeContact, ASoleWithItsCentreInTheAirTips) {
  const double d = 0.024, h = 0.02, m = 20.;
  const double inertia = m * (0.24 * 0.24 + 0.04 * 0.04) / 12. + m * (d * d + h * h);
  Running run(yard("deltat = 0.05 ms;", sole(0.6)));
  const double start = 2. * std::asin(run["yard.foot.orientation.y"]);
  while (2. * std::asin(run["yard.foot.orientation.y"]) - start < 0.3) run.step(10);
  const double q = 2. * std::asin(run["yard.foot.orientation.y"]);
  const double w = run["yard.foot.angular_velocity.y"];
  EXPECT_NEAR(0.5 * inertia * w * w, m * g * (h * (1. - std::cos(q)) + d * std::sin(q)),
              0.04 * 0.5 * inertia * w * w);
}

// Gravity at 45 degrees lays a ball into the corner of tread and riser: each carries its part.
TEST(ShapeContact, ABallRestsInACorner) {
  Running run(
      yard("deltat = 0.05 ms; gravity = 6.936718, 0, -6.936718;",
           "Terrain.Steps stairs { height = 0.1; run = 2; from = 0.5; count = 1; spacing = 5 "
           "mm; size = 3, 0.5; material = ground; } Robot ball { Base.mobile { location = "
           "0.45, 0, 0.02; Shape.Sphere { radius = 0.02; mass = 1 kg; } } }",
           "static_friction = 0; kinetic_friction = 0;"));
  run.step(40000);
  EXPECT_NEAR(run["yard.ball.position.x"], 0.48 + 6.936718e-5, 1e-7);
  EXPECT_NEAR(run["yard.ball.position.z"], 0.02 - 6.936718e-5, 1e-7);
}

// A ball that runs into a riser comes back; it is neither thrown nor let through.
TEST(ShapeContact, ABallThatRunsIntoARiserComesBack) {
  for (const double speed : {0.5, 3., 12.}) {
    Running run(
        yard("deltat = 0.02 ms; gravity = 0;",
             "Terrain.Steps stairs { height = 0.1; run = 2; from = 0.5; count = 1; spacing = 5 "
             "mm; size = 3, 0.5; material = ground; } Robot ball { Base.mobile { location = "
             "0.4, 0, 0.05; velocity = " +
                 std::to_string(speed) + ", 0, 0; Shape.Sphere { radius = 0.02; mass = 1 kg; } } }",
             "static_friction = 0;"));
    run.step(static_cast<int>(0.25 / speed / 2e-5));
    const double back = -run["yard.ball.velocity.x"];
    EXPECT_GT(back, 0.) << speed;
    EXPECT_LE(back, speed) << speed;
    EXPECT_LT(std::abs(run["yard.ball.velocity.z"]), 1e-9 * speed + 1e-12) << speed;
  }
}

// Tiles of a plane are one face: the same bytes as on the plane.
TEST(ShapeContact, TilesOfAPlaneAreThePlane) {
  const std::string robots =
      "Robot ball { Base.mobile { location = -0.3, 0.01, 0.1; velocity = 1, 0.3, 0; Shape.Sphere { "
      "radius = 0.05; mass = 1 kg; } } } Robot box { Base.mobile { location = 0.4, 0, 0.12; velocity = "
      "1, 0, 0; orientation = 0.1, 0.2, 0.3; Shape.Box { dimensions = 0.2, 0.1, 0.1; mass = 1 kg; } } }";
  const auto end = [&](const std::string& terrain) {
    Running run(yard("deltat = 0.1 ms;", terrain + robots));
    run.step(8000);
    return std::array{run["yard.ball.position.x"], run["yard.ball.position.z"],
                      run["yard.box.position.x"], run["yard.box.position.z"],
                      run["yard.box.orientation.y"]};
  };
  EXPECT_EQ(end(flat),
            end("Terrain.Rough floor { amplitude = 0; wavelength = 1; spacing = 0.07; size "
                "= 4, 4; material = ground; } "));
}

// Momentum of two bodies that meet is that before, to rounding.
TEST(ShapeContact, BodiesThatMeetKeepTheirMomentum) {
  Running run(
      yard("deltat = 0.05 ms; gravity = 0;",
           "Robot ball { Base.mobile { location = 0, 0, 0; velocity = 1, 0, 0; Shape.Sphere { "
           "radius = 0.1; mass = 0.4 kg; } } } Robot box { Base.mobile { location = 0.26, 0.03, "
           "0.02; Shape.Box { dimensions = 0.3, 0.3, 0.3; mass = 2 kg; } } } Terrain.Flat floor "
           "{ height = -9; material = ground; }"));
  double most = 0.;
  for (int i = 0; i < 100; ++i) {
    run.step(100);
    const auto sum = [&](const char* axis) {
      const std::string velocity = std::string(".velocity.") + axis;
      return 0.4 * run["yard.ball" + velocity] + 2. * run["yard.box" + velocity];
    };
    most = std::max({most, std::abs(sum("x") - 0.4), std::abs(sum("y")), std::abs(sum("z"))});
  }
  EXPECT_LT(most, 1e-13);
  EXPECT_GT(run["yard.box.velocity.x"], 0.01);
}

// Flush or shifted, a box on a box rests, with its weight on the springs between them.
TEST(ShapeContact, BoxesRestOnBoxes) {
  for (const char* shift : {"0, 0", "0.013, 0", "0.013, 0.007"}) {
    Running run(yard("deltat = 0.1 ms;",
                     flat +
                         "Robot a { Base.mobile { location = 0, 0, 0.05; Shape.Box { dimensions = "
                         "0.1, 0.1, 0.1; mass = 1 kg; } } } Robot b { Base.mobile { location = " +
                         shift +
                         ", 0.15; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } }"));
    run.step(15000);
    EXPECT_NEAR(run["yard.a.position.z"], 0.05 - 2. * g / 4e5, 1e-6) << shift;
    EXPECT_NEAR(run["yard.b.position.z"], 0.15 - 3. * g / 4e5, 5e-5) << shift;
    for (const char* axis : {"x", "y", "z"})
      EXPECT_LT(std::abs(run[std::string("yard.b.velocity.") + axis]), 1e-6) << shift;
  }
}

// A state that is saved and restored goes on with the same bytes: hooks, faces that hold corners, and
// where everything stood.
TEST(ShapeContact, ASavedStateGoesOnAlike) {
  for (const char* law : {"hookpoint", "lugre"}) {
    Running run(
        yard(std::string("deltat = 0.1 ms; contact = ") + law + ";",
             std::string(stairs_down) +
                 "Robot foot { Base.mobile { location = 0.4, 0, 0.03; velocity = 0.5, 0, 0; "
                 "Shape.Box { dimensions = 0.24, 0.12, 0.04; mass = 2 kg; } } } Robot tin { "
                 "Base.mobile { location = 0.4, 0.02, 0.12; orientation = 0.3, 0, 0; "
                 "Shape.Cylinder { radius = 0.03; length = 0.1; mass = 1 kg; } } }"));
    run.step(1500);
    simulation::World& world = run.world();
    std::vector<double> numbers(world.state_size());
    world.save(numbers);
    const auto go_on = [&] {
      run.step(1500);
      std::vector<double> end(world.state_size());
      world.save(end);
      return end;
    };
    const std::vector<double> first = go_on();
    world.restore(numbers);
    EXPECT_EQ(go_on(), first) << law;
  }
}

// What is saved is what evolves: of boxes that have left the ground a new world has the same state as
// the one in which they touched it before.
TEST(ShapeContact, ASavedStateHoldsNothingOfContactsThatAreOver) {
  const std::string leaping = yard(
      "deltat = 0.2 ms;",
      flat +
          "For i in 0..1 { Robot box[i] { Base.mobile { location = i, 0, 0.0496; velocity = 0, "
          "0, 0.5; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } } }");
  Running run(leaping);
  std::vector<simulation::ContactView> contacts;
  run.step(1);
  run.world().tell_contacts(contacts);
  EXPECT_EQ(contacts.size(), 8u);
  run.step(100);
  run.world().tell_contacts(contacts);
  EXPECT_TRUE(contacts.empty());
  std::vector<double> middle(run.world().state_size()), end(middle.size()),
      other_end(middle.size());
  run.world().save(middle);
  run.step(5);
  run.world().save(end);
  Running other(leaping);
  other.world().restore(middle);
  other.step(5);
  other.world().save(other_end);
  EXPECT_EQ(other_end, end);
}

// A plate on fine rough ground touches in more places than there is room for: the deepest carry it, and
// the run says so.
TEST(ShapeContact, OfTooManyPlacesTheDeepestCarry) {
  Running run(
      "World yard { touch = shapes; gravity = 9.81; deltat = 0.2 ms; Material soft { "
      "normal_stiffness = 500 N/m; normal_damping = 20 N.s/m; } Terrain.Rough floor { amplitude = "
      "1 mm; wavelength = 40 mm; spacing = 10 mm; size = 1, 1; material = soft; } Robot plate { "
      "Base.mobile { location = 0, 0, 0.021; Shape.Box { dimensions = 0.2, 0.2, 0.04; mass = 5 kg; "
      "} } } }");
  run.step(2000);
  const auto says = [](const std::string& notice) {
    return notice.find("the deepest of them carry") != std::string::npos;
  };
  EXPECT_TRUE(std::ranges::any_of(run.world().state().notices, says));
  EXPECT_NEAR(run["yard.plate.position.z"], 0.02, 0.01);
  EXPECT_LT(std::abs(run["yard.plate.velocity.z"]), 1e-3);
}

/// How far two boxes of `half` edges overlap: the least of their overlaps along the axes that may part
/// them (separating axes); < 0 where they are apart [m].
double overlap(const std::array<Vector3d, 2>& places, const std::array<Quaterniond, 2>& turns,
               const Vector3d& half) {
  std::vector<Vector3d> axes;
  for (const Quaterniond& turn : turns)
    for (const Vector3d& axis : {Vector3d{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
      axes.push_back(rotate(turn, axis));
  const std::vector<Vector3d> own = axes;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j < 6; ++j) axes.push_back(cross(own[i], own[j]));
  double least = HUGE_VAL;
  for (const Vector3d& axis : axes) {
    const double length = norm(axis);
    if (length < 1e-6) continue;
    double reach = -std::abs(dot(axis, places[1] - places[0]));
    for (std::size_t k = 0; k < 6; ++k)
      reach += std::abs(dot(axis, own[k])) * std::array{half.x, half.y, half.z}[k % 3];
    least = std::min(least, reach / length);
  }
  return least;
}

// Boxes that fall on one another in any attitude lie apart in the end, but for what their weight presses.
TEST(ShapeContact, AHeapOfBoxesLiesApart) {
  constexpr int count = 8;
  std::string boxes;
  for (int i = 0; i < count; ++i)
    boxes += "Robot b" + std::to_string(i) +
             " { Base.mobile { location = " + std::to_string(0.05 * std::cos(2.4 * i)) + ", " +
             std::to_string(0.05 * std::sin(2.4 * i)) + ", " + std::to_string(0.1 + 0.1 * i) +
             "; orientation = " + std::to_string(0.3 * i) + ", " + std::to_string(0.2 * i) + ", " +
             std::to_string(0.7 * i) +
             "; Shape.Box { dimensions = 0.1, 0.1, 0.06; mass = 0.5; } } } ";
  Running run(
      yard("deltat = 0.2 ms;", flat + boxes, "static_friction = 0.5; kinetic_friction = 0.5;"));
  run.step(15000);
  const auto at = [&](int i, const char* what) {
    return run["yard.b" + std::to_string(i) + ".base." + what];
  };
  double deepest = -HUGE_VAL;
  for (int i = 0; i < count; ++i) {
    EXPECT_LT(at(i, "velocity.z"), 1e-3);
    for (int j = i + 1; j < count; ++j) {
      const auto place = [&](int k) {
        return Vector3d{at(k, "location.x"), at(k, "location.y"), at(k, "location.z")};
      };
      const auto turn = [&](int k) {
        return Quaterniond{at(k, "orientation.w"), at(k, "orientation.x"), at(k, "orientation.y"),
                           at(k, "orientation.z")};
      };
      deepest =
          std::max(deepest, overlap({place(i), place(j)}, {turn(i), turn(j)}, {0.05, 0.05, 0.03}));
    }
  }
  EXPECT_LT(deepest, 2e-3);
}

}  // namespace
}  // namespace hookpoint
