// Loops and coupled joints in the engines that have them, ours among them, against closed forms: a
// four-bar linkage, a frame that carries a weight, Minitaur's five-bar leg, a parallel ankle, a hexapod
// whose feet are pinned to the ground, a rack and its pinion.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "reference/engines.h"
#include "tests/support/four_bar.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using test_support::FourBar;

constexpr double g = 9.81;

struct Case {
  std::string engine, settings;
  double energy, gap;   ///< greatest error at 0.1 ms [J, m]
  double force = 2e-3;  ///< relative error of forces at rest
};

/// All integrate at first order.
std::vector<Case> cases() {
  return {{"dts", "default", 0.02, 1e-12},
          {"ode", "default", 0.02, 1e-6},
          {"ode_quickstep", "default", 0.02, 1e-6, 0.01},
          {"bullet", "default", 0.02, 1e-5},
          {"mujoco", "matched", 0.02, 1e-5}};
}

class PeerLoop : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    for (const reference::Peer& peer : reference::known_peers())
      if (peer.name == GetParam().engine && !peer.found())
        GTEST_SKIP() << GetParam().engine << " is not in this build";
  }
  static Running running(const std::string& text) {
    for (const reference::Peer& peer : reference::known_peers())
      if (peer.name == GetParam().engine) return Running(text, peer.make);
    return Running(text);
  }
  static std::string engine(double deltat) {
    return fmt::format("engine = {}; settings = {}; deltat = {};", GetParam().engine,
                       GetParam().settings, deltat);
  }
};

/// Greatest error of the energy and of the loop in half a second.
std::pair<double, double> errors_of_four_bar(Running run, double deltat) {
  const double start = FourBar::energy(run["w.bar.left.crank.angle"], run["w.bar.left.crank.rate"]);
  double energy = 0., gap = 0.;
  for (double t = 0.; t < 0.5; t += 0.01) {
    run.step(static_cast<int>(std::lround(0.01 / deltat)));
    const double crank = run["w.bar.left.crank.angle"], rate = run["w.bar.left.crank.rate"];
    energy = std::max(energy, std::abs(FourBar::energy(crank, rate) - start));
    gap = std::max(gap, run["w.bar.pin.error"]);
  }
  return {energy, gap};
}

TEST_P(PeerLoop, AFourBarLinkageKeepsItsEnergyAsTheStepShrinks) {
  const auto [coarse, wide] = errors_of_four_bar(running(FourBar::text(engine(1e-3))), 1e-3);
  const auto [fine, narrow] = errors_of_four_bar(running(FourBar::text(engine(1e-4))), 1e-4);
  EXPECT_LT(fine, GetParam().energy);
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_LT(narrow, GetParam().gap);
}

/// Three cranks of `mass` [kg] carry a bar of 1 kg, one crank more than it needs.
std::string three_cranks(const std::string& engine, double mass) {
  const auto crank = [&](const char* name) {
    return fmt::format("Link {} {{ angle = -88 deg; mass = {}; inertia = {}, {}, {}, 0, 0, 0; }} ",
                       name, mass, 1e-3 * mass, 1e-3 * mass, 1e-3 * mass);
  };
  return "World w { gravity = 0, -9.81, 0; " + engine + " Robot m { Base.fixed; Chain a { " +
         crank("c") +
         "Link bar { dhlength = 0.2; angle = 88 deg; mass = 1; center_of_mass = 0.3, 0, 0; inertia = "
         "0.03, 0.03, 0.03, 0, 0, 0; } } Chain b { hip_distance = 0.3, 0, 0; " +
         crank("c") + "} Chain d { hip_distance = 0.6, 0, 0; " + crank("c") +
         "} Loop p { a = a.bar; b = b.c; point_a = 0.3, 0, 0; point_b = 0.2, 0, 0; } Loop q { a = "
         "a.bar; b = d.c; point_a = 0.6, 0, 0; point_b = 0.2, 0, 0; } } }";
}

