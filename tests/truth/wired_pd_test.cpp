// A joint under a wired controller against the discrete loop that it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "control/registry.h"
#include "simulation/analysis/stability.h"
#include "tests/support/folders.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using Values = std::vector<double>;

/// A controller of somebody else's, with names of its own.
class StateFeedback final : public control::Component {
 public:
  control::Parameter stiffness{*this, "stiffness", "?", 0., "force per position"};
  control::Parameter damping{*this, "damping", "?", 0., "force per speed"};
  control::Input position{*this, "position", "?", "of the slide"};
  control::Input speed{*this, "speed", "?", "of the slide"};
  control::Output force{*this, "force", "?", "on the slide"};

  void update(const control::Tick&) override { force = -stiffness * position - damping * speed; }
  std::vector<control::LinearFeedback> linearise() const override {
    return {{.input = position.index(),
             .output = force.index(),
             .rate = speed.index(),
             .gains = {.proportional = stiffness, .derivative = damping}}};
  }
};

/// The same, and it says nothing of itself.
class Unsaid final : public control::Component {
 public:
  control::Input position{*this, "position", "?", "of the slide"};
  control::Output force{*this, "force", "?", "on the slide"};
  void update(const control::Tick&) override { force = -400. * position; }
};

HOOKPOINT_REGISTER_COMPONENT(StateFeedback, "Test.StateFeedback", "a test's",
                             control::Attachment::none, "position", "force")
HOOKPOINT_REGISTER_COMPONENT(Unsaid, "Test.Unsaid", "a test's", control::Attachment::none,
                             "position", "force")

/// 1 kg on a slide that starts at 1 m at rest; PD at 100 Hz with `kd` = 0.1 `kp` and the true rate;
/// everything that it reads comes `samples` samples late. Between samples the force is constant,
/// which rk4 integrates exactly.
std::string sampled_slide(double kp, int samples) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = 2 ms; integrator = rk4; Robot bot {{ Base.fixed {{ }} "
      "Chain c {{ "
      "Link l {{ joint = prismatic; angle = 1; mass = 1; }} }} }} }}\n"
      "Controller.PD p {{ rate = 100 Hz; pconstant = {0}; dconstant = {1}; rate_in = 0; "
      "Wire FROM w.bot.c.l.angle TO current {{ delay = {2} ms; }} "
      "Wire FROM w.bot.c.l.rate TO rate_in {{ delay = {2} ms; }} Wire TO w.bot.c.l.torque; }}",
      kp, 0.1 * kp, 10 * samples);
}

/// x+ = x + T v + T^2/2 u, v+ = v + T u with u = -kp x - kd v of `samples` samples before.
Values discrete_loop(double kp, int samples, int count) {
  const double T = 0.01, kd = 0.1 * kp;
  Values x{1.}, v{0.};
  for (int k = 0; k < count; ++k) {
    const int seen = k - samples;
    const double u = seen < 0 ? 0. : -kp * x[seen] - kd * v[seen];
    x.push_back(x[k] + T * v[k] + T * T / 2. * u);
    v.push_back(v[k] + T * u);
  }
  return x;
}

TEST(WiredPd, FollowsTheDiscreteLoopSampleBySample) {
  for (const int samples : {0, 1, 3}) {
    const Values x = Running(sampled_slide(120., samples)).record("bot.c.l.angle", 5 * 200);
    const Values expected = discrete_loop(120., samples, 200);
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(x[5 * k], expected[k], 1e-11) << k;
  }
}

/// The largest |x| over the last second of ten, over that of the second before the fifth.
double growth(double kp, int samples) {
  const Values x = Running(sampled_slide(kp, samples)).record("bot.c.l.angle", 5000);
  const auto largest = [&](std::size_t from) {
    double most = 0.;
    for (std::size_t k = from; k < from + 500; ++k) most = std::max(most, std::fabs(x[k]));
    return most;
  };
  return largest(4500) / largest(2000);
}

// Zero-order hold on 1/s^2 with kd = 0.1 kp, T = 10 ms: the gains at which the closed loop's
// characteristic polynomial has a root on the unit circle.
TEST(WiredPd, IsStableUpToTheGainThatTheDelayLeaves) {
  const std::pair<int, double> limits[] = {{0, 2000.}, {1, 941.83}, {2, 543.93}, {5, 181.29}};
  for (const auto& [samples, limit] : limits) {
    EXPECT_LT(growth(0.99 * limit, samples), 1.) << samples;
    EXPECT_GT(growth(1.01 * limit, samples), 1.) << samples;
  }
}

