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
#include "simulation/dts_engine/contact_culling.h"
#include "simulation/dts_engine/contact_point.h"
#include "simulation/dts_engine/evaluation.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

class ContactSet {
 public:
  /// Of robot `index`, with `bodies` bodies. `ground` may be null: no points. All that is referred
  /// to outlives the set.
  ContactSet(const Experiment& experiment, std::size_t index, std::size_t bodies,
             const contact::Terrain* ground, const integrators::StepperDescription& stepper);

  // Forces.

  /// f = law(x, x', h) of each boundary point at the kinematics in `workspace`, h the committed
  /// memory, added there as external forces. `dt` [s] is the step that the evaluation belongs to.
  /// O(points), less what is culled.
  void apply_forces(dts::Workspace<double>& workspace, Evaluation evaluation, double dt);
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
  /// evaluation has been of all of them, for those who request the initial state.
  void begin_culling();
  /// No body is culled until the next evaluation: the robot has been put elsewhere.
  void forget_culling() { culling_.forget(); }

  // Bristles: the law's continuous states, integrated along with the velocities, of each point
  // `bristle_states` numbers.

  std::size_t bristle_count() const { return bristles_.size(); }
  /// Bristles at the present state.
  std::span<const double> bristles() const { return bristles_; }
  /// Bristles that the motion continues with from an accepted state (Reaction::bristle).
  std::span<const double> next_bristles() const { return next_bristles_; }
  /// Rates of the bristles at the state evaluated last.
  std::span<const double> bristle_rates() const { return bristle_rates_; }
  void read_bristles(std::span<const double> numbers) {
    std::ranges::copy(numbers, bristles_.begin());
  }
  /// Whether number i of them can change before the next event: its point is within the law's
  /// reach.
  bool is_active_state(std::size_t i) const { return points_[i / bristle_states_].inside; }

  // The ground's impulse on each body over a step.

  void begin_impulses() { std::ranges::fill(ground_impulses_, Vector3d{}); }
  /// Impulse on each body since then [N s].
  std::span<const Vector3d> impulses() const { return ground_impulses_; }
  /// The forces evaluated last count for `weight` [s].
  void add_impulses(double weight);

  // Events of adaptive integrators, two a point: where it enters or leaves the law's reach, and,
  // while it is in the ground, where the law's switching value changes sign.

  std::size_t event_count() const { return 2 * points_.size(); }
  void event_values(const dts::Workspace<double>& workspace, std::span<double> values) const;
  /// `directions` as HybridSystem::cross_events has them.
  void cross_events(std::span<const int> directions);

  // The points, as the law left them at the last accepted state (publish_contacts.h).

  bool empty() const { return points_.empty(); }
  /// Whether the integrator chooses its own steps.
  bool adaptive() const { return adaptive_; }
  const std::vector<ContactPoint>& points() const { return points_; }
  /// Boundary points of a body.
  std::span<const ContactPoint> points_of(std::size_t body) const;
  /// Boundary points of a body that may touch the ground: none while the body is culled.
  std::span<const ContactPoint> near_points_of(std::size_t body) const {
    return culling_.is_culled(body) ? std::span<const ContactPoint>{} : points_of(body);
  }
  std::size_t body_count() const { return ground_forces_.size(); }
  /// Whether some material has constants that act beside the law.
  bool surfaces_act() const { return surfaces_act_; }
  /// The law of the points; null without a ground.
  const contact::LawDescription* law() const { return law_; }
  /// What the law reads of a point on ground of a material.
  const contact::MaterialConstants<double>& constants(const ContactPoint& point,
                                                      int ground_material) const {
    return materials_.of(point.foot_material, ground_material);
  }
  /// That a boundary point has left the terrain, whose edge tile then continues; else "".
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
  /// A boundary point at one state, as the law is to see it.
  struct Place {
    Place(const ContactPoint& point, const dts::BodyMotion<double>& body,
          const contact::Terrain& ground)
        : touching(contact_kinematics(point, body, ground)),
          frame(ball_frame(point, body, touching.tile)) {}

    ContactKinematics touching;
    contact::BallFrame frame;  ///< of a ball
    bool inside = false;       ///< on the ground's side of where the law begins
    double depth = 0.;         ///< on that side [m]
    bool reached = false;      ///< the law gives a force
  };

  /// Stretches the tangential springs of a robot that starts in balance.
  void stretch_springs();
  // Inlined into the loop over points: GCC's choice of products that it fuses into sums, and with
  // it last bits, depends on it (docs/performance.md).
  template <class Law>
  [[gnu::always_inline]] inline void apply_force(const Law& law, std::size_t point,
                                                 dts::Workspace<double>& workspace,
                                                 Evaluation evaluation, double dt);
  /// Where a point of a body that moves as `body` is. Changes nothing.
  template <class Law>
  [[gnu::always_inline]] inline Place place_of(const Law& law, const ContactPoint& point,
                                               const dts::BodyMotion<double>& body,
                                               Evaluation evaluation) const;
  /// The law at a place that it reaches, over a step `dt` [s]. Changes nothing.
  template <class Law>
  [[gnu::always_inline]] inline contact::Reaction<double> evaluate_point(const Law& law,
                                                                         std::size_t point,
                                                                         const Place& place,
                                                                         Evaluation evaluation,
                                                                         double dt) const;
  /// The same under friction that differs with direction, on a body that moves as `body`.
  template <class Law>
  contact::Reaction<double> evaluate_directed(const Law& law, std::size_t point, const Place& place,
                                              const dts::BodyMotion<double>& body,
                                              Evaluation evaluation, double dt) const;
  /// Adds what surfaces do beside the law to the force of a point's reaction and, as a moment, to its
  /// body; that moment [N m].
  Vector3d add_surface_forces(std::size_t point, const Place& place,
                              dts::Workspace<double>& workspace,
                              contact::Reaction<double>& reaction) const;
  /// What an accepted evaluation has made of a point.
  void store(std::size_t point, const Place& place);
  void store(std::size_t point, const contact::Reaction<double>& reaction);
  void leave_alone(std::size_t point, Evaluation evaluation);
  /// The numbers of a Bristle of a point, or their rates, in one of the vectors below.
  contact::Bristle<double> bristle_at(std::span<const double> numbers, std::size_t point) const;
  void put_bristle(const contact::Bristle<double>& bristle, std::size_t point,
                   std::span<double> numbers) const;

  const Experiment* experiment_;
  std::size_t index_;  ///< of the robot
  const contact::Terrain* ground_;
  bool adaptive_ = false;               ///< the integrator chooses its own steps
  bool new_velocity_ = false;           ///< its positions move with the new velocities
  const contact::LawDescription* law_;  ///< null without a ground
  ContactMaterials materials_;
  bool surfaces_act_ = false;       ///< some material has constants that act beside the law
  std::size_t bristle_states_ = 0;  ///< numbers that the law integrates, of a point
  std::vector<ContactPoint> points_;
  std::vector<std::size_t> balls_;         ///< those with a radius
  std::vector<std::size_t> first_points_;  ///< of each body, into points_; one more at the end
  std::vector<double> bristles_, next_bristles_, bristle_rates_;
  /// Of each body: the ground's force at the state evaluated last [N], and its impulse over the
  /// last step [N s].
  std::vector<Vector3d> ground_forces_, ground_impulses_;
  ContactCulling culling_;
  std::string notice_;
};

}  // namespace hookpoint::simulation