// The places of the loops are 0.36 and 0.64 m from the base: an engine that lets one of them open by more
// than a tenth of that says so, one that keeps them closed does not.
TEST_P(PeerLoop, SaysSoWhereALoopOpens) {
  for (const double mass : {1e-6, 0.1}) {
    Running run = running(three_cranks(engine(5e-4), mass));
    double p = 0., q = 0.;
    for (int i = 0; i < 1000; ++i) {
      run.step();
      p = std::max(p, run["w.m.p.error"]);
      q = std::max(q, run["w.m.q.error"]);
    }
    bool said = false;
    for (const std::string& notice : run.world().state().notices)
      said = said || notice.find("has opened by") != std::string::npos;
    const bool opens = p > 0.037 || q > 0.065, stays_closed = p < 0.035 && q < 0.063;
    EXPECT_TRUE(said || !opens) << mass << " " << p << " " << q;
    EXPECT_FALSE(said && stays_closed) << mass << " " << p << " " << q;
    EXPECT_TRUE(GetParam().engine != "bullet" || said == (mass == 1e-6)) << mass;
  }
}

// Two rods of mass m carry M at a pin, hinged at the ground 0.6 m apart, 0.4 m above it. By the moments
// about the right rod's hinge, and by symmetry: the pin's force on M is
// (0.15 (M + m) g / 0.4, M g / 2).
TEST_P(PeerLoop, TheForceInAFrameIsThatOfStatics) {
  const double M = 2., m = 0.5;
  const auto rod = [&](const std::string& name, const std::string& angle) {
    return FourBar::rod(name, 0.5, m, "angle = " + angle + ";");
  };
  Running run =
      running("World w { gravity = 0, -9.81, 0; " + engine(1e-3) +
              " Robot frame { Base.fixed { } Chain l { hip_distance = -0.3, 0, 0;" +
              rod("rod", "-53.13010235415598 deg") +
              " Link weight { dhlength = 0.5; mass = 2; inertia = 0.1, 0.1, 0.1, 0, 0, 0; } } "
              "Chain r { hip_distance = 0.3, 0, 0;" +
              rod("rod", "-126.86989764584402 deg") +
              " } Loop pin { a = l.weight; b = r.rod; point_b = 0.5, 0, 0; } } }");
  run.step(200);
  EXPECT_NEAR(run["w.frame.pin.force.x"], 0.15 * (M + m) * g / 0.4, GetParam().force * M * g);
  EXPECT_NEAR(run["w.frame.pin.force.y"], 0.5 * M * g, GetParam().force * M * g);
}

// A plate M hangs beside its own hinge, which is along x, and cannot fall: a second hinge, along z, joins
// it to a post. The moment about x is that one's alone.
TEST_P(PeerLoop, TheMomentInAHingeIsThatOfStatics) {
  const double M = 2., beside = 0.2;
  Running run = running(
      "World w { gravity = 0, 0, -9.81; " + engine(1e-3) +
      " Robot door { Base.fixed { } Chain c { hip_orientation = 0, pi/2, 0; Link plate { "
      "mass = 2; center_of_mass = 0, 0.2, 0; inertia = 0.02, 0.02, 0.02, 0, 0, 0; } } "
      "Chain p { hip_distance = 0.4, 0, 0; Link post { mass = 1; inertia = 0.01, 0.01, 0.01, "
      "0, 0, 0; } } Loop hold { a = c.plate; b = p.post; point_a = 0, 0, 0.4; axis = -1, 0, "
      "0; } } }");
  run.step(200);
  EXPECT_NEAR(run["w.door.hold.moment.x"], beside * M * g, GetParam().force * M * g);
  EXPECT_NEAR(run["w.door.c.plate.angle"], 0., 1e-3);
}

