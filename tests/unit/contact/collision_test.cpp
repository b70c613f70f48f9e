// One frictional collision against closed forms and against a plain, fine integration of Coulomb's
// law over the impulse.
#include "contact/impulse/collision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/rotation.h"

namespace hookpoint::contact {
namespace {

/// K = 1/m - [r] I^-1 [r] of a rigid body, written out by columns: du from dp = e_j is e_j/m +
/// (I^-1 (r x e_j)) x r.
Symmetric3d rigid_body_matrix(double mass, const Symmetric3d& inertia, const Vector3d& r) {
  const Symmetric3d J = inverse(inertia);
  const auto column = [&](const Vector3d& e) {
    return (1. / mass) * e + cross(J * cross(r, e), r);
  };
  const Vector3d x = column({1., 0., 0.}), y = column({0., 1., 0.}), z = column({0., 0., 1.});
  return {x.x, y.y, z.z, y.x, z.x, z.y};
}

const Vector3d kUp{0., 0., 1.};

TEST(Collision, PointReboundsWithRestitutionAndAtLeastAtTheReboundSpeed) {
  const Symmetric3d K{0.5, 0.5, 0.5, 0., 0., 0.};  // 2 kg
  const auto after = [&](double e, double u0) {
    return -3. + (K * resolve_collision({K, {0., 0., -3.}, kUp, 0.5, e, u0}).impulse).z;
  };
  EXPECT_NEAR(after(0.6, 1e-3), 1.8, 1e-14);
  EXPECT_NEAR(after(0., 1e-3), 1e-3, 1e-15);
  EXPECT_NEAR(after(0., 0.), 0., 1e-15);
  EXPECT_NEAR(after(0.1, 0.5), 0.5, 1e-14);
}

TEST(Collision, SphereThatGripsKeepsFiveSeventhsOfItsSpeed) {
  const double m = 3., R = 0.2, inertia = 0.4 * m * R * R;
  const Symmetric3d K = rigid_body_matrix(m, {inertia, inertia, inertia, 0., 0., 0.}, {0., 0., -R});
  const Vector3d v{1.2, -0.5, -2.};
  const Collision collision = resolve_collision({K, v, kUp, 0.9, 0.5, 0.});
  ASSERT_TRUE(collision.solved);
  const Vector3d after = v + (1. / m) * collision.impulse;
  EXPECT_NEAR(after.x, 5. / 7. * v.x, 1e-14);
  EXPECT_NEAR(after.y, 5. / 7. * v.y, 1e-14);
  EXPECT_NEAR(after.z, 1., 1e-14);
}

TEST(Collision, SphereThatSlidesFeelsTheLimitOfFriction) {
  const double m = 3., R = 0.2, inertia = 0.4 * m * R * R, mu = 0.1, e = 0.5;
  const Symmetric3d K = rigid_body_matrix(m, {inertia, inertia, inertia, 0., 0., 0.}, {0., 0., -R});
  const Vector3d v{3., 4., -2.};  // needs 2/7 * 5 m, has mu (1 + e) 2 m
  const Vector3d p = resolve_collision({K, v, kUp, mu, e, 0.}).impulse;
  const double pn = (1. + e) * 2. * m;
  EXPECT_NEAR(p.z, pn, 1e-13);
  EXPECT_NEAR(p.x, -mu * pn * 0.6, 1e-13);
  EXPECT_NEAR(p.y, -mu * pn * 0.8, 1e-13);
}

// A slender rod, half length l, at the angle a to the ground, falls along its own plane (Kane &
// Levinson's example): u = (0, 0, -w), r = l (cos a, 0, -sin a). In the plane K = [1/m + s^2 l^2/I,
// s c l^2/I; s c l^2/I, 1/m + c^2 l^2/I] with I = m l^2/3.
TEST(Collision, InclinedRodSticksOrSlidesOff) {
  const double m = 1.5, l = 0.4, a = 0.9, w = 2.;
  const double c = std::cos(a), s = std::sin(a), I = m * l * l / 3.;
  const Symmetric3d inertia{I * s * s + 1e-3 * c * c, I, I * c * c + 1e-3 * s * s, 0.,
                            (I - 1e-3) * s * c,       0.};
  const Symmetric3d K = rigid_body_matrix(m, inertia, {l * c, 0., -l * s});
  const double kxx = (1. + 3. * s * s) / m, kxz = 3. * s * c / m, kzz = (1. + 3. * c * c) / m;
  ASSERT_NEAR(K.xx, kxx, 1e-12);
  ASSERT_NEAR(K.xz, kxz, 1e-12);
  ASSERT_NEAR(K.zz, kzz, 1e-12);
  const double hold = kxz / kxx;
  const double sticking = w / (kzz - kxz * kxz / kxx);
  const Vector3d stuck = resolve_collision({K, {0., 0., -w}, kUp, 1.1 * hold, 0., 0.}).impulse;
  EXPECT_NEAR(stuck.z, sticking, 1e-12);
  EXPECT_NEAR(stuck.x, -hold * sticking, 1e-12);
  const double mu = 0.5 * hold;
  const Vector3d slid = resolve_collision({K, {0., 0., -w}, kUp, mu, 0., 0.}).impulse;
  EXPECT_NEAR(slid.z, w / (kzz - mu * kxz), 1e-12);
  EXPECT_NEAR(slid.x, -mu * slid.z, 1e-12);
}

// Slides against its direction of escape, stops during compression, then sticks: three straight
// pieces put together by hand.
TEST(Collision, PlanarSlideStopsThenSticksWithStrongesRestitution) {
  const Symmetric3d K{2., 1., 1.5, 0., -0.3, 0.};
  const double mu = 0.8, e = 0.7, u = 0.4, w = 3.;
  const double slope_t = K.xz - mu * K.xx, slope_n = K.zz - mu * K.xz;
  const double p1 = u / -slope_t;
  const double un1 = -w + slope_n * p1;
  ASSERT_LT(un1, 0.);
  const double work1 = 0.5 * (un1 * un1 - w * w) / slope_n;
  const double g = K.zz - K.xz * K.xz / K.xx;
  const double work = work1 - 0.5 * un1 * un1 / g;
  const double un2 = std::sqrt(-2. * g * e * e * work);
  const double pn = p1 + (un2 - un1) / g;
  const double pt = -mu * p1 - K.xz / K.xx * (un2 - un1) / g;
  const Vector3d p = resolve_collision({K, {u, 0., -w}, kUp, mu, e, 0.}).impulse;
  EXPECT_NEAR(p.z, pn, 1e-12);
  EXPECT_NEAR(p.x, pt, 1e-12);
  EXPECT_NEAR(p.y, 0., 1e-12);
}

/// Coulomb's law by small explicit midpoint steps of p_n in world axes, e = 0; a point slower than
/// a step's reach sticks if it can.
Vector3d by_small_steps(const Symmetric3d& K, const Vector3d& u0, double mu, int steps) {
  const double dp = -u0.z / K.zz / steps;
  const double block = K.xx * K.yy - K.xy * K.xy;
  const Vector3d hold{-(K.yy * K.xz - K.xy * K.yz) / block, -(K.xx * K.yz - K.xy * K.xz) / block,
                      1.};
  const bool holds = std::hypot(hold.x, hold.y) <= mu;
  const auto slip = [&](const Vector3d& v) {
    const double s = std::hypot(v.x, v.y);
    return Vector3d{-mu * v.x / s, -mu * v.y / s, 1.};
  };
  Vector3d p{};
  for (Vector3d u = u0; u.z < 0.; u = u0 + K * p) {
    if (holds && std::hypot(u.x, u.y) < 10. * dp * K.xx) {
      const double rate = (K * hold).z;
      return p + (-u.z / rate) * hold;
    }
    const Vector3d middle = u + 0.5 * dp * (K * slip(u));
    const Vector3d step = slip(middle);
    const double rate = (K * step).z;
    const double part = rate > 0. ? std::min(dp, -u.z / rate + 1e-300) : dp;
    p += part * step;
    if (part < dp) break;
  }
  return p;
}

TEST(Collision, CurvedSlidingAgreesWithSmallSteps) {
  const Symmetric3d inertia{0.05 / 12., 0.05 / 12., 0.08 / 12., 0., 0., 0.};
  for (const double mu : {0.2, 0.5, 1.5}) {
    for (int direction = 0; direction < 5; ++direction) {
      const double angle = 0.3 + 1.2 * direction;
      const Vector3d u{0.8 * std::cos(angle), 0.8 * std::sin(angle), -1.};
      const Symmetric3d K = rigid_body_matrix(1., inertia, {0.1, 0.06, -0.05});
      const Vector3d p = resolve_collision({K, u, kUp, mu, 0., 0.}).impulse;
      const Vector3d fine = by_small_steps(K, u, mu, 100000);
      EXPECT_LT(norm(p - fine), 2e-4 * norm(fine)) << mu << " " << direction;
      EXPECT_NEAR((u + K * p).z, 0., 1e-9) << mu << " " << direction;
    }
  }
}

// A slip in a plane of symmetry of K but for a hair aside comes to a stop and slides off again: it
// passes the standstill so closely that it hardly moves for a while. Its impulse is that of the
// plane itself, put together by hand: p1 until the stop, p2 on to u_n = 0, p3 to the rebound speed.
Vector3d planar_stop_and_escape(double a, double k, double knn, double mu, double u, double w,
                                double u0) {
  const double against = u > 0. ? 1. : -1., escape = k > 0. ? 1. : -1.;
  const double braking = -against * k + mu * a;
  const double p1 = std::abs(u) / braking;
  const double un1 = -w + (knn - mu * against * k) * p1;
  const double g = knn - mu * escape * k;
  const double p2 = (u0 - un1) / g;
  return {-mu * (against * p1 + escape * p2), 0., p1 + p2};
}

// Corners of a block of 1 kg, 0.2 x 0.2 x 0.1 m, that rests on microcollisions; slip along a
// diagonal.
TEST(Collision, AlmostStandingStillIsNoTrouble) {
  for (const CollisionProblem& problem :
       {CollisionProblem{{0x1.a1b3e5612089ep+1, 0x1.a1b3e561250cbp+1, 0x1.5e4c1a9edd34dp+2,
                          -0x1.5631ced754031p+0, 0x1.708b9a7b677bbp+0, 0x1.708b9a7b6648cp+0},
                         {-0x1.aa890b9beaddp-11, -0x1.aa89118963cc2p-11, -0x1.45e97721f581fp-8},
                         {0x1.f8dc28499d0e4p-5, 0x1.f8dc28499d0e3p-5, 0x1.fe0d3b41815a2p-1},
                         0.2,
                         0.,
                         0.005},
        CollisionProblem{{0x1.6fc21d08f4ca5p+1, 0x1.6fc21d085a262p+1, 0x1.903de2f75887ep+2,
                          -0x1.ba155f884aa96p+0, -0x1.3d5212392bc4ap-1, -0x1.3d521237bf70ep-1},
                         {0x1.7047a1d4f81e6p-10, 0x1.7047a5b80b34p-10, -0x1.5c9579e2315c3p-8},
                         {0x1.f6f058264f73ap-4, 0x1.f6f058264f738p-4, 0x1.f838b8c811c17p-1},
                         0.2,
                         0.,
                         0.005},
        CollisionProblem{{0x1.7bfb6a4fb01a1p+1, 0x1.7bfb6a51cc902p+1, 0x1.840495af41abp+2,
                          -0x1.a1a2c4f81cef9p+0, -0x1.d90c945d5adfp-1, -0x1.d90c94608674bp-1},
                         {0x1.9f091d79d5315p-11, 0x1.9f091fdda6b1fp-11, -0x1.4b9dd942a46a9p-8},
                         {0x1.f8dc28499d0e4p-5, 0x1.f8dc28499d0e3p-5, 0x1.fe0d3b41815a2p-1},
                         0.5,
                         0.,
                         0.005},
        CollisionProblem{{0x1.ba0db068a29f3p+1, 0x1.ba0db068e6842p+1, 0x1.45f24f973b6e4p+2,
                          -0x1.257e38c810761p+0, 0x1.a2b0d110ea2bcp+0, 0x1.a2b0d10c02bep+0},
                         {-0x1.0a17671d50ffbp-10, -0x1.0a176735d884fp-10, -0x1.43f82a5c22a0ep-8},
                         {0x1.f6f058264f73ap-4, 0x1.f6f058264f738p-4, 0x1.f838b8c811c17p-1},
                         0.5,
                         0.,
                         0.005}}) {
    const Vector3d slip = tangential(problem.u, problem.n);
    const Vector3d e = (1. / norm(slip)) * slip;
    const Vector3d planar = planar_stop_and_escape(
        dot(e, problem.K * e), dot(e, problem.K * problem.n), dot(problem.n, problem.K * problem.n),
        problem.mu, norm(slip), -dot(problem.u, problem.n), problem.rebound_speed);
    const Vector3d expected = planar.x * e + planar.z * problem.n;
    const Collision collision = resolve_collision(problem);
    ASSERT_TRUE(collision.solved) << problem.u.x;
    EXPECT_LT(norm(collision.impulse - expected), 1e-6 * norm(expected)) << problem.u.x;
  }
}

TEST(Collision, ApproachIsNeeded) {
  const Symmetric3d K{1., 1., 1., 0., 0., 0.};
  EXPECT_EQ(resolve_collision({K, {1., 0., 0.5}, kUp, 0.5, 0.5, 1e-3}).impulse, Vector3d{});
  EXPECT_EQ(resolve_collision({K, {1., 0., 0.}, kUp, 0.5, 0.5, 1e-3}).impulse, Vector3d{});
}

TEST(Collision, ImpossibleProblemsAreSaidToBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      resolve_collision({{1., 1., -1., 0., 0., 0.}, {0., 0., -1.}, kUp, 0.5, 0., 0.}).solved);
  EXPECT_FALSE(
      resolve_collision({{1., 1., 1., 0., 2., 0.}, {0., 0., -1.}, kUp, 0.5, 0., 0.}).solved);
  EXPECT_FALSE(
      resolve_collision({{1., 1., 1., 0., 0., 0.}, {nan, 0., -1.}, kUp, 0.5, 0., 0.}).solved);
  EXPECT_FALSE(
      resolve_collision({{1., 1., 1., 0., 0., 0.}, {0., 0., nan}, kUp, 0.5, 0., 0.}).solved);
}

}  // namespace
}  // namespace hookpoint::contact
