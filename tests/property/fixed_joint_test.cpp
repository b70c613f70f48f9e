// joint = fixed: a robot with fixed joints is the one whose joints turn in place of them, at rest and
// each with a rotor that nothing accelerates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  bool chance(double part) { return number(0., 1.) < part; }

 private:
  std::mt19937 random_;
};

struct Scene {
  std::string fixed, locked;        ///< the same robot, written in two ways
  std::vector<std::string> joints;  ///< that move in both: "w.r.a.l2"
  std::vector<std::string> points;  ///< ContactPoints
};

class Writer {
 public:
  explicit Writer(unsigned seed) : draw_(seed) {}

  Scene run() {
    both(
        "World w { gravity = 9.81; deltat = 1e-6 s; Terrain.Flat g { } Robot r { Base.mobile { "
        "location = 0, 0, 3; velocity = " +
        triple(1.) + "; angular_velocity = " + triple(1.) + "; " + body());
    both("} ");
    for (int i = 0; i < 2; ++i) chain("w.r", 2);
    both("} ");
    for (const std::string& link : links_) {
      if (!draw_.chance(0.4)) continue;
      both(fmt::format("Force f{} {{ body = {}; point = {}; force = {}; torque = {}; }} ", named_++,
                       link.substr(2), triple(0.2), triple(5.), triple(1.)));
    }
    both("}");
    return std::move(scene_);
  }

 private:
  void both(const std::string& text) {
    scene_.fixed += text;
    scene_.locked += text;
  }
  std::string triple(double most) {
    const auto part = [&] { return draw_.number(-most, most); };
    return fmt::format("{}, {}, {}", part(), part(), part());
  }
  /// A mass of its own, or one of shapes; a point that may touch.
  std::string body() {
    std::string text = fmt::format("mass = {}; ", draw_.number(0.2, 2.));
    if (draw_.chance(0.5))
      text +=
          "center_of_mass = " + triple(0.1) + "; inertia = 0.01, 0.012, 0.015, 1e-3, -5e-4, 2e-4; ";
    else
      text += "Shape.Box { dimensions = 0.1, 0.2, 0.15; location = " + triple(0.1) +
              "; orientation = 0.3, -0.2, 0.5; } ";
    return text;
  }
  void chain(const std::string& on, int depth) {
    const std::string trail = fmt::format("{}.c{}", on, named_++);
    both(fmt::format("Chain {} {{ hip_distance = {}; hip_orientation = 0.2, 0.4, -0.1; ",
                     trail.substr(on.size() + 1), triple(0.2)));
    const int links = 1 + static_cast<int>(draw_.number(0., 4.));
    for (int i = 0; i < links; ++i) link(trail, depth);
    both("} ");
  }
  void link(const std::string& in, int depth) {
    const std::string name = fmt::format("l{}", named_++), trail = in + "." + name;
    links_.push_back(trail);
    both(
        fmt::format("Link {} {{ {} dhlength = {}; dhtwist = {}; dhoffset = {}; dhangle = {}; "
                    "joint_location = {}; joint_orientation = 0.1, -0.3, 0.2; ",
                    name, body(), draw_.number(0., 0.3), draw_.number(-2., 2.),
                    draw_.number(-0.1, 0.1), draw_.number(-2., 2.), triple(0.1)));
    if (draw_.chance(0.5)) {
      scene_.fixed += "joint = fixed; ";
      scene_.locked += "rotor_inertia = 1e12; ";
    } else {
      scene_.joints.push_back(trail);
      both(fmt::format("angle = {}; rate = {}; torque = {}; ", draw_.number(-1., 1.),
                       draw_.number(-2., 2.), draw_.number(-1., 1.)));
    }
    if (draw_.chance(0.5)) {
      scene_.points.push_back(fmt::format("{}.p{}", trail, named_));
      both(fmt::format("ContactPoint p{} {{ location = {}; }} ", named_++, triple(0.1)));
    }
    if (depth > 0 && draw_.chance(0.4)) chain(trail, depth - 1);
    both("} ");
  }

  Draw draw_;
  Scene scene_;
  std::vector<std::string> links_;
  int named_ = 0;
};

TEST(FixedJoint, MovesAsOneThatNothingTurns) {
  int fixed = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = Writer(seed).run();
    Running part(scene.fixed), locked(scene.locked);
    fixed += scene.fixed.find("joint = fixed") != std::string::npos;
    const auto expect_near = [&](const std::string& port, double relative) {
      ASSERT_NEAR(part[port], locked[port], relative * (1. + std::abs(locked[port]))) << port;
    };
    for (const char* port :
         {"center_of_mass.x", "center_of_mass.y", "center_of_mass.z", "center_of_mass_velocity.x",
          "center_of_mass_velocity.z", "total_mass", "kinetic_energy"}) {
      // The rotors are still.
      expect_near(std::string("w.r.") + port, 1e-11);
    }
    part.step();
    locked.step();
    for (const std::string& joint : scene.joints) expect_near(joint + ".acceleration", 1e-8);
    for (const char* axis : {"x", "y", "z"}) {
      expect_near(std::string("w.r.base.linear_acceleration.") + axis, 1e-8);
      expect_near(std::string("w.r.base.angular_acceleration.") + axis, 1e-8);
      for (const std::string& point : scene.points) expect_near(point + ".position." + axis, 1e-11);
    }
  }
  EXPECT_GT(fixed, 150);
}

