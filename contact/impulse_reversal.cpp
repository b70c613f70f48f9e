#include "contact/impulse_reversal.h"

#include <algorithm>
#include <limits>

namespace hookpoint::contact {
namespace {

constexpr int kMostSweeps = 400;
constexpr int kPatience = 8;  // sweeps in which the missing velocity has to fall by a tenth

Vector3d velocity_of(const Twist& twist, const ReversalPoint& point) {
  return twist.velocity + cross(twist.angular_velocity, point.arm);
}

// The nearest impulse of the cone |p_t| <= mu p_n.
Vector3d projected(const Vector3d& p, const Vector3d& n, double mu) {
  const double normal = dot(p, n);
  const Vector3d tangent = p - normal * n;
  const double size = norm(tangent);
  if (size <= mu * normal) return p;
  if (mu * size <= -normal) return {};
  const double nearest = (normal + mu * size) / (1. + mu * mu);
  return nearest * n + (mu * nearest / size) * tangent;
}

// -gain with its tangential part times `share`.
Vector3d target_of(const ReversalPoint& point, double share) {
  const double normal = dot(point.gain, point.normal);
  return -(normal * point.normal + share * (point.gain - normal * point.normal));
}

bool reverse_share(std::span<ReversalPoint> points, double mass, const Symmetric3d& inverse_inertia,
                   double tolerance, double share, Twist& twist) {
  Twist trial = twist;
  for (ReversalPoint& point : points) point.impulse = {};
  double before = std::numeric_limits<double>::infinity();
  for (int sweep = 1; sweep <= kMostSweeps; ++sweep) {
    for (ReversalPoint& point : points) {
      const Vector3d missing = target_of(point, share) - velocity_of(trial, point);
      Vector3d next = point.impulse + inverse(point.K) * missing;
      if (norm(tangential(next, point.normal)) > point.mu * dot(next, point.normal)) {
        const double step = 1. / (point.K.xx + point.K.yy + point.K.zz);
        next = projected(point.impulse + step * missing, point.normal, point.mu);
      }
      const Vector3d change = next - point.impulse;
      point.impulse = next;
      trial.velocity += (1. / mass) * change;
      trial.angular_velocity += inverse_inertia * cross(point.arm, change);
    }
    double worst = 0.;
    for (const ReversalPoint& point : points) {
      worst = std::max(worst, norm(target_of(point, share) - velocity_of(trial, point)));
    }
    if (worst <= tolerance) {
      twist = trial;
      return true;
    }
    if (sweep % kPatience == 0) {
      if (worst > 0.9 * before) return false;
      before = worst;
    }
  }
  return false;
}

}  // namespace

bool reverse_together(std::span<ReversalPoint> points, double mass,
                      const Symmetric3d& inverse_inertia, double tolerance, Twist& twist) {
  const auto reverse = [&](double share, Twist& result) {
    result = twist;
    return reverse_share(points, mass, inverse_inertia, tolerance, share, result);
  };
  Twist found;
  double low = 0., high = 1.;
  if (reverse(high, found)) {
    low = high;
  } else if (!reverse(low, found)) {
    return false;
  } else {
    Twist trial;
    for (int halving = 0; halving < 4; ++halving) {
      const double share = 0.5 * (low + high);
      (reverse(share, trial) ? low : high) = share;
    }
    reverse(low, found);
  }
  twist = found;
  return true;
}

}  // namespace hookpoint::contact