// Minitaur's leg: two hips on one axis, upper links l1, lower links l2 that meet at the foot. With
// theta = phi +- gamma the foot is at r(gamma) = l1 cos gamma + sqrt(l2^2 - l1^2 sin^2 gamma) along
// phi, and by virtual work a force (F_r, F_t) on it needs the torques
// tau1 + tau2 = -F_t r, tau1 - tau2 = -F_r dr/dgamma.
TEST_P(PeerLoop, TheFiveBarLegOfMinitaurMapsTorquesToForcesOfTheFoot) {
  const double l1 = 0.1, l2 = 0.2, gamma = 1.1, F_r = 12., F_t = -5.;
  const double root = std::sqrt(l2 * l2 - l1 * l1 * std::sin(gamma) * std::sin(gamma));
  const double r = l1 * std::cos(gamma) + root;
  const double slope = -l1 * std::sin(gamma) - l1 * l1 * std::sin(gamma) * std::cos(gamma) / root;
  const double sum = -F_t * r, difference = -F_r * slope;
  // Where the lower link turns to from the upper one's direction.
  const double knee = -(gamma + std::asin(l1 * std::sin(gamma) / l2));
  const auto leg = [&](const std::string& name, double side, double torque) {
    return "Chain " + name + " {" +
           FourBar::rod("upper", l1, 0.3,
                        fmt::format("angle = {}; torque = {};", side * gamma, torque)) +
           FourBar::rod("lower", l2, 0.3, fmt::format("dhlength = 0.1; angle = {};", side * knee)) +
           "}";
  };
  // phi is along x.
  Running run = running(
      "World w { gravity = 0; " + engine(1e-4) + " Robot leg { Base.fixed { } " +
      leg("a", 1., 0.5 * (sum + difference)) + leg("b", -1., 0.5 * (sum - difference)) +
      " Loop foot { a = a.lower; b = b.lower; point_a = 0.2, 0, 0; point_b = 0.2, 0, 0; } } "
      "Force push { body = leg.a.lower; point = 0.2, 0, 0; force = " +
      fmt::format("{}, {}, 0; }} }}", F_r, F_t));
  const double before = run["w.leg.a.upper.angle"];
  run.step(100);
  // Without the torques the leg would have turned by some 0.5 rad by then.
  EXPECT_NEAR(run["w.leg.a.upper.angle"], before, 1e-4);
  EXPECT_NEAR(run["w.leg.b.upper.angle"], -before, 1e-4);
  EXPECT_LT(run["w.leg.foot.error"], 1e-4);
}

