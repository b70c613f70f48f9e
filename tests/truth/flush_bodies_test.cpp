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
std::string material(double friction, const std::string& name = "s", double times = 1.) {
  return fmt::format(
      "Material {1} {{ normal_stiffness = {2} N/m; normal_damping = 100; tangential_stiffness = 50 kN/m; "
      "tangential_damping = 100; static_friction = {0}; kinetic_friction = {0}; }} ",
      friction, name, times * stiffness);
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
std::string tile(const std::string& name, double x, double y, double width, double top = 0.,
                 const std::string& of = "s") {
  return fmt::format(
      "Obstacle.Box {} {{ location = {},{},{}; dimensions = 0.2,{},0.1; material = {}; }} ", name,
      x + 0.1, y, top - 0.05, width, of);
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

// On a floor of one height four corners carry the box, over the seam as beside it.
TEST(FlushBoxes, CarryByFourCornersOverTheSeam) {
  const double depth = g / (4. * stiffness);
  Running run(on_floor("hookpoint", 0., floors[0].boxes, 0.2));
  run.step(1500);  // the front corners cross at 0.2 s
  for (int i = 0; i < 3000; ++i) {
    run.step(1);
    ASSERT_NEAR(run["w.b.position.z"], 0.02 - depth, 0.05 * depth) << run["w.b.position.x"];
  }
  EXPECT_GT(run["w.b.position.x"], 0.025);
}

/// The tiles p, of material s and friction `before`, and q, with friction `after` and `times` its stiffness.
std::string two_materials(double before, double after, double times) {
  return on_floor(
      "hookpoint", before,
      material(after, "t", times) + tile("p", -0.2, 0., 0.2) + tile("q", 0., 0., 0.2, 0., "t"),
      0.9);
}

// Its weight leans forward while it brakes, by m a h for a length of 2 h: across the seam the front carries m (g +
// a)/2 and the rear m (g - a)/2, so that a = (mu_p (g - a) + mu_q (g + a))/2.
TEST(FlushBoxes, BrakeByTheFrictionOfEach) {
  const double before = 0.2, after = 0.4, speed = 0.9, length = 0.04;
  const double across = 0.5 * (before + after) * g / (1. + 0.5 * (before - after));
  const double left = 0.5 * speed * speed - before * g * 0.04 - across * length;  // [J/kg]
  for (const double times : {1., 3., 0.3}) {
    Running run(two_materials(before, after, times));
    run.step(4000);
    EXPECT_NEAR(run["w.b.position.x"], 0.5 * length + left / (after * g), 3e-4) << times;
    EXPECT_NEAR(run["w.b.velocity.x"], 0., 1e-4) << times;
  }
}

// Between materials of any stiffness the box neither stops nor gains: m g d + 4 k d^2/2 is all there is beside
// its speed.
TEST(FlushBoxes, KeepTheEnergyBetweenMaterials) {
  const double speed = 0.9, spring = g * g / (8. * stiffness);
  for (const double times : {1., 2., 10., 0.1}) {
    Running run(two_materials(0., 0., times));
    run.step(2000);
    const double v = run["w.b.velocity.x"];
    EXPECT_NEAR(0.5 * v * v, 0.5 * speed * speed, 3. * spring * std::max(1., 1. / times)) << times;
    EXPECT_NEAR(run["w.b.position.x"], -0.06 + 0.2 * speed, 1e-3) << times;
    for (const std::string& notice : run.world().state().notices) ADD_FAILURE() << notice;
  }
}

/// A body of 1 kg whose lowest place is the origin of z.
struct Slider {
  std::string name, shape, orientation;
  double height;  ///< of its base [m]
};
const std::vector<Slider> sliders{
    {"box", "Shape.Box { dimensions = 0.04,0.04,0.04; mass = 1 kg; }", "0,0,0.3", 0.02},
    {"ball", "Shape.Sphere { radius = 0.02; mass = 1 kg; }", "0,0,0", 0.02},
    {"cylinder on its end", "Shape.Cylinder { radius = 0.02; length = 0.04; mass = 1 kg; }",
     "0,0,0", 0.02},
    {"cylinder on its side", "Shape.Cylinder { radius = 0.02; length = 0.04; mass = 1 kg; }",
     "pi/2,0,0.1", 0.02},
    {"capsule", "Shape.Capsule { radius = 0.02; length = 0.04; mass = 1 kg; }", "pi/2,0,0.1", 0.02},
    {"disc", "Shape.Disc { radius = 0.02; mass = 1 kg; }", "0,0,0", 0.},
    {"cone on its end",
     "Shape.Legcone { length = 0.04; proximal_radius = 0.02; distal_radius = 0.01; mass = 1 kg; }",
     "0,-pi/2,0", 0.},
    {"hull",
     "Shape.Hull { points = 0.02,0,0.02, -0.02,0.01,0.02, -0.02,-0.01,0.02, 0.02,0,-0.02, "
     "-0.02,0.01,-0.02, -0.02,-0.01,-0.02; mass = 1 kg; }",
     "0,0,0.2", 0.02}};

std::string slider_on(const Slider& slider, const std::string& law, double friction,
                      const std::string& floor, const std::string& velocity, double y) {
  return "World w { deltat = 0.1 ms; contact = " + law + "; " + material(friction) + floor +
         fmt::format(
             "Robot b {{ Base.mobile {{ location = -0.06,{},{}; orientation = {}; velocity = {}; {} }} }} }}",
             y, slider.height, slider.orientation, velocity, slider.shape);
}

// No edge of a tile is one of the floor, and none of its corners: whatever slides or rolls over them moves as on one
// tile, along a seam, across it and over the place where four tiles, or three, meet.
TEST(FlushBoxes, MoveAllBodiesAsOneTileDoes) {
  const std::string one = tile("p", -0.2, 0., 0.4) + tile("q", 0., 0., 0.4);
  const std::string whole =
      "Obstacle.Box p { location = 0,0,-0.05; dimensions = 0.4,0.4,0.1; material = s; } ";
  const std::string three =
      tile("p", -0.2, 0., 0.4) + tile("q", 0., 0.1, 0.2) + tile("r", 0., -0.1, 0.2);
  for (const Slider& slider : sliders) {
    for (const double friction : {0., 0.3}) {
      for (const auto& [velocity, y] : std::vector<std::pair<std::string, double>>{
               {"0.9,0,0", 0.}, {"0.9,0,0", 0.003}, {"0.7,-0.7,0", 0.06}}) {
        Running truth(slider_on(slider, "hookpoint", friction, whole, velocity, y));
        truth.step(1400);
        for (const std::string& floor : {one, floors[4].boxes, three}) {
          Running run(slider_on(slider, "hookpoint", friction, floor, velocity, y));
          run.step(1400);
          for (const char* port : {"w.b.position.x", "w.b.position.y", "w.b.position.z"})
            EXPECT_NEAR(run[port], truth[port], 1e-7)
                << slider.name << ", friction " << friction << ", at " << velocity << ": " << port;
          for (const std::string& notice : run.world().state().notices)
            ADD_FAILURE() << slider.name << ": " << notice;
        }
      }
    }
  }
}

// What the floor may be made of, and how exactly it has to be laid: within 0.2 um beside and 0.5 um in height.
TEST(FlushBoxes, AreOneFloorWithinAMicrometre) {
  const auto box = [](double x, double top) {
    return fmt::format("location = {},0,{}; ", x, top - 0.05);
  };
  const std::string shape = "dimensions = 0.2,0.4,0.1; ";
  const auto obstacle = [&](const char* name, double x, double top) {
    return fmt::format("Obstacle.Box {} {{ {}{}material = s; }} ", name, box(x, top), shape);
  };
  const std::vector<Floor> laid{
      {"a gap", obstacle("p", -0.1 - 1e-7, 0.) + obstacle("q", 0.1 + 1e-7, 0.)},
      {"higher", obstacle("p", -0.1, 0.) + obstacle("q", 0.1, 0.5e-6)},
      {"lower", obstacle("p", -0.1, 0.) + obstacle("q", 0.1, -0.5e-6)},
      {"a fixed robot", "Robot p { Base.fixed { " + box(-0.1, 0.) + "Shape.Box { " + shape +
                            "mass = 1 kg; material = s; } } } " + obstacle("q", 0.1, 0.)}};
  for (const Floor& floor : laid) {
    for (const Slider& slider : sliders) {
      Running run(slider_on(slider, "hookpoint", 0., floor.boxes, "0.9,0,0", 0.003));
      run.step(1400);
      EXPECT_NEAR(run["w.b.velocity.x"], 0.9, 1e-5) << slider.name << ", " << floor.name;
      for (const std::string& notice : run.world().state().notices)
        ADD_FAILURE() << slider.name << ", " << floor.name << ": " << notice;
    }
  }
}

// However the corners of a box coincide with seams and with corners of tiles, each carries a fourth.
TEST(FlushBoxes, CarryWhatStandsOnTheirSeamsAsOneTileDoes) {
  const double depth = g / (4. * stiffness);
  for (const char* box :
       {"location = 0.02,0.02,0.02; Shape.Box { dimensions = 0.04,0.04,0.04; mass = 1 kg; }",
        "location = -0.06,0.04,0.02; Shape.Box { dimensions = 0.04,0.08,0.04; mass = 1 kg; }",
        "location = 0,0,0.02; Shape.Box { dimensions = 0.04,0.04,0.04; mass = 1 kg; }",
        "location = -0.1,-0.1,0.02; Shape.Box { dimensions = 0.2,0.2,0.04; mass = 1 kg; }"}) {
    Running run("World w { deltat = 0.1 ms; contact = hookpoint; " + material(0.5) +
                floors[4].boxes + "Robot b { Base.mobile { " + box + " } } }");
    run.step(5000);
    EXPECT_NEAR(run["w.b.position.z"], 0.02 - depth, 1e-3 * depth) << box;
    EXPECT_NEAR(run["w.b.velocity.z"], 0., 1e-6) << box;
  }
}

// A mat whose top is level with the ground that it lies in takes what comes onto it from the ground, by its own
// friction, and no more than that.
TEST(FlushBoxes, TakeOverFromTheGroundTheyLieIn) {
  const double speed = 0.9, friction = 0.3;
  const std::string ground =
      "Terrain.Flat f { material = s; } " + material(friction, "rough") +
      "Obstacle.Box p { location = 0.2,0,-0.05; dimensions = 0.4,0.4,0.1; material = rough; } ";
  for (const Slider& slider : sliders) {
    Running run(slider_on(slider, "hookpoint", 0., ground, "0.9,0,0", 0.003));
    const double begin = run["w.b.position.x"];
    run.step(300);
    EXPECT_NEAR(run["w.b.velocity.x"], speed, 1e-9) << slider.name;
    EXPECT_NEAR(run["w.b.position.x"], begin + 0.03 * speed, 1e-6) << slider.name;
    run.step(1700);
    EXPECT_GT(run["w.b.position.x"], 0.05) << slider.name;
    for (const std::string& notice : run.world().state().notices)
      ADD_FAILURE() << slider.name << ": " << notice;
  }
  // Until the rear corners of the box follow, the front ones alone brake it. As friction acts half of its length
  // below its middle, they carry N = m g/(2 - mu) then.
  const double length = 0.04;
  const double way = speed * speed / (2. * friction * g) + 0.5 * length - length / (2. - friction);
  Running run(slider_on(sliders[0], "hookpoint", 0., ground, "0.9,0,0", 0.003));
  run.step(5000);
  EXPECT_NEAR(run["w.b.position.x"], way, 0.001 * way);
  EXPECT_NEAR(run["w.b.position.z"], 0.02 - g / (4. * stiffness), 1e-6);
}

// At the foot of a riser tread and riser press, also on a body that reaches below the tread beside it, to where the
// undersides of both boxes are one face.
TEST(FlushBoxes, PressAtTheFootOfARiser) {
  const double push = 20., weight = 2. * g;
  const auto beside = [](double y) {
    return fmt::format(
        "Shape.Box {{ location = 0,{},-0.07; dimensions = 0.06,0.04,0.3; mass = 0.5 kg; }} ", y);
  };
  Running run(
      "World w { deltat = 0.1 ms; contact = hookpoint; " + material(0.) +
      tile("p", 0.1, 0., 1., 0.1) +
      "Obstacle.Box q { location = 0.6,0,0.1; dimensions = 0.6,1,0.2; material = s; } "
      "Robot b { Base.mobile { location = 0.28,0,0.12; Shape.Box { dimensions = 0.04,0.04,0.04; mass = 1 kg; } " +
      beside(0.6) + beside(-0.6) + "} } Force push { body = b.base; force = 20,0,0; } }");
  run.step(10000);
  EXPECT_NEAR(run["w.b.position.x"], 0.28 + push / (4. * stiffness), 1e-6);
  EXPECT_NEAR(run["w.b.position.z"], 0.12 - weight / (4. * stiffness), 1e-6);
  for (const std::string& notice : run.world().state().notices) ADD_FAILURE() << notice;
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