// A rod of two parts, hung at its end: (I + m l^2) phi'' = -m g l phi with I and l of the whole rod.
TEST(FixedJoint, ARodOfTwoPartsSwingsAsOne) {
  const double half = 0.4, m = 0.6, g = 9.81, length = 2. * half;
  const auto rod = [&](const std::string& joint) {
    return fmt::format(
        "Link {{}} {{{{ {} mass = {}; center_of_mass = {}, 0, 0; inertia = 1e-9, {}, {}, 0, 0, 0; }}}} ",
        joint, m, 0.5 * half, m * half * half / 12., m * half * half / 12.);
  };
  Running run(fmt::format(
      "World w {{ gravity = {}; deltat = 1e-4 s; integrator = rk4; Robot r {{ Base.fixed {{ }} Chain a "
      "{{ hip_orientation = 90 deg, 0, 0; {} {} }} }} }}",
      g, fmt::format(fmt::runtime(rod("angle = -89.9 deg;")), "upper"),
      fmt::format(fmt::runtime(rod(fmt::format("joint = fixed; dhlength = {};", half))), "lower")));
  const double I = 2. * m * length * length / 3., moment = 2. * m * g * 0.5 * length;
  const double period = 2. * M_PI * std::sqrt(I / moment);
  const double start = run["w.r.a.upper.angle"] + 0.5 * M_PI;
  run.step(static_cast<int>(std::lround(period / 1e-4)));
  EXPECT_NEAR((run["w.r.a.upper.angle"] + 0.5 * M_PI) / start, 1., 1e-6);
  EXPECT_LT(std::abs(run["w.r.a.upper.rate"]), 1e-3 * start * 2. * M_PI / period);
}

// A foot on a fixed link bears the weight, and is read where it stands.
TEST(FixedJoint, AFootOnAFixedLinkBearsTheWeight) {
  Running run(
      "World w { gravity = 9.81; deltat = 0.5 ms; Material m { normal_stiffness = 1e5; normal_damping = "
      "500; } Terrain.Flat g { material = m; } Robot r { Base.mobile { location = 0, 0, 0.3; mass = 2; "
      "inertia = 0.1, 0.1, 0.1, 0, 0, 0; } For i in 0..2 { Chain leg[i] { hip_orientation = 0, 0, 120 "
      "deg * i; Link shin { joint = fixed; dhlength = 0.2; mass = 0.1; ContactPoint foot { location = "
      "0, 0, -0.3; } } } } } }");
  run.step(4000);
  double load = 0.;
  for (const char* leg : {"leg[0]", "leg[1]", "leg[2]"}) {
    const std::string foot = std::string("w.r.") + leg + ".shin.foot.";
    load += run[foot + "contact.normal_load"];
    EXPECT_NEAR(std::hypot(run[foot + "position.x"], run[foot + "position.y"]), 0.2, 1e-6);
    EXPECT_NEAR(run[foot + "position.z"], -(2.3 * 9.81 / 3.) / 1e5, 1e-9);
    EXPECT_NEAR(run[std::string("w.r.") + leg + ".shin.mass"], 0.1, 0.);
  }
  EXPECT_NEAR(load, 2.3 * 9.81, 1e-6);
  EXPECT_NEAR(run["w.r.base.mass"], 2., 0.);
}

TEST(FixedJoint, HasNothingOfItsOwn) {
  const auto problem = [](const std::string& link, const std::string& more = "") {
    return load_text(
               "World w { Robot r { Base.fixed { } Chain a { Link l { mass = 1; inertia = 1, 1, 1, 0, "
               "0, 0; } Link tip { joint = fixed; mass = 1; inertia = 1, 1, 1, 0, 0, 0; " +
               link + " } } } " + more + " }")
        .diagnostics;
  };
  EXPECT_EQ(problem(""), "");
  EXPECT_NE(problem("angle = 0.1;").find("a fixed joint has no `angle`"), std::string::npos);
  EXPECT_NE(problem("mimic = r.a.l;").find("a fixed joint has no `mimic`"), std::string::npos);
  EXPECT_NE(problem("", "Record d { trails = r.a.tip.rate; }").find("does not publish `rate`"),
            std::string::npos);
  EXPECT_NE(problem("", "Sensor.Joint encoder { joint = r.a.tip; }").find("does not publish"),
            std::string::npos);
}

}  // namespace
}  // namespace hookpoint