// A foot on a universal joint (roll a about x, then pitch b about y) that two rods hold from behind,
// as in TALOS and Cassie. Rod i is L_i = |p_i - A_i| long, p_i = R(a, b) P_i, and by virtual work the
// forces F_i that balance a push f at r follow from sum_i F_i dL_i/dq_j = -axis_j . (r x f), with
// dL_i/dq_j = u_i . (axis_j x p_i), u_i along the rod.
TEST_P(PeerLoop, TheRodsOfAParallelAnkleCarryTheLoadOfItsFoot) {
  const double roll = 0.2, pitch = -0.3;
  const auto turned = [&](const Vector3d& at) {
    const double x = std::cos(pitch) * at.x + std::sin(pitch) * at.z;
    const double z = -std::sin(pitch) * at.x + std::cos(pitch) * at.z;
    return Vector3d(x, std::cos(roll) * at.y - std::sin(roll) * z,
                    std::sin(roll) * at.y + std::cos(roll) * z);
  };
  const std::array axes{Vector3d(1., 0., 0.), Vector3d(0., std::cos(roll), std::sin(roll))};
  const std::array anchors{Vector3d(-0.05, 0.06, 0.3), Vector3d(-0.05, -0.06, 0.3)};
  const std::array pins{Vector3d(-0.06, 0.05, -0.03), Vector3d(-0.06, -0.05, -0.03)};
  const Vector3d toe(0.1, 0.02, -0.05), push(30., -20., 200.);

  std::array<Vector3d, 2> along;
  std::array<std::array<double, 2>, 2> arm{};  // dL_i/dq_j
  std::array<double, 2> length{}, load{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3d rod = turned(pins[i]) - anchors[i];
    length[i] = norm(rod);
    along[i] = (1. / length[i]) * rod;
    for (std::size_t j = 0; j < 2; ++j) arm[i][j] = dot(along[i], cross(axes[j], turned(pins[i])));
    load[i] = -dot(axes[i], cross(turned(toe), push));
  }
  const double det = arm[0][0] * arm[1][1] - arm[1][0] * arm[0][1];
  const std::array forces{(load[0] * arm[1][1] - load[1] * arm[1][0]) / det,
                          (load[1] * arm[0][0] - load[0] * arm[0][1]) / det};

  // Axes of the foot's frame: x down, y backward, z to the left.
  const auto in_foot = [](const Vector3d& at) {
    return fmt::format("{}, {}, {}", -at.z, -at.x, at.y);
  };
  const std::string swing = "mass = 0.1; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; }";
  std::string text =
      "World w { gravity = 0; " + engine(1e-4) +
      " Robot ankle { Base.fixed { } Chain foot { hip_orientation = 0, pi/2, 0; Link "
      "roll { angle = 0.2; " +
      swing +
      " Link pitch { angle = -0.3; dhtwist = -pi/2; mass = 1; inertia = 5e-3, 5e-3, "
      "5e-3, 0, 0, 0; } }";
  for (std::size_t i = 0; i < 2; ++i) {
    text += fmt::format(
        " Chain rod{0} {{ hip_distance = {1}, {2}, {3}; hip_orientation = 0, {4}, {5}; Link a {{ {6} "
        "Link b {{ dhtwist = -pi/2; angle = pi/2; {6} Link slide {{ joint = prismatic; dhtwist = "
        "pi/2; angle = {7}; torque = {8}; {6} }} Loop pin{0} {{ a = rod{0}.slide; b = foot.pitch; "
        "point_b = {9}; }}",
        i, anchors[i].x, anchors[i].y, anchors[i].z, -std::asin(along[i].z),
        std::atan2(along[i].y, along[i].x), swing, length[i], forces[i], in_foot(pins[i]));
  }
  Running run = running(text + fmt::format(" }} Force push {{ body = ankle.foot.pitch; point = {}; "
                                           "force = {}, {}, {}; }} }}",
                                           in_foot(toe), push.x, push.y, push.z));
  run.step(100);
  // Without the rods the foot would have turned by some 0.2 rad by then.
  EXPECT_NEAR(run["w.ankle.foot.roll.angle"], roll, 1e-4);
  EXPECT_NEAR(run["w.ankle.foot.pitch.angle"], pitch, 1e-4);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string pin = fmt::format("w.ankle.pin{}", i);
    // On the slide, against its drive.
    EXPECT_NEAR(run[pin + ".force.x"], -forces[i] * along[i].x,
                GetParam().force * std::abs(forces[i]));
    EXPECT_NEAR(run[pin + ".force.z"], -forces[i] * along[i].z,
                GetParam().force * std::abs(forces[i]));
    EXPECT_LT(run[pin + ".error"], 1e-4);
  }
}

