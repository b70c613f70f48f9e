// Bodies that touch bodies, of the same robot and of others, under every force law: momentum, the distance
// by which a box slides on a slab that it drags along, and the force between two pendulums that lean.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

std::vector<std::string> force_laws() {
  std::vector<std::string> names = contact::law_names();
  std::erase_if(names, [](const std::string& name) { return !contact::find_force_law(name); });
  return names;
}

class EveryForceLaw : public ::testing::TestWithParam<std::string> {
 protected:
  static std::string world(const std::string& gravity, const std::string& content) {
    return "World w { touch = shapes; deltat = 0.05 ms; contact = " + GetParam() +
           "; gravity = " + gravity +
           "; Material wood { normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = "
           "1e5; tangential_damping = 300; static_friction = 0.1; kinetic_friction = 0.1; } " +
           content + " }";
  }
};
INSTANTIATE_TEST_SUITE_P(Laws, EveryForceLaw, ::testing::ValuesIn(force_laws()),
                         [](const auto& law) { return law.param; });

Vector3d vector_at(const Running& run, const std::string& port) {
  return {run[port + ".x"], run[port + ".y"], run[port + ".z"]};
}

/// Two balls and a cube, whose moments of inertia are alike about all axes: forces between them are equal
/// and opposite at one place, so momentum and angular momentum stay to rounding, and friction and damping
/// only take energy.
TEST_P(EveryForceLaw, KeepsTheMomentumOfBodiesThatMeet) {
  Running run(
      world("0",
            "Robot ball { Base.mobile { velocity = 1, 0, 0; angular_velocity = 0, 20, 10; "
            "Shape.Sphere { radius = 0.1; mass = 0.4; material = wood; } } } "
            "Robot cube { Base.mobile { location = 0.27, 0.03, 0.02; Shape.Box { dimensions = "
            "0.3, 0.3, 0.3; mass = 2; material = wood; } } } "
            "Robot late { Base.mobile { location = 0.3, 0.1, 0.8; velocity = 0, 0, -2; "
            "Shape.Sphere { radius = 0.05; mass = 0.5; material = wood; } } }"));
  const struct {
    const char* name;
    double mass, inertia;
  } bodies[] = {{"ball", 0.4, 0.4 * 0.4 * 0.1 * 0.1},
                {"cube", 2., 2. * 0.3 * 0.3 / 6.},
                {"late", 0.5, 0.4 * 0.5 * 0.05 * 0.05}};
  const auto sums = [&] {
    struct {
      Vector3d momentum, angular_momentum;
      double energy = 0.;
    } sum;
    for (const auto& body : bodies) {
      const std::string name = std::string("w.") + body.name;
      const Vector3d p = body.mass * vector_at(run, name + ".velocity");
      sum.momentum += p;
      sum.angular_momentum += cross(vector_at(run, name + ".position"), p) +
                              body.inertia * vector_at(run, name + ".angular_velocity");
      sum.energy += run[name + ".kinetic_energy"];
    }
    return sum;
  };
  const auto start = sums();
  double hardest = 0.;
  for (int i = 0; i < 10000; ++i) {
    run.step();
    const auto now = sums();
    ASSERT_NEAR(norm(now.momentum - start.momentum), 0., 1e-12) << "step " << i;
    ASSERT_NEAR(norm(now.angular_momentum - start.angular_momentum), 0., 1e-12) << "step " << i;
    ASSERT_LE(now.energy, start.energy * (1. + 1e-6)) << "step " << i;
    hardest = std::max(hardest, norm(vector_at(run, "w.late.contact.force")));
  }
  EXPECT_GT(norm(vector_at(run, "w.cube.velocity")), 0.1);
  EXPECT_GT(hardest, 10.);
}

