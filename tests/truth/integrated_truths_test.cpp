// Expects of scenes without a closed form: the numbers that they state are solutions of the system's own
// equations of motion, integrated here by a Runge-Kutta method that shares nothing with the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "math/vector3.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

double expected(const simulation::Experiment& scene, const std::string& name) {
  return std::ranges::find(scene.expectations, name, &simulation::ExpectationSpec::name)->expected;
}

/// One classical step of y' = f(y).
template <std::size_t n, class Rate>
std::array<double, n> stepped(const std::array<double, n>& y, double h, const Rate& rate) {
  const auto moved = [&](const std::array<double, n>& k, double by) {
    std::array<double, n> at;
    for (std::size_t i = 0; i < n; ++i) at[i] = y[i] + by * k[i];
    return at;
  };
  const auto k1 = rate(y), k2 = rate(moved(k1, 0.5 * h)), k3 = rate(moved(k2, 0.5 * h)),
             k4 = rate(moved(k3, h));
  std::array<double, n> sum;
  for (std::size_t i = 0; i < n; ++i) sum[i] = (k1[i] + 2. * k2[i] + 2. * k3[i] + k4[i]) / 6.;
  return moved(sum, h);
}

// A rigid ball with its centre of mass G at a below its middle O rolls and slips on a rigid plane:
// O = G + a e, r = a e - R z from G to the contact, isotropic inertia I,
//   e' = w x e,  I w' = r x F,  m v' = F - m g z,  F = N (-mu s/sqrt(s^2 + vs^2) + z),  s = (v + w x r)
// along the plane. The plane holds O at R: G_z = R - a e_z, which gives N.
TEST(IntegratedTruths, ATippeTopUnderRegularisedFriction) {
  constexpr double R = 0.02, a = 0.2 * R, m = 0.02, I = 0.4 * m * R * R, g = 9.81;
  constexpr double mu = 0.3, vs = 1e-3, spin = 200., lean = 0.1, h = 1e-5;
  const auto rate = [&](const std::array<double, 8>& y) {
    const Vector3d e{y[0], y[1], y[2]}, w{y[3], y[4], y[5]};
    const Vector3d turn = cross(w, e);
    const Vector3d r = a * e - Vector3d{0., 0., R};
    const Vector3d arm = cross(w, r);
    const double sx = y[6] + arm.x, sy = y[7] + arm.y;
    const double share = mu / std::sqrt(sx * sx + sy * sy + vs * vs);
    const Vector3d F{-share * sx, -share * sy, 1.};  // of N
    const Vector3d w_rate = (1. / I) * cross(r, F);  // of N
    // N - m g = -m a e_z'' = -m a (N (w_rate x e) + w x (w x e))_z.
    const double N = (m * g - m * a * cross(w, turn).z) / (1. + m * a * cross(w_rate, e).z);
    return std::array{turn.x,       turn.y,       turn.z,      N * w_rate.x,
                      N * w_rate.y, N * w_rate.z, N * F.x / m, N * F.y / m};
  };
  std::array<double, 8> y{
      std::sin(lean), 0., std::cos(lean), spin * std::sin(lean), 0., spin * std::cos(lean), 0., 0.};
  double level_at = 0.;  // for the first time [s]
  for (int i = 0; i < 1200000; ++i) {
    const double before = y[2];
    y = stepped(y, h, rate);
    if (level_at == 0. && before > 0. && y[2] <= 0.) level_at = h * (i + before / (before - y[2]));
  }
  const simulation::Experiment scene = testing::load_scene("scenes/tippe_top.hook", {});
  EXPECT_NEAR(level_at, expected(scene, "lies_level_at"), 1e-3);
  EXPECT_NEAR(y[2], expected(scene, "turned_over"), 5e-3);
  EXPECT_NEAR(y[5], expected(scene, "spin_at_the_end"), 0.02);
}

// LuGre friction (Canudas de Wit, Olsson, Astrom & Lischinsky 1995, equations 1 to 3 and 8) under a PID.
TEST(IntegratedTruths, AMassThatHunts) {
  constexpr double s0 = 1e5, s2 = 0.4, Fc = 1., Fs = 1.5, vs = 1e-3, Kp = 3., Kv = 6., Ki = 4.;
  const double s1 = std::sqrt(s0);
  const auto rate = [&](const std::array<double, 4>& y) {
    const auto& [x, v, z, integral] = y;
    const double g = Fc + (Fs - Fc) * std::exp(-(v / vs) * (v / vs));
    const double bristle = v - s0 * std::abs(v) / g * z;
    const double friction = s0 * z + s1 * bristle + s2 * v;
    return std::array{v, -Kv * v - Kp * (x - 1.) - Ki * integral - friction, bristle, x - 1.};
  };
  constexpr double h = 2e-5;
  std::array<double, 4> y{};
  double high = 0., low = 2.;
  std::vector<double> crossings;
  for (int i = 0; i < 4500000; ++i) {
    const double before = y[0];
    y = stepped(y, h, rate);
    if (h * i < 60.) continue;
    high = std::max(high, y[0]);
    low = std::min(low, y[0]);
    if ((before < 1.) != (y[0] < 1.)) crossings.push_back(h * (i + 1));
  }
  const simulation::Experiment scene = testing::load_scene("scenes/pid_hunting.hook", {});
  ASSERT_FALSE(crossings.empty());
  EXPECT_NEAR(crossings.front(), expected(scene, "crossing"), 0.01);
  EXPECT_NEAR(high, expected(scene, "highest"), 1e-5);
  EXPECT_NEAR(low, expected(scene, "lowest"), 1e-5);
}

// A rigid ball about an edge: y = (angle q of its centre, speed v, spin w). It rolls while the edge's
// friction holds 2/7 m g sin q, then slips, until the edge no longer presses.
TEST(IntegratedTruths, ABallThatRollsAndSlipsOffAnEdge) {
  constexpr double g = 9.81, r = 0.1, mu = 5., v0 = 0.1, h = 1e-5;
  const auto pressure = [&](const std::array<double, 3>& y) {
    return g * std::cos(y[0]) - y[1] * y[1] / r;  // per unit of mass
  };
  const auto rolls = [&](const std::array<double, 3>& y) {
    const double along = 5. / 7. * g * std::sin(y[0]);
    return std::array{y[1] / r, along, along / r};
  };
  const auto slips = [&](const std::array<double, 3>& y) {
    const double friction = mu * pressure(y);
    return std::array{y[1] / r, g * std::sin(y[0]) - friction, 2.5 * friction / r};
  };
  std::array<double, 3> y{0., v0, v0 / r};
  while (2. / 7. * g * std::sin(y[0]) <= mu * pressure(y)) y = stepped(y, h, rolls);
  while (pressure(y) > 0.) y = stepped(y, h, slips);
  const simulation::Experiment scene = testing::load_scene("scenes/ball_off_step.hook", {});
  EXPECT_NEAR(y[2], expected(scene, "spin"), 1e-4);
}

}  // namespace
}  // namespace hookpoint
