// A joint under a wired controller against the discrete loop that it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using Values = std::vector<double>;

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
      std::filesystem::path(HOOKPOINT_SOURCE_DIR) / "configs/paper/fig7_two_joint_arm.hook",
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
