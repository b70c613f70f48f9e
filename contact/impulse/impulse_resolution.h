// The collisions of one instant, for a single body and an articulated robot alike: all points that
// touch and approach are hit together, until none approaches the ground (docs/contact_impulse.md).
// The robot is known only by what it answers about its boundary points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/impulse/extreme_points.h"
#include "contact/impulse/impulse.h"
#include "contact/impulse/impulse_reversal.h"
#include "contact/impulse/simultaneous_collisions.h"
#include "contact/terrain/ground_query.h"

namespace hookpoint::contact {

struct ImpulseOptions {
  double tolerance =
      1e-12;  ///< |gap| at which a point touches [m]; lower reaches rounding, higher hides u0
  double largest_turn =
      0.02;  ///< of one flight's orientation step [rad]; higher is faster and less exact
  double largest_travel =
      0.05;  ///< of the centre of mass in one flight step [m]: below the width of a ridge
  int most_impacts = 20000;  ///< in one call; more is `too_many_impacts`
  /// Places of boundary points and bodies worked out in one call; more is `too_many_impacts`. What
  /// bounds a robot with many of them: some seconds.
  double most_work = 2e7;
};

/// Points of the same bodies that are hit together at most; more are hit one after another.
inline constexpr std::size_t most_hit_together = 64;

enum class AdvanceStatus {
  ok,
  not_finite,
  inside_ground,
  inside_body,
  came_inside,  ///< later than at the start
  too_many_impacts,
  unsolved_collision
};
/// Why the order in which a robot lists its points may be seen in a result.
enum class OrderCause {
  none,
  microcollisions,   ///< points of a resting body that approach equally fast: one after another
  different_bodies,  ///< points of bodies that act on each other and land equally fast: face by face
  many_corners,      ///< more corners of a face than `most_hit_together`: one after another
  unsolved           ///< points of a face that have no common impulse: one after another
};

/// What to change, one sentence.
const char* advice(AdvanceStatus status);

/// What the collisions of a step came to.
struct ImpulseTally {
  AdvanceStatus status = AdvanceStatus::ok;
  std::int64_t impacts = 0;    ///< collisions resolved
  std::int64_t lift_offs = 0;  ///< times that a point which had been hit left the ground
  int contacts = 0;            ///< boundary points that were hit at least once
  double deepest = 0.;  ///< greatest -gap of a boundary point at an impact or at the end, >= 0 [m]
  double work = 0.;     ///< places of boundary points and bodies worked out
  OrderCause order_matters = OrderCause::none;  ///< the first there was
};

/// Whether the step has cost all that it may.
inline bool is_over(const ImpulseTally& tally, const ImpulseOptions& options) {
  return tally.impacts > options.most_impacts || tally.work > options.most_work;
}

/// A robot at the instant of its collisions: its configuration does not change, its velocities
/// change by `strike`. Boundary points are numbered; world axes, SI.
class StruckRobot {
 public:
  virtual ~StruckRobot() = default;
  virtual std::size_t point_count() const = 0;
  virtual std::size_t body_count() const { return 1; }
  virtual const GroundPoint& ground(std::size_t point) const = 0;
  /// u [m/s], now.
  virtual Vector3d velocity(std::size_t point) const = 0;
  /// Speed [m/s] up to which an approach is the rounding of none.
  virtual double rounding() const { return 0.; }
  /// K, du = K dp [1/kg], symmetric positive definite.
  virtual Symmetric3d collision_matrix(std::size_t point) = 0;
  /// K_ij [1/kg]: the velocity change of point i for a unit impulse at point j.
  virtual Matrix3d coupling(std::size_t i, std::size_t j) = 0;
  /// Whether two points lie on the same bodies, and so move as one rigid body does.
  virtual bool same_bodies(std::size_t i, std::size_t j) const = 0;
  /// Of the point, from an origin that points of the same bodies share [m].
  virtual Vector3d place(std::size_t point) const = 0;
  /// Takes the impulse p [N s] at the point.
  virtual void strike(std::size_t point, const Vector3d& impulse) = 0;

  /// Readies `flight_acceleration` for the present velocities; a_n, the acceleration [m/s^2] with
  /// which the robot would fall back on the ground under `struck` if it flew.
  virtual double begin_reversal(std::size_t struck) = 0;
  /// a of the point in flight [m/s^2].
  virtual Vector3d flight_acceleration(std::size_t point) const = 0;
  /// reverse_together of impulse_reversal.h for `points`, whose numbers are `index`: the impulses,
  /// if there are any; nothing is struck.
  virtual bool find_reversal(std::span<ReversalPoint> points, std::span<const std::size_t> index,
                             double tolerance) = 0;
};

class ImpulseResolution {
 public:
  /// Allocates; nothing else does.
  ImpulseResolution(std::size_t point_count, ImpulseLaw law, const ImpulseOptions& options);

  /// A step begins: no point has been hit.
  void begin_step();
  /// Resolves impacts at one instant until none approaches. Landings: all points of a face that approach
  /// together, of bodies that act on each other the face of the fastest point first. Microcollisions
  /// (microcollision_limit): one after another, the fastest first (of equals the first point). Adds to
  /// `tally`; its status is the caller's.
  AdvanceStatus resolve(StruckRobot& robot, ImpulseTally& tally);
  /// Whether the point has been hit since `begin_step`.
  bool hit(std::size_t point) const { return hit_[point] != 0; }
  /// How many have.
  int contacts() const;

 private:
  double approach(const StruckRobot& robot, std::size_t point) const;
  void find_approaching(const StruckRobot& robot);
  void keep_corners(const StruckRobot& robot);
  AdvanceStatus hit_faces(StruckRobot& robot, ImpulseTally& tally);
  bool hit_together(StruckRobot& robot, std::span<const std::size_t> group, ImpulseTally& tally);
  void look_for_ties(StruckRobot& robot, std::size_t fastest, ImpulseTally& tally) const;
  std::size_t fastest_of(const StruckRobot& robot, std::span<const std::size_t> group) const;
  AdvanceStatus hit_alone(StruckRobot& robot, std::size_t point, ImpulseTally& tally);
  std::span<std::size_t> take_group(StruckRobot& robot);
  std::size_t fastest_face(const StruckRobot& robot, std::span<std::size_t> group,
                           ImpulseTally& tally) const;
  bool reverse(StruckRobot& robot, std::size_t hit, ImpulseTally& tally);
  void strike(StruckRobot& robot, std::size_t point, const Vector3d& impulse, ImpulseTally& tally);

  ImpulseLaw law_;
  ImpulseOptions options_;
  // Those that a microcollision reverses together, and their numbers.
  std::vector<ReversalPoint> near_;
  std::vector<std::size_t> near_index_;
  std::vector<char> hit_now_, hit_;
  // Points that approach; those of a face, and its corners.
  std::vector<std::size_t> approaching_;
  std::vector<PlanePoint> face_, corners_;
  std::vector<char> taken_;
  SimultaneousCollisions together_;
  std::vector<CollidingPoint> colliding_;
  double least_approach_ = 0.;  ///< of the present instant: less is rounding of none [m/s]
};

}  // namespace hookpoint::contact