// A hexapod whose six feet are pinned to the ground: 24 joints, 18 conditions. Its body hangs on three
// slides and three hinges that carry nothing. The joint torques of a leg are -J^T times the force on
// its foot, so that they fix that force, however many feet stand: W/6 upward, and what a leg pushes
// outward, which the leg across takes.
TEST_P(PeerLoop, AClosedHexapodStandsOnSixFeetByTheTorquesOfItsLegs) {
  const double weight = 120., outward = 7., coxa = 0.03, femur = 0.1, tibia = 0.14, hip = 0.12;
  const double lift = 0.4, bend = -1.9;  // angles of femur and tibia
  const double reach = coxa + femur * std::cos(lift) + tibia * std::cos(lift + bend);
  const double height = -femur * std::sin(lift) - tibia * std::sin(lift + bend);
  const double F_z = weight / 6., F_r = -outward;  // of the ground on the foot
  const double at_lift = F_z * (reach - coxa) + F_r * height;
  const double at_bend = tibia * (std::cos(lift + bend) * F_z - std::sin(lift + bend) * F_r);

  const std::string inertia = " inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0;",
                    light = "mass = 0.2;" + inertia;
  // Slides along z, -y, x and hinges about x, y, z: the axes of `body` are the world's.
  std::string text =
      "World w { gravity = 0; " + engine(1e-4) + " Robot ant { Base.fixed { } Chain carriage { " +
      fmt::format("hip_distance = 0, 0, {};", height) + " Link z { joint = prismatic; " + light +
      " } Link y { joint = prismatic; dhtwist = pi/2; dhangle = pi/2; " + light +
      " } Link x { joint = prismatic; dhtwist = pi/2; " + light + " } Link roll { " + light +
      " } Link pitch { dhtwist = pi/2; angle = pi/2; " + light +
      " } Link body { dhtwist = pi/2; mass = 2; inertia = 0.02, 0.02, 0.03, 0, 0, 0; ";
  std::string pins;
  for (int i = 0; i < 6; ++i) {
    text += fmt::format(
        "Chain leg{} {{ hip_distance = {}, {}, 0; hip_orientation = 0, 0, {}; Link coxa {{ {} }} Link "
        "femur {{ dhlength = {}; dhtwist = pi/2; angle = {}; torque = {}; {} }} Link tibia {{ "
        "dhlength = {}; angle = {}; torque = {}; {} }} }} ",
        i, hip * std::cos(i * M_PI / 3.), hip * std::sin(i * M_PI / 3.), i * M_PI / 3., light, coxa,
        lift, -at_lift, light, femur, bend, -at_bend, light);
    pins += fmt::format(
        " Loop pin{0} {{ a = carriage.body.leg{0}.tibia; b = base; point_a = {1}, 0, 0; point_b = {2}, {3}, 0; }}",
        i, tibia, (hip + reach) * std::cos(i * M_PI / 3.), (hip + reach) * std::sin(i * M_PI / 3.));
  }
  Running run = running(
      text + "} }" + pins +
      fmt::format(" }} Force load {{ body = ant.carriage.body; force = 0, 0, {}; }} }}", -weight));
  run.step(100);
  // Without the torques the body would have sunk by some 0.5 mm by then.
  for (const char* slide : {"x", "y", "z"})
    EXPECT_NEAR(run[fmt::format("w.ant.carriage.{}.angle", slide)], 0., 1e-6);
  for (int i = 0; i < 6; ++i) {
    const std::string pin = fmt::format("w.ant.pin{}", i);
    EXPECT_NEAR(run[pin + ".force.z"], F_z, GetParam().force * F_z);
    EXPECT_NEAR(run[pin + ".force.x"], F_r * std::cos(i * M_PI / 3.), GetParam().force * F_z);
    EXPECT_LT(run[pin + ".error"], 1e-4);
  }
}

// A weight m on a rack turns a pinion of inertia I and radius r at g m / (m + I / r^2).
TEST_P(PeerLoop, ARackTurnsItsPinion) {
  const double m = 2., I = 0.03, r = 0.1;
  const std::string text =
      "World w { gravity = 0, -9.81, 0; " + engine(1e-3) +
      " Robot train { Base.fixed { } Chain drum { Link wheel { mass = 1; inertia = 0.03, "
      "0.03, 0.03, 0, 0, 0; mimic = rack.weight; mimic_ratio = 10; mimic_offset = 0.3; } } "
      "Chain rack { hip_orientation = pi/2, 0, 0; Link weight { joint = prismatic; mass = 2; "
      "inertia = 0.1, 0.1, 0.1, 0, 0, 0; } } } }";
  if (GetParam().engine.starts_with("ode")) {
    EXPECT_THROW(running(text), simulation::ExperimentError);
    return;
  }
  Running run = running(text);
  run.step(500);
  const double acceleration = g * m / (m + I / (r * r));
  const double travel = run["w.train.rack.weight.angle"];
  EXPECT_NEAR(run["w.train.rack.weight.rate"], 0.5 * acceleration, 1e-3 * acceleration);
  EXPECT_NEAR(run["w.train.drum.wheel.angle"], 0.3 + travel / r, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Engines, PeerLoop, ::testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.engine; });

}  // namespace
}  // namespace hookpoint
