#include "contact/impulse/impulse_reversal.h"

#include <algorithm>
#include <limits>

namespace hookpoint::contact {
namespace {

constexpr int most_sweeps = 400;
constexpr int patience = 8;  // sweeps in which the missing velocity has to fall by a tenth

// The points' velocities while impulses are tried: those of a rigid body follow from its twist.
class RigidTrial {
 public:
  RigidTrial(std::span<const ReversalPoint> points, double mass, const Symmetric3d& inverse_inertia,
             const Twist& before)
      : points_(points), mass_(mass), inverse_inertia_(inverse_inertia), before_(before) {}

  void restart() { twist_ = before_; }
  Vector3d velocity(std::size_t k) const {
    return twist_.velocity + cross(twist_.angular_velocity, points_[k].arm);
  }
  void add(std::size_t k, const Vector3d& impulse) {
    twist_.velocity += (1. / mass_) * impulse;
    twist_.angular_velocity += inverse_inertia_ * cross(points_[k].arm, impulse);
  }

 private:
  std::span<const ReversalPoint> points_;
  double mass_;
  Symmetric3d inverse_inertia_;
  Twist before_, twist_;
};

// Those of any robot follow from the couplings.
class CoupledTrial {
 public:
  CoupledTrial(std::span<const Matrix3d> couplings, std::span<const Vector3d> before,
               std::span<Vector3d> velocities)
      : couplings_(couplings), before_(before), velocities_(velocities) {}

  void restart() { std::copy(before_.begin(), before_.end(), velocities_.begin()); }
  Vector3d velocity(std::size_t k) const { return velocities_[k]; }
  void add(std::size_t k, const Vector3d& impulse) {
    const std::size_t count = before_.size();
    for (std::size_t i = 0; i < count; ++i) velocities_[i] += couplings_[i * count + k] * impulse;
  }

 private:
  std::span<const Matrix3d> couplings_;
  std::span<const Vector3d> before_;
  std::span<Vector3d> velocities_;
};

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

// One block Gauss-Seidel sweep with projection on the cones.
template <class Trial>
void sweep(std::span<ReversalPoint> points, double share, Trial& trial) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    ReversalPoint& point = points[k];
    const Vector3d missing = target_of(point, share) - trial.velocity(k);
    Vector3d next = point.impulse + inverse(point.K) * missing;
    if (norm(tangential(next, point.normal)) > point.mu * dot(next, point.normal)) {
      const double step = 1. / (point.K.xx + point.K.yy + point.K.zz);
      next = projected(point.impulse + step * missing, point.normal, point.mu);
    }
    const Vector3d change = next - point.impulse;
    point.impulse = next;
    trial.add(k, change);
  }
}

template <class Trial>
bool reverse_share(std::span<ReversalPoint> points, double tolerance, double share, Trial& trial) {
  trial.restart();
  for (ReversalPoint& point : points) point.impulse = {};
  double before = std::numeric_limits<double>::infinity();
  for (int number = 1; number <= most_sweeps; ++number) {
    sweep(points, share, trial);
    double worst = 0.;
    for (std::size_t k = 0; k < points.size(); ++k) {
      worst = std::max(worst, norm(target_of(points[k], share) - trial.velocity(k)));
    }
    if (worst <= tolerance) return true;
    if (number % patience == 0) {
      if (worst > 0.9 * before) return false;
      before = worst;
    }
  }
  return false;
}

template <class Trial>
bool reverse_most(std::span<ReversalPoint> points, double tolerance, Trial trial) {
  const auto reverse = [&](double share) { return reverse_share(points, tolerance, share, trial); };
  if (reverse(1.)) return true;
  if (!reverse(0.)) return false;
  double low = 0., high = 1.;
  for (int halving = 0; halving < 4; ++halving) {
    const double share = 0.5 * (low + high);
    (reverse(share) ? low : high) = share;
  }
  return reverse(low);
}

}  // namespace

bool reverse_together(std::span<ReversalPoint> points, double mass,
                      const Symmetric3d& inverse_inertia, const Twist& twist, double tolerance) {
  return reverse_most(points, tolerance, RigidTrial(points, mass, inverse_inertia, twist));
}

bool reverse_together(std::span<ReversalPoint> points, std::span<const Matrix3d> couplings,
                      std::span<const Vector3d> before, std::span<Vector3d> work,
                      double tolerance) {
  return reverse_most(points, tolerance, CoupledTrial(couplings, before, work));
}

}  // namespace hookpoint::contact
