// Bodies whose edges and corners coincide with those of what they lie on, against closed forms: by its place
// alone a corner there lies on several faces, and the one that it rests on is the one below its body.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, stiffness = 50e3;

/// Of both sides together: a stiffness of `stiffness` at each corner.
std::string material(double friction) {
  return fmt::format(
      "Material s {{ normal_stiffness = 50 kN/m; normal_damping = 100; tangential_stiffness = 50 kN/m; "
      "tangential_damping = 100; static_friction = {0}; kinetic_friction = {0}; }} ",
      friction);
}

std::string cube(const std::string& name, const std::string& base, const std::string& fields) {
  return "Robot " + name + " { Base." + base + " { " + fields +
         " Shape.Box { dimensions = 0.1,0.1,0.1; mass = 1 kg; } } } ";
}

std::string stack(const std::string& law, double yaw) {
  return "World w { deltat = 0.1 ms; contact = " + law + "; " + material(0.5) +
         "Terrain.Flat f { material = s; } " + cube("a", "mobile", "location = 0,0,0.05;") +
         cube("b", "mobile", fmt::format("location = 0,0,0.15; orientation = 0,0,{};", yaw)) + "}";
}

// Each of four corners carries a fourth, whether the cubes coincide or are turned by a hair.
TEST(FlushCubes, SinkByTheirShareOfFourCorners) {
  const double depth = g / (4. * stiffness);
  for (const double yaw : {0., 1.5707963267948966, 1e-7, 1e-4}) {
    Running run(stack("hookpoint", yaw));
    run.step(5000);
    const double lower = run["w.a.position.z"], upper = run["w.b.position.z"];
    EXPECT_NEAR(0.05 - lower, 2. * depth, 0.01 * depth) << "turned by " << yaw;
    EXPECT_NEAR(lower + 0.1 - upper, depth, 0.01 * depth) << "turned by " << yaw;
    EXPECT_NEAR(run["w.b.position.x"], 0., 1e-9) << "turned by " << yaw;
  }
}

TEST(FlushCubes, StandOnEachOtherUnderImpulses) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    for (const double yaw : {0., 1.5707963267948966}) {
      Running run(stack(law, yaw));
      run.step(2000);
      EXPECT_NEAR(run["w.a.position.z"], 0.05, 1e-6) << law << ", turned by " << yaw;
      EXPECT_NEAR(run["w.b.position.z"], 0.15, 1e-6) << law << ", turned by " << yaw;
      EXPECT_NEAR(run["w.b.position.x"], 0., 1e-4) << law << ", turned by " << yaw;
    }
  }
}

// Without friction nothing changes the velocity along the face, slow or fast, with weight or without.
TEST(FlushCubes, SlideOffEachOtherFreely) {
  for (const char* gravity : {"9.81", "0"}) {
    for (const double speed : {1., 0.01, 1e-5}) {
      for (const auto& [x, y] :
           std::vector<std::pair<int, int>>{{1, 0}, {-1, 0}, {0, 1}, {1, -1}}) {
        Running run(
            "World w { deltat = 0.1 ms; gravity = " + std::string(gravity) + "; " + material(0.) +
            cube("a", "fixed", "") +
            cube("b", "mobile",
                 fmt::format("location = 0,0,0.1; velocity = {},{},0;", x * speed, y * speed)) +
            "}");
        run.step(50);
        EXPECT_NEAR(run["w.b.velocity.x"], x * speed, 1e-6 * speed)
            << speed << ": " << x << ", " << y;
        EXPECT_NEAR(run["w.b.velocity.y"], y * speed, 1e-6 * speed)
            << speed << ": " << x << ", " << y;
      }
    }
  }
}

/// A box of 4 cm that begins at x = -0.06 m beside `y` [m] with `speed` [m/s] on `boxes`, whose tops are z = 0.
std::string on_floor(const std::string& law, double friction, const std::string& boxes,
                     double speed, double y = 0.) {
  return "World w { deltat = 0.1 ms; contact = " + law + "; " + material(friction) + boxes +
         fmt::format(
             "Robot b {{ Base.mobile {{ location = -0.06,{},0.02; velocity = {},0,0; Shape.Box {{ "
             "dimensions = 0.04,0.04,0.04; mass = 1 kg; }} }} }} }}",
             y, speed);
}

/// An Obstacle whose top is z = `top`, from x to x + 0.2 m.
std::string tile(const std::string& name, double x, double y, double width, double top = 0.) {
  return fmt::format(
      "Obstacle.Box {} {{ location = {},{},{}; dimensions = 0.2,{},0.1; material = s; }} ", name,
      x + 0.1, y, top - 0.05, width);
}

struct Floor {
  std::string name, boxes;
};
const std::vector<Floor> floors{
    {"two boxes", tile("p", -0.2, 0., 0.2) + tile("q", 0., 0., 0.2)},
    {"two beams", tile("p", -0.2, 0., 0.03) + tile("q", 0., 0., 0.03)},
    {"from wide to narrow", tile("p", -0.2, 0., 0.2) + tile("q", 0., 0., 0.03)},
    {"from narrow to wide", tile("p", -0.2, 0., 0.03) + tile("q", 0., 0., 0.2)},
    {"four tiles", tile("p", -0.2, 0.1, 0.2) + tile("q", 0., 0.1, 0.2) +
                       tile("r", -0.2, -0.1, 0.2) + tile("t", 0., -0.1, 0.2)}};

// The sides between flush boxes are inside the floor.
TEST(FlushBoxes, AreOneFloor) {
  for (const Floor& floor : floors) {
    for (const char* law : {"hookpoint", "nominal", "impulse"}) {
      for (const double speed : {1., 0.3}) {
        Running run(on_floor(law, 0., floor.boxes, speed));
        run.step(static_cast<int>(std::lround(0.14 / speed / 1e-4)));
        EXPECT_NEAR(run["w.b.velocity.x"], speed, 0.005 * speed) << law << " on " << floor.name;
        EXPECT_NEAR(run["w.b.position.x"], 0.08, 5e-4) << law << " on " << floor.name;
      }
    }
  }
}

// Friction stops it after v^2 / (2 mu g), wherever it crosses the seams.
TEST(FlushBoxes, BrakeAsOneFloor) {
  const double speed = 0.9, friction = 0.3, way = speed * speed / (2. * friction * g);
  for (const Floor& floor : floors) {
    for (const double y : {0., 0.005}) {
      Running run(on_floor("hookpoint", friction, floor.boxes, speed, y));
      run.step(4000);
      EXPECT_NEAR(run["w.b.position.x"], -0.06 + way, 0.005 * way) << floor.name << ", y = " << y;
      EXPECT_NEAR(run["w.b.velocity.x"], 0., 1e-4) << floor.name << ", y = " << y;
    }
  }
}

// One that is higher by a millimetre is a step, and stops the box.
TEST(FlushBoxes, AreAStepWhereOneIsHigher) {
  Running run(
      on_floor("hookpoint", 0., tile("p", -0.2, 0., 0.2) + tile("q", 0., 0., 0.2, 1e-3), 0.3));
  run.step(3000);
  EXPECT_LT(run["w.b.position.x"], -0.02);
}

}  // namespace
}  // namespace hookpoint