/// 1 kg on a slide under a PD with 400 N/m and `kd`.
std::string held_slide(const std::string& integrator, double kd, double dt,
                       const std::string& more = "") {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {}; integrator = {}; Robot bot {{ Base.fixed {{ }} Chain c "
      "{{ Link l {{ joint = prismatic; angle = 1; mass = 1; }} }} }} }}\n"
      "Controller.PD p {{ pconstant = 400; dconstant = {}; {} Wire FROM w.bot.c.l.angle TO "
      "current; Wire FROM w.bot.c.l.rate TO rate_in; Wire TO w.bot.c.l.torque; }}",
      dt, integrator, kd, more);
}

/// The same mass under a controller that hookpoint does not know.
std::string slide_held_by_another(const std::string& integrator, double kd, double dt) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {}; integrator = {}; Robot bot {{ Base.fixed {{ }} Chain c "
      "{{ Link l {{ joint = prismatic; angle = 1; mass = 1; }} }} }} }}\n"
      "Test.StateFeedback p {{ stiffness = 400; damping = {}; Wire FROM w.bot.c.l.angle TO "
      "position; Wire FROM w.bot.c.l.rate TO speed; Wire TO w.bot.c.l.torque; }}",
      dt, integrator, kd);
}

double bound(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return simulation::stability_bound(*loaded.experiment).step;
}

// The Euler methods see the controller as they see a spring and a damper. RK4 is exact under a held
// force, x+ = x + h v + h^2/2 u, and on the unit circle 4 = 2 h kd or h kp = 2 kd.
TEST(WiredPd, TheStepItBearsIsThatOfTheClosedForm) {
  for (const double kd : {1., 10., 30., 50.}) {
    const double root = std::sqrt(std::max(0., kd * kd - 1600.));
    const double explicit_euler = kd < 40. ? kd / 400. : 4. / (kd + root);
    EXPECT_NEAR(bound(held_slide("explicit_euler", kd, 1e-3)) / explicit_euler, 1., 1e-6);
    EXPECT_NEAR(bound(held_slide("semi_implicit_euler", kd, 1e-3)) * 400. /
                    (std::sqrt(kd * kd + 1600.) - kd),
                1., 1e-6);
    EXPECT_NEAR(bound(held_slide("rk4", kd, 1e-3)) / std::min(2. / kd, kd / 200.), 1., 1e-6);
  }
  EXPECT_EQ(bound(held_slide("explicit_euler", 0., 1e-3)), 0.);
}

// Any class that says how its output follows its inputs is in the bound, and the run agrees.
TEST(WiredPd, AControllerThatLinearisesItselfIsBoundAlike) {
  for (const double kd : {10., 30.}) {
    const std::pair<const char*, double> steps[] = {
        {"explicit_euler", kd / 400.},
        {"semi_implicit_euler", (std::sqrt(kd * kd + 1600.) - kd) / 400.},
        {"rk4", std::min(2. / kd, kd / 200.)}};
    for (const auto& [integrator, step] : steps) {
      EXPECT_NEAR(bound(slide_held_by_another(integrator, kd, 1e-3)) / step, 1., 1e-6);
      const auto largest = [&](double part) {
        const double dt = std::round(part * step * 1e9) * 1e-9;
        const Values x =
            Running(slide_held_by_another(integrator, kd, dt)).record("bot.c.l.angle", 1000);
        double most = 0.;
        for (std::size_t k = 900; k < x.size(); ++k) most = std::max(most, std::fabs(x[k]));
        return most;
      };
      EXPECT_LT(largest(0.99), 0.5) << integrator << " " << kd;
      EXPECT_GT(largest(1.01), 2.) << integrator << " " << kd;
    }
  }
}

// From the position alone the velocity of a semi-implicit step is known: (x - x_before)/h.
TEST(WiredPd, ADifferencedRateCostsASemiImplicitStepNothing) {
  std::string text = held_slide("semi_implicit_euler", 10., 1e-3);
  const std::string rate = "Wire FROM w.bot.c.l.rate TO rate_in;";
  text.replace(text.find(rate), rate.size(), "");
  EXPECT_NEAR(bound(text) * 400. / (std::sqrt(1700.) - 10.), 1., 1e-6);
}

// The gains of the test above: below, any step that divides 10 ms is borne, and above, none.
TEST(WiredPd, TheBoundKnowsTheGainThatSamplingAndDelayLeave) {
  const std::pair<int, double> limits[] = {{0, 2000.}, {1, 941.83}, {2, 543.93}, {5, 181.29}};
  for (const auto& [samples, limit] : limits) {
    EXPECT_GE(bound(sampled_slide(0.999 * limit, samples)), 0.01) << samples;
    EXPECT_EQ(bound(sampled_slide(1.001 * limit, samples)), 0.) << samples;
  }
}

/// How much faster the world's joints move in the last tenth of `steps` than in the fifth.
double unrest(Running run, int steps, const std::vector<std::string>& rates) {
  std::vector<const double*> values;
  for (const std::string& trail : rates) values.push_back(run.port(trail).value);
  double early = 0., late = 0.;
  for (int k = 0; k < steps; ++k) {
    if (!run.world().step().ok()) return INFINITY;
    for (const double* value : values) {
      if (10 * k / steps == 4) early = std::max(early, std::fabs(*value));
      if (10 * k / steps == 9) late = std::max(late, std::fabs(*value));
    }
  }
  return late / early;
}

std::string two_joints(const std::string& integrator, double dt, const std::string& controller) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {}; integrator = {}; Robot bot {{ Base.fixed {{ }} Chain c "
      "{{ Link a {{ mass = 2; center_of_mass = 0.3,0,0; inertia = 0.1,0.1,0.1,0,0,0; }} "
      "Link b {{ dhlength = 0.5; angle = 1e-15; mass = 1; center_of_mass = 0.2,0,0; inertia = "
      "0.02,0.02,0.02,0,0,0; }} }} }} }}\n{}",
      dt, integrator, controller);
}

// Steps 1 % below and above the bound, in the engine: controllers with memory, at a rate, late.
TEST(WiredPd, OscillationsGrowFromTheBoundOn) {
  const auto loop = [](const std::string& type, const std::string& joint,
                       const std::string& wires) {
    return "Controller." + type + " " + joint + " { pconstant = 300; dconstant = 6; " + wires +
           " Wire FROM w.bot.c." + joint + ".angle TO current; Wire TO w.bot.c." + joint +
           ".torque; }\n";
  };
  const auto both = [&](const std::string& type, const std::string& wires) {
    return loop(type, "a", wires) + loop(type, "b", wires);
  };
  const std::vector<std::string> controllers{
      both("PD", ""), both("PID", "iconstant = 500; filter_time = 2 ms;"),
      loop("PD", "a", "Wire FROM w.bot.c.a.rate TO rate_in;") + loop("PID", "b", "")};
  for (const std::string& controller : controllers) {
    for (const std::string integrator : {"explicit_euler", "semi_implicit_euler", "rk4"}) {
      const double limit = bound(two_joints(integrator, 1e-3, controller));
      ASSERT_GT(limit, 1e-5);
      ASSERT_LT(limit, 0.1);
      const auto moves = [&](double part) {
        const double dt = std::round(part * limit * 1e9) * 1e-9;
        return unrest(Running(two_joints(integrator, dt, controller)), 1000,
                      {"bot.c.a.rate", "bot.c.b.rate"});
      };
      EXPECT_LT(moves(0.99), 1.) << integrator << " " << controller;
      EXPECT_GT(moves(1.01), 1.) << integrator << " " << controller;
    }
  }
}

// Ten joints held by controllers, on a ground: it settles below the bound and trembles above. A
// push of one foot starts all modes; rounding alone would leave when to the compiler.
TEST(WiredPd, ABipedTremblesFromTheBoundOn) {
  const auto biped = [](double dt) {
    return load_file(
        std::filesystem::path(testing::source_folder()) / "configs/scenes/standing_biped.hook",
        {{}, {{"world.deltat", fmt::format("{}", dt)}, {"world.biped.leg[1].foot.rate", "0.1"}}});
  };
  const simulation::StabilityBound bound = simulation::stability_bound(*biped(1e-4).experiment);
  EXPECT_EQ(bound.controllers.size(), 10u);
  EXPECT_EQ(bound.left_out.size(), 0u);
  const std::vector<std::string> rates{"biped.leg[0].thigh.rate", "biped.leg[0].shank.rate",
                                       "biped.leg[1].ankle.rate", "biped.leg[1].foot.rate"};
  const auto at = [&](double part) { return biped(std::round(part * bound.step * 1e9) * 1e-9); };
  EXPECT_LT(unrest(Running(at(0.99)), 5000, rates), 0.9);
  Running shaken(at(1.01));
  double most = 0.;
  shaken.step(4000);
  for (int k = 0; k < 1000; ++k) {
    shaken.step();
    most = std::max(most, std::fabs(shaken["biped.leg[1].foot.rate"]));
  }
  EXPECT_GT(most, 1.);
}

TEST(WiredPd, WhatTheBoundLeavesOutIsNamed) {
  const auto left_out = [](const std::string& text) {
    const Loaded loaded = load_text(text);
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    return simulation::stability_bound(*loaded.experiment).left_out;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(left_out(held_slide("rk4", 10., 1e-3)), Names{});
  EXPECT_EQ(left_out(held_slide("rk4", 10., 1e-3, "rate = 100 Hz;")), Names{});
  const std::string late = "Wire FROM w.bot.c.l.angle TO current { delay = 5 ms; }";
  std::string text = held_slide("rk4", 10., 1e-3);
  const std::string wire = "Wire FROM w.bot.c.l.angle TO current;";
  text.replace(text.find(wire), wire.size(), late);
  EXPECT_EQ(left_out(text), Names{"p: late, without a rate"});
  EXPECT_EQ(
      left_out(held_slide("rk4", 10., 1e-3) + "Gain g { Wire FROM w.bot.c.l.rate TO input; Wire "
                                              "TO p.goal; }"),
      Names{"g: a Gain is not one of the PD and PID controllers whose feedback is computed"});
  EXPECT_EQ(left_out("World w { gravity = 0; Robot bot { Base.fixed { } Chain c { Link l { joint = "
                     "prismatic; mass = 1; } } } }\nTest.Unsaid u { Wire FROM w.bot.c.l.angle TO "
                     "position; Wire TO w.bot.c.l.torque; }"),
            Names{"u: a Test.Unsaid is not one of the PD and PID controllers whose feedback is "
                  "computed"});
}

// At rest the drive bears gravity: kp (goal - angle) = m g l cos(angle) for a bar from the
// horizontal.
TEST(WiredPd, APendulumRestsWhereTheDriveBearsItsWeight) {
  Running run(
      "World w { Robot bot { Base.fixed { } Chain c { hip_orientation = 90 deg,0,0; Link l { mass "
      "= 2; "
      "center_of_mass = 0.5,0,0; inertia = 0.1,0.1,0.1,0,0,0; } } } }\n"
      "Controller.PD p { goal = 0.3; pconstant = 200; dconstant = 30; Wire FROM w.bot.c.l.angle TO "
      "current; "
      "Wire FROM w.bot.c.l.rate TO rate_in; Wire TO w.bot.c.l.torque; }");
  run.step(5000);
  const double angle = run["bot.c.l.angle"];
  EXPECT_NEAR(200. * (0.3 - angle), 2. * 9.81 * 0.5 * std::cos(angle), 1e-9);
}

// The paper's arm. m g . J at rest, the links' centres of mass by the frames of Fig. 7.
TEST(WiredPd, TheArmOfFigure7SettlesAtItsGoals) {
  const double kp1 = 6000., kp2 = 3000., goal1 = 0.5, goal2 = -0.4;
  const Loaded loaded = load_file(
      std::filesystem::path(testing::source_folder()) / "configs/paper/fig7_two_joint_arm.hook",
      {{},
       {{"pd1.goal", "0.5"},
        {"pd1.pconstant", "6000"},
        {"pd1.dconstant", "300"},
        {"pd2.goal", "-0.4"},
        {"pd2.pconstant", "3000"},
        {"pd2.dconstant", "100"}}});
  Running run(loaded);
  run.step(15000);
  const double q1 = run["simplebot.leg1.link1.angle"], q2 = run["simplebot.leg1.link2.angle"];
  const auto center = [](double R, double r, double L) {
    return L * (R * R + 2 * R * r + 3 * r * r) / (4 * (R * R + R * r + r * r));
  };
  // Height of the two centres of mass, Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d) for each
  // link.
  const auto height = [&](double a, double b) {
    const double c1 = center(0.15, 0.1, 1.), c2 = center(0.1, 0.05, 0.65);
    const double alpha1 = 1.57, alpha2 = -1.57;
    const auto turned = [](double angle, Vector3d p) {
      return Vector3d{p.x, std::cos(angle) * p.y - std::sin(angle) * p.z,
                      std::sin(angle) * p.y + std::cos(angle) * p.z};
    };
    const auto spun = [](double angle, Vector3d p) {
      return Vector3d{std::cos(angle) * p.x - std::sin(angle) * p.y,
                      std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
    };
    const auto from_link1 = [&](Vector3d p) {
      return turned(alpha1, spun(a, p + Vector3d{0., 0., 0.15}));
    };
    const Vector3d in_link2 = spun(b, Vector3d{c2, 0., 0.4}) + Vector3d{0.1, 0., 0.};
    return from_link1({c1, 0., 0.}).z + from_link1(turned(alpha2, in_link2)).z;
  };
  constexpr double h = 1e-5;
  const double torque1 = 9.81 * (height(q1 + h, q2) - height(q1 - h, q2)) / (2. * h);
  const double torque2 = 9.81 * (height(q1, q2 + h) - height(q1, q2 - h)) / (2. * h);
  EXPECT_NEAR(q1, goal1 - torque1 / kp1, 1e-6);
  EXPECT_NEAR(q2, goal2 - torque2 / kp2, 1e-6);
}

}  // namespace
}  // namespace hookpoint