/// A box of m = 1 kg comes onto a slab of M = 2 kg, that lies on ice, with v = 1 m/s. Friction mu m g brings
/// both to m v/(m + M), and the box has slid v^2 M/(2 mu g (m + M)) along the slab.
TEST_P(EveryForceLaw, SlidesABoxAlongASlab) {
  Running run(world(
      "9.81",
      "Material ice { normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = 1e5; "
      "tangential_damping = 300; } Material slick { normal_stiffness = 1e5; normal_damping = "
      "300; tangential_stiffness = 1e5; tangential_damping = 300; static_friction = 0; "
      "kinetic_friction = 0; } Pair { a = wood; b = ice; material = slick; } "
      "Terrain.Flat lake { material = ice; } "
      "Robot slab { Base.mobile { location = 0, 0, 0.01; Shape.Box { dimensions = 1.2, 0.2, "
      "0.02; mass = 2; material = wood; } } } Robot box { Base.mobile { location = -0.4, 0, "
      "0.03; velocity = 1, 0, 0; Shape.Box { dimensions = 0.1, 0.1, 0.02; mass = 1; material "
      "= wood; } } }"));
  run.step(18000);
  const double slid = run["w.box.position.x"] - run["w.slab.position.x"] + 0.4;
  const double path = 2. / (2. * 0.1 * g * 3.);
  EXPECT_NEAR(slid, path, 0.02 * path);
  EXPECT_NEAR(run["w.slab.velocity.x"], 1. / 3., 1e-3);
  EXPECT_NEAR(run["w.box.velocity.x"], 1. / 3., 2e-3);
}

/// Two bobs of 1 kg and 50 mm hang by rods of 0.5 m from pivots 40 mm to either side of the middle: they lean
/// by sin q = (0.05 - 0.04)/0.5, and push each other apart with m g tan q.
std::string arm(const std::string& side, const std::string& angle) {
  return "Chain " + side + " { hip_distance = " + (side == "left" ? "-" : "") +
         "0.04, 0, 0; hip_orientation = 0, 0, 90 deg; Link rod { angle = " + angle +
         "; damping = 2; mass = 1; center_of_mass = 0.5, 0, 0; inertia = 1e-3, 1e-3, 1e-3, 0, 0, "
         "0; Shape.Sphere { location = 0.5, 0, 0; radius = 0.05; material = wood; } } } ";
}

void expect_that_they_lean(Running& run, const std::string& left, const std::string& right) {
  run.step(60000);
  const double q = std::asin(0.01 / 0.5);
  const Vector3d on_left = vector_at(run, left + ".contact.force"),
                 on_right = vector_at(run, right + ".contact.force");
  EXPECT_NEAR(on_right.x, g * std::tan(q), 0.05 * g * std::tan(q));
  EXPECT_NEAR(norm(on_left + on_right), 0., 1e-9);
  // What it is by the angle itself, whatever the depth.
  EXPECT_NEAR(on_right.x, g * std::tan(std::abs(run[right + ".angle"])), 1e-3 * on_right.x);
}

TEST_P(EveryForceLaw, HoldsTwoArmsOfARobotApart) {
  const std::string robot = "Base.fixed { orientation = -90 deg, 0, 0; } " + arm("left", "2 deg") +
                            arm("right", "-2 deg");
  Running run(world("9.81", "Robot both { self_contact = true; " + robot + "}"));
  expect_that_they_lean(run, "w.both.left.rod", "w.both.right.rod");
  Running free(world("9.81", "Robot both { " + robot + "}"));
  free.step(60000);
  EXPECT_NEAR(free["w.both.right.rod.angle"], 0., 1e-6);
}

TEST_P(EveryForceLaw, HoldsTwoRobotsApart) {
  const std::string base = "Base.fixed { orientation = -90 deg, 0, 0; } ";
  Running run(world("9.81", "Robot one { " + base + arm("left", "2 deg") + "} Robot other { " +
                                base + arm("right", "-2 deg") + "}"));
  expect_that_they_lean(run, "w.one.left.rod", "w.other.right.rod");
}

}  // namespace
}  // namespace hookpoint
