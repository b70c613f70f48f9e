// Friction of several points under given normal impulses, against Coulomb's conditions themselves: inside
// its disc a point sticks, at the edge it slips against its friction; also where points are redundant.
#include "contact/impulse/friction_discs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace hookpoint::contact {
namespace {

constexpr std::size_t kMost = 8;

/// A = J J^T of points on a body that moves in `freedoms` ways, and slips u that such a body can have.
struct Slips {
  std::vector<double> A, u, radius;
};

Slips random_slips(std::mt19937& random, std::size_t points, std::size_t freedoms) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0., 1.);
  const std::size_t n = 2 * points;
  std::vector<double> J(n * freedoms), v(freedoms);
  for (double& entry : J) entry = normal(random);
  for (double& entry : v) entry = normal(random);
  Slips slips{std::vector<double>(n * n), std::vector<double>(n), std::vector<double>(points)};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < freedoms; ++k) {
      slips.u[i] += J[i * freedoms + k] * v[k];
      for (std::size_t j = 0; j < n; ++j)
        slips.A[i * n + j] += J[i * freedoms + k] * J[j * freedoms + k];
    }
  }
  for (double& radius : slips.radius) radius = unit(random) < 0.2 ? 0. : unit(random);
  return slips;
}

TEST(FrictionDiscs, EachPointSticksOrSlipsAgainstItsFriction) {
  std::mt19937 random(23);
  FrictionDiscs discs(kMost);
  int sticking = 0, slipping = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::size_t points = 1 + static_cast<std::size_t>(trial) % kMost;
    const std::size_t freedoms = trial % 3 == 0 ? 3 : 6;
    const Slips slips = random_slips(random, points, freedoms);
    const std::size_t n = 2 * points;
    std::vector<double> f(n, 0.);
    ASSERT_TRUE(discs.find(slips.A, n, slips.u, slips.radius, f, 1e-12)) << trial;
    for (std::size_t k = 0; k < points; ++k) {
      double slip[2] = {slips.u[2 * k], slips.u[2 * k + 1]};
      for (std::size_t j = 0; j < n; ++j) {
        slip[0] += slips.A[2 * k * n + j] * f[j];
        slip[1] += slips.A[(2 * k + 1) * n + j] * f[j];
      }
      const double speed = std::hypot(slip[0], slip[1]), radius = slips.radius[k];
      const double friction = std::hypot(f[2 * k], f[2 * k + 1]);
      EXPECT_LE(friction, radius * (1. + 1e-12)) << trial;
      // Against the slip with all that there is, or no slip: f . slip = -radius |slip|.
      EXPECT_NEAR(f[2 * k] * slip[0] + f[2 * k + 1] * slip[1], -radius * speed, 1e-6) << trial;
      if (radius > 0.) ++(speed < 1e-6 ? sticking : slipping);
    }
  }
  EXPECT_GT(sticking, 500);
  EXPECT_GT(slipping, 500);
}

// The slip that is left is unique: from any guess the same.
TEST(FrictionDiscs, TheSlipDoesNotDependOnTheGuess) {
  std::mt19937 random(29);
  std::normal_distribution<double> normal;
  FrictionDiscs discs(kMost);
  for (int trial = 0; trial < 500; ++trial) {
    const Slips slips = random_slips(random, kMost, trial % 2 == 0 ? 3 : 6);
    const std::size_t n = 2 * kMost;
    std::vector<double> a(n, 0.), b(n);
    for (double& entry : b) entry = normal(random);
    ASSERT_TRUE(discs.find(slips.A, n, slips.u, slips.radius, a, 1e-12));
    ASSERT_TRUE(discs.find(slips.A, n, slips.u, slips.radius, b, 1e-12));
    for (std::size_t i = 0; i < n; ++i) {
      double difference = 0.;
      for (std::size_t j = 0; j < n; ++j) difference += slips.A[i * n + j] * (a[j] - b[j]);
      EXPECT_NEAR(difference, 0., 1e-6) << trial;
    }
  }
}

}  // namespace
}  // namespace hookpoint::contact
