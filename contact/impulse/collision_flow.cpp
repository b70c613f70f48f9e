#include "contact/impulse/collision_flow.h"

#include <array>
#include <cmath>

namespace hookpoint::contact {

CollisionAxes collision_axes(const Symmetric3d& K, const Vector3d& n) {
  // Any tangent first: across the coordinate axis that is farthest from n.
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const Vector3d far = x <= y && x <= z ? Vector3d{1., 0., 0.}
                       : y <= z         ? Vector3d{0., 1., 0.}
                                        : Vector3d{0., 0., 1.};
  Vector3d t1 = tangential(far, n);
  t1 = (1. / norm(t1)) * t1;
  const Vector3d t2 = cross(n, t1);
  // Then Jacobi's rotation to the eigenvectors of the tangential block.
  const Vector3d Kt1 = K * t1, Kt2 = K * t2;
  const double angle = 0.5 * std::atan2(2. * dot(t1, Kt2), dot(t1, Kt1) - dot(t2, Kt2));
  const SineCosine<double> turn = sine_cosine(angle);
  CollisionAxes axes;
  axes.e1 = turn.cosine * t1 + turn.sine * t2;
  axes.e2 = turn.cosine * t2 - turn.sine * t1;
  axes.n = n;
  const Vector3d Kn = K * n;
  axes.k1 = dot(axes.e1, Kn);
  axes.k2 = dot(axes.e2, Kn);
  axes.a1 = dot(axes.e1, K * axes.e1);
  axes.a2 = dot(axes.e2, K * axes.e2);
  axes.knn = dot(n, Kn);
  return axes;
}

StoppedFriction stopped_friction(const CollisionAxes& axes, double mu) {
  // Sticking: 0 = k + A f, so f = -A^-1 k; it lasts if |f| <= mu.
  double f1 = -axes.k1 / axes.a1;
  double f2 = -axes.k2 / axes.a2;
  const double hold = std::hypot(f1, f2);
  if (hold > mu && mu > 0.) {
    // Sliding off along t means k - mu A t = c t with c > 0, so (c 1 + mu A) t = k with |t| = 1.
    // |t| falls monotonically in c and is hold/mu > 1 at c = 0: there is exactly one such
    // direction. Newton on 1/|t| - 1, which is concave, from c = 0 rises monotonically to it.
    double c = 0.;
    double t1 = 0., t2 = 0.;
    for (int iteration = 0; iteration < 60; ++iteration) {
      const double b1 = c + mu * axes.a1, b2 = c + mu * axes.a2;
      t1 = axes.k1 / b1;
      t2 = axes.k2 / b2;
      const double squared = t1 * t1 + t2 * t2;
      const double length = std::sqrt(squared);
      const double change = (length - 1.) * squared / (t1 * t1 / b1 + t2 * t2 / b2);
      if (!(change > 1e-15 * (c + axes.knn))) break;
      c += change;
    }
    const double length = std::hypot(t1, t2);
    f1 = -mu * t1 / length;
    f2 = -mu * t2 / length;
  } else if (hold > mu) {
    f1 = f2 = 0.;
  }
  return {f1, f2, axes.knn + axes.k1 * f1 + axes.k2 * f2};
}

namespace {

constexpr std::size_t component_count = 7;
constexpr std::size_t stage_count = 7;
using Components = std::array<double, component_count>;  // of a CollisionPoint, in its order
// Derivatives component by component, stages inside: sums over the stages then need no gather
// (twice as fast with GCC 12).
using Slopes = std::array<std::array<double, stage_count>, component_count>;

void derivative(const CollisionAxes& axes, double mu, double un, const Components& at,
                std::size_t stage, Slopes& slope) {
  const double s = at[0], c = at[1], d = at[2];
  const SlidingRates rates = sliding_rates(axes, mu, c, d);
  const double normal = un + axes.k1 * at[3] + axes.k2 * at[4] + axes.knn * at[5];
  slope[0][stage] = rates.speed * s;
  slope[1][stage] = -rates.turn * d;
  slope[2][stage] = rates.turn * c;
  slope[3][stage] = -mu * c * s;
  slope[4][stage] = -mu * d * s;
  slope[5][stage] = s;
  slope[6][stage] = normal * s;
}

// Dormand & Prince 1980, RK5(4)7M: stage coefficients, and fifth- minus fourth-order weights.
constexpr double stage_weights[stage_count - 1][stage_count - 1] = {
    {1. / 5.},
    {3. / 40., 9. / 40.},
    {44. / 45., -56. / 15., 32. / 9.},
    {19372. / 6561., -25360. / 2187., 64448. / 6561., -212. / 729.},
    {9017. / 3168., -355. / 33., 46732. / 5247., 49. / 176., -5103. / 18656.},
    {35. / 384., 0., 500. / 1113., 125. / 192., -2187. / 6784., 11. / 84.}};
constexpr double error_weights[stage_count] = {
    71. / 57600., 0., -71. / 16695., 71. / 1920., -17253. / 339200., 22. / 525., -1. / 40.};

}  // namespace

CollisionPoint sliding_step(const CollisionAxes& axes, double mu, double un,
                            const CollisionPoint& from, double dtau, double* error) {
  const Components start{from.s, from.c, from.d, from.p1, from.p2, from.pn, from.W};
  Slopes slope;
  derivative(axes, mu, un, start, 0, slope);
  Components to{};
  for (std::size_t stage = 0; stage + 1 < stage_count; ++stage) {
    for (std::size_t i = 0; i < component_count; ++i) {
      double rise = 0.;
      for (std::size_t j = 0; j <= stage; ++j) rise += stage_weights[stage][j] * slope[i][j];
      to[i] = start[i] + dtau * rise;
    }
    derivative(axes, mu, un, to, stage + 1, slope);
  }
  std::array<double, 3> local{};
  for (std::size_t i = 0; i < local.size(); ++i) {
    for (std::size_t j = 0; j < stage_count; ++j) local[i] += dtau * error_weights[j] * slope[i][j];
  }
  // An error of the direction matters by what slides along it, so it may grow as the point comes to
  // rest.
  *error = std::sqrt(local[0] * local[0] +
                     from.s * from.s * (local[1] * local[1] + local[2] * local[2]));
  const double scale = 1. / std::sqrt(to[1] * to[1] + to[2] * to[2]);
  return {to[0], scale * to[1], scale * to[2], to[3], to[4], to[5], to[6]};
}

}  // namespace hookpoint::contact
