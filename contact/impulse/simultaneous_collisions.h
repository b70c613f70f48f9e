// Collisions of one instant that act on each other, together: the generalised reflection of Smith et
// al. 2012 with Coulomb's friction along the way (docs/contact_impulse.md, docs/decisions/0045).
//
//     compression   normal impulses p_n >= 0 that leave no point approaching: at each place of the way
//                   those that would do so without friction (Moreau's projection of the velocity), with
//                   the friction that opposes the present slip. The way is unique and ends.
//     restitution   in the ratio of e_i p_in (Poisson), until the normal work of all points is
//                   (1 - e_i^2) of that of their compressions (Stronge)
//     separation    as compression, to the rebound speeds u0 of the points that were hit
//
// Of one point this is the path of collision.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/impulse/friction_discs.h"
#include "contact/impulse/nonnegative_minimum.h"
#include "math/matrix3.h"

namespace hookpoint::contact {

/// A point that takes part. World axes, SI.
struct CollidingPoint {
  Vector3d u;                 ///< velocity of the robot's point relative to the ground before [m/s]
  Vector3d normal;            ///< unit, out of the ground
  double mu = 0.;             ///< Coulomb's coefficient of friction, >= 0
  double restitution = 0.;    ///< e, 0 <= e <= 1
  double rebound_speed = 0.;  ///< u0 [m/s]
  Vector3d impulse;           ///< result: p on the robot [N s]
};

class SimultaneousCollisions {
 public:
  /// For at most `most` points. Allocates; `resolve` does not.
  explicit SimultaneousCollisions(std::size_t most);

  std::size_t most() const { return most_; }
  /// Whether friction came to 1e-6 of the speeds in the last `resolve`.
  bool converged() const { return converged_; }

  /// The impulses of `points`. `coupling(i, j)`: K_ij [1/kg], the velocity change of point i for a unit
  /// impulse at point j, K_ji its transpose; called once for each pair i <= j. Result: whether there are
  /// any that leave no point approaching. Each in its cone; the kinetic energy does not grow except
  /// by what lifts points to u0. All operations are symmetric in the points and the axes of their planes:
  /// these matter by rounding alone, except where it decides whether a last part is taken at once. To 1e-10
  /// of the speeds where slips keep their directions, else to some 1e-3. Cost: O(n^3) a part.
  template <class Coupling>
  bool resolve(std::span<CollidingPoint> points, const Coupling& coupling) {
    begin(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i; j < points.size(); ++j) set(i, j, coupling(i, j));
    return run(points);
  }

 private:
  /// Velocities and what has been given, in contact axes; `work` of the normal impulses, point by
  /// point.
  struct Motion {
    std::vector<double> un, ut, pn, pt, work;
    double energy = 0.;  ///< gained [J]
  };

  void begin(std::span<const CollidingPoint> points);
  void set(std::size_t i, std::size_t j, const Matrix3d& K);
  bool run(std::span<CollidingPoint> points);
  bool follow(std::span<const double> target, bool lifts);
  bool reach(std::span<const double> target, bool lifts, int parts);
  void aim(std::span<const double> target);
  bool balance(std::span<const double> target);
  bool improve(std::span<const double> target);
  bool find_gain(bool widens);
  void halve(std::span<const double> target);
  void restitute(std::span<const CollidingPoint> points);
  void strike(std::span<const double> normal, int parts, Motion& to);
  int parts_for(std::span<const double> normal);
  bool is_straight(const Motion& from, const Motion& one, const Motion& two) const;
  double missing(std::span<const double> target) const;
  bool is_below(std::span<const double> target) const;
  bool is_wedged() const;

  std::span<const double> nn() const { return K_; }
  std::span<const double> tt() const { return std::span(K_).subspan(n_ * stride_ + n_); }
  double nt(std::size_t i, std::size_t j) const { return K_[i * stride_ + n_ + j]; }

  std::size_t most_, n_ = 0, stride_ = 0;  ///< of the present set: points, and rows of K
  NonnegativeMinimum normals_;
  FrictionDiscs discs_;
  std::vector<Vector3d> axes_;  ///< of a point: normal, two tangents
  std::vector<double> K_;       ///< normals first, then tangents, two a point
  std::vector<double> mu_;
  Motion now_, trial_, finer_, start_, coarser_;
  bool frictionless_ = false;  ///< what lifts a wedged point acts along the normals alone
  bool restores_ = false;      ///< there is restitution, for which the work of a path matters
  bool converged_ = true;
  bool at_once_ = true;  ///< the last `reach` ended in its last part
  double speed_ = 0.;    ///< of the set [m/s]
  std::vector<double> ray_, bias_, best_, slip_, radius_, friction_, target_;
  // Of Newton's method.
  std::vector<double> gain_, widening_, system_, change_;
  std::vector<std::size_t> active_, pivot_;
};

}  // namespace hookpoint::contact
