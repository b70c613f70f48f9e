// The boundary points of a robot under a force law: where they meet the ground, what the law makes
// of them, and what they remember from step to step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "contact/terrain/terrain.h"
#include "dts/workspace.h"
#include "integrators/stepper.h"
#include "simulation/engine.h"
#include "simulation/engine/contact_point.h"

namespace hookpoint::simulation {

/// At which state the law is evaluated: one that the run accepts, whose memories are to be kept and
/// whose forces are published, or a trial of the integrator's, which leaves no trace but its
/// forces.
enum class Evaluation { accepted, trial };

class ContactSet {
 public:
  /// Of robot `index`, with `bodies` bodies. `ground` may be null: no points. All that is referred
  /// to outlives the set.
  ContactSet(const Experiment& experiment, std::size_t index, std::size_t bodies,
             const contact::Terrain* ground, const integrators::StepperDescription& stepper);

  // Forces.

  /// f = law(x, x', h) of each boundary point at the kinematics in `workspace`, h the committed
  /// memory, added there as external forces. O(points), less what is culled.
  void apply_forces(dts::Workspace<double>& workspace, Evaluation evaluation);
  /// The forces of the last accepted evaluation once more, whose kinematics are still there.
  void apply_forces_again(dts::Workspace<double>& workspace) const;
  /// No law: no force, bristles at rest.
  void apply_nothing();

  // Memory: hooks and frames of balls.

  /// A step from the evaluated state begins: its memories are the committed ones from now on.
  /// `undo` takes that back.
  void commit();
  void undo();
  /// The same within a step, of all points, and not to be undone: an adaptive integrator's internal
  /// steps.
  void commit_within_step();
  /// From now on bodies whose points are all far above the ground may be culled. The first accepted
  /// evaluation has been of all of them, for those who ask for the initial state.
  void begin_culling();
  /// Whatever was culled is looked at anew: the robot has been put elsewhere.
  void forget_culling() { std::ranges::fill(culled_, 0); }

  // Bristles: the law's continuous states, integrated along with the velocities, of each point
  // `bristle_states` numbers.

  std::size_t bristle_count() const { return bristles_.size(); }
  /// At the present state; as the law lets an accepted state go on; their rates.
  std::span<const double> bristles() const { return bristles_; }
  std::span<const double> next_bristles() const { return next_bristles_; }
  std::span<const double> bristle_rates() const { return bristle_rates_; }
  void read_bristles(std::span<const double> numbers) {
    std::ranges::copy(numbers, bristles_.begin());
  }
  /// Whether number i of them changes before the motion begins anew: its point is within the law's
  /// reach.
  bool is_active_state(std::size_t i) const { return points_[i / bristle_states_].inside; }

  // The ground's impulse on each body over a step.

  void begin_impulses() { std::ranges::fill(ground_impulses_, Vector3d{}); }
  /// The forces evaluated last count for `weight` [s].
  void add_impulses(double weight);

  // Events of adaptive integrators, two a point: where it enters or leaves the law's reach, and,
  // while it is in the ground, where the law's switching value changes sign.

  std::size_t event_count() const { return 2 * points_.size(); }
  void event_values(const dts::Workspace<double>& workspace, std::span<double> values) const;
  /// `directions` as HybridSystem::cross_events has them.
  void cross_events(std::span<const int> directions);

  // What is published.

  bool empty() const { return points_.empty(); }
  /// Whether the integrator chooses its own steps.
  bool adaptive() const { return adaptive_; }
  const std::vector<ContactPoint>& points() const { return points_; }
  /// Mean force over the last step and number of carrying points of each body. `step` [s].
  void publish(double step, std::span<BodyState> bodies) const;
  /// Boundary point `point` of `body`, as the law left it.
  PointState point_state(std::size_t body, std::size_t point) const;
  /// Adds the forces at the boundary points; the robot's first body is `first_body`.
  void add_ground_forces(const dts::Workspace<double>& workspace, std::size_t first_body,
                         std::vector<GroundForce>& forces) const;
  /// Adds the boundary points that touch; the robot's first body is `first_body`.
  void add_contacts(std::size_t first_body, std::vector<ContactView>& contacts) const;
  /// What the springs of the contacts hold at the evaluated state [J].
  double stored_energy() const;
  /// That a boundary point has left the terrain, whose edge tile then goes on; else "".
  const std::string& notice() const { return notice_; }
  void forget_notice() { notice_.clear(); }

  /// `before` undoes a step that is not yet over; `pending` and what is published follow from
  /// `committed`.
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive.each("contact", self.points_, [](auto& point, auto& part) {
      part("hook", point.committed.hook);
      part("stretch", point.committed.stretch);
      part("attached", point.committed.attached);
      part("sliding", point.committed.sliding);
    });
    archive.each("ball", self.balls_, [&self](const auto& ball, auto& part) {
      part("orientation", self.points_[ball].committed_frame.orientation);
      part("normal", self.points_[ball].committed_frame.normal);
    });
    archive("bristle", self.bristles_);
  }

 private:
  /// The smallest box, along its body's axes, that holds the boundary points of a body.
  struct PointsBox {
    Vector3d center;  ///< body axes [m]
    Vector3d half;    ///< half its edges [m]
  };

  /// Tangential springs that are stretched at the start.
  void stretch(std::span<const Vector3d> start);
  template <class Law>
  void apply_force(const Law& law, std::size_t point, dts::Workspace<double>& workspace,
                   Evaluation evaluation);
  void leave_alone(std::size_t point, Evaluation evaluation);
  /// Whether no boundary point of the body is within the law's reach.
  bool is_culled(std::size_t body, const dts::Workspace<double>& workspace, Evaluation evaluation);
  /// The points of a body.
  std::span<const ContactPoint> points_of(std::size_t body) const;
  static PointsBox box_about(std::span<const ContactPoint> points);
  /// The numbers of a Bristle of a point, or their rates, in one of the vectors below.
  contact::Bristle<double> bristle_at(std::span<const double> numbers, std::size_t point) const;
  void put_bristle(const contact::Bristle<double>& bristle, std::size_t point,
                   std::span<double> numbers) const;

  const Experiment* experiment_;
  std::size_t index_;  ///< of the robot
  const contact::Terrain* ground_;
  bool adaptive_ = false;      ///< the integrator chooses its own steps
  bool new_velocity_ = false;  ///< its positions move with the new velocities
  contact::AnyForceLaw law_;
  std::size_t bristle_states_ = 0;  ///< numbers that the law integrates, of a point
  std::vector<ContactPoint> points_;
  std::vector<std::size_t> balls_;         ///< those with a radius
  std::vector<std::size_t> first_points_;  ///< of each body, into points_; one more at the end
  std::vector<double> bristles_, next_bristles_, bristle_rates_;
  /// Of each body: the ground's force at the state evaluated last [N], and its impulse over the
  /// last step [N s].
  std::vector<Vector3d> ground_forces_, ground_impulses_;
  std::vector<PointsBox> boxes_;  ///< of each body; infinite where it may not be culled
  std::vector<int> culled_;       ///< of each body: 0, or 1 and the commits since it is culled
  double reach_ = 0.;             ///< farthest above any ground where the law still acts [m]
  std::string notice_;
};

}  // namespace hookpoint::simulation
