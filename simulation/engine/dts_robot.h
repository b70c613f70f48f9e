// One robot of the DTS engine: its dynamics, its contact memory, and the second-order system that a
// stepper integrates.
#pragma once

#include <span>
#include <vector>

#include "contact/force_law.h"
#include "contact/terrain/rolling.h"
#include "contact/terrain/terrain.h"
#include "dts/joint_forces.h"
#include "dts/model.h"
#include "dts/state.h"
#include "dts/workspace.h"
#include "integrators/stepper.h"
#include "simulation/engine.h"

namespace hookpoint::simulation {

/// The part of a RobotSpec that the engine's recursions read.
dts::RobotDescription describe_robot(const RobotSpec& robot);
/// The robot's initial state. Joint positions add to theta (revolute) or d (prismatic).
dts::State<double> initial_state(const RobotSpec& robot);

/// A boundary point and what the law made of it at the state that was refreshed last.
struct ContactPoint {
  std::size_t body = 0;               ///< 0 the base, then links chain by chain
  Vector3d p_BP;                      ///< body axes [m]
  double radius = 0.;                 ///< of the ball about p_BP [m]
  contact::Memory<double> before;     ///< what `committed` was before the last step, to undo it
  contact::Memory<double> committed;  ///< of the accepted state before this one
  contact::Memory<double> pending;    ///< to be committed when the step from this state is taken
  /// Of a ball: how it stood when `before`, `committed` and `pending` were made.
  contact::BallFrame before_frame, committed_frame, pending_frame;
  Vector3d position;    ///< where it touches: p_WP less radius times the normal [m]
  Vector3d normal;      ///< of the tile under p_WP
  double depth = 0.;    ///< > 0 inside the ground [m]
  int material = 0;     ///< of the tile under it
  Vector3d force;       ///< on the robot, world axes [N]
  bool inside = false;  ///< the law reached it at the accepted state before this one

  /// The depth that the law gets from an adaptive integrator: a point stays on its side of the
  /// surface where the law begins, `reach` above the ground [m], until the event at which it
  /// crosses has been reached, so that no step meets a jump.
  double depth_on_side(double depth_now, double reach) const;
  /// Changes sign where the point leaves its side, just behind that surface: there it is on the
  /// other side, and the event is not met again at its own restart.
  double side_event(double depth_now, double reach) const;

  /// The step from the refreshed state is taken.
  void commit() {
    committed = pending;
    if (radius > 0.) committed_frame = pending_frame;
  }
  /// The committed memory as a ball that now stands in `now` has carried it along.
  contact::Memory<double> carried(const contact::BallFrame& now) const;
};

/// The smallest box, along its body's axes, that holds the boundary points of a body.
struct PointsBox {
  Vector3d center;  ///< body axes [m]
  Vector3d half;    ///< half its edges [m]
};

/// The boundary points of all bodies that can move.
std::vector<ContactPoint> boundary_points(const RobotSpec& robot);

/// Where a boundary point meets the ground: a ball at its centre less its radius along the normal
/// of the tile under the centre.
struct TouchingPlace {
  Vector3d position;        ///< [m]
  Vector3d velocity;        ///< of the body's material there [m/s]
  contact::TilePoint tile;  ///< with the depth of `position`
};
TouchingPlace touching_place(const ContactPoint& point, const dts::BodyMotion<double>& body,
                             const contact::Terrain& ground);
/// How the ball of a boundary point stands; a point needs none.
contact::BallFrame ball_frame(const ContactPoint& point, const dts::BodyMotion<double>& body,
                              const contact::TilePoint& tile);

/// Layout of positions: p_WB (3), R_WB as w x y z (4) of a mobile base, then joint positions; of
/// velocities: w_WB (3), v_WB (3), then joint rates (dts/configuration.h), then, of a law with
/// bristles, those of each boundary point: they are integrated like velocities and move no
/// position.
class DtsRobot final : public integrators::System {
 public:
  /// `ground` may be null: no contact. All that is referred to outlives the robot.
  DtsRobot(const Experiment& experiment, int index, const contact::Terrain* ground,
           const WorldInputs& inputs);

  /// Advances the robot by `dt` [s] from `time` [s]. On failure nothing has changed.
  StepStatus step(integrators::Stepper& stepper, double time, double dt);

  /// Takes the last successful step back.
  void undo();

  /// Kinematics and contact at the present state, with the committed memory: what a step starts
  /// from and what is published.
  void refresh();
  /// The present state is accepted: dry friction of the joints is hooked where they have dragged
  /// it. `keep_anchors` remembers where it was, `undo_anchors` takes it back there.
  void commit_anchors();
  void keep_anchors();
  void undo_anchors();
  /// Accelerations at the refreshed state, left in `workspace()`.
  void accelerate();
  /// Reads the positions of the present state.
  void write_positions(std::span<double> q) const;
  /// Goes to a state and refreshes it.
  void settle_at(std::span<const double> q, std::span<const double> v);
  /// Whether bodies' mean contact forces are worked out where they cost something: with an
  /// integrator that chooses its own steps.
  void publish_contact_forces(bool wanted) { has_means_ = wanted || !adaptive_; }
  /// Writes the published values of this robot's bodies and joints.
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const;
  /// Boundary point `point` of `body`, as the law left it.
  PointState point_state(int body, int point) const;
  /// Adds the ground's forces at the boundary points; the robot's first body is `first_body`.
  void add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const;
  /// What the springs of its contacts hold at the refreshed state [J].
  double ground_energy() const;
  /// What each chain does to the base, in the step just taken.
  void publish_hips(std::span<ChainState> chains) const;

  /// What evolves (resumable.h). `bodies`: this robot's published values, of whose quaternions the
  /// signs go on.
  std::size_t state_size() const;
  std::string state_layout() const;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies);

  const dts::Model<double>& model() const { return model_; }
  const dts::State<double>& state() const { return state_; }
  /// What the joints do by themselves, chain by chain.
  const std::vector<dts::JointProperties<double>>& joints() const { return joints_; }
  /// Where the dry friction of each is hooked.
  const std::vector<double>& anchors() const { return anchors_; }
  const std::vector<ContactPoint>& contact_points() const { return points_; }
  /// Which of the experiment's forces act on the robot.
  std::span<const std::size_t> forces() const { return forces_; }
  /// Whether a boundary point has left the terrain, whose edge tile then goes on, and what to tell
  /// the user.
  const std::string& notice() const { return notice_; }
  dts::Workspace<double>& workspace() { return workspace_; }
  const dts::Workspace<double>& workspace() const { return workspace_; }
  const Vector3d& gravity() const { return experiment_->gravity; }

  // integrators::System
  std::size_t position_size() const override;
  std::size_t velocity_size() const override;
  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override;
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override;
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override;
  void weigh(double weight) override;
  bool has_integrals() const override { return has_means_ && !points_.empty(); }
  void weigh_at(double weight, std::span<const double> q, std::span<const double> v) override;
  void commit(double time, double dt, std::span<const double> q,
              std::span<const double> v) override;
  void cross_events(std::span<const int> directions) override;
  void begin_anew(std::span<double> v) override;
  /// Events: each boundary point's depth and, while it is in the ground, its law's switching_value;
  /// each joint limit; where each joint with dry friction begins to slip, or its slip reverses.
  std::size_t event_count() const override;
  void event_values(double time, std::span<const double> q, std::span<const double> v,
                    std::span<double> values) override;
  integrators::Status split_accelerations(double time, std::span<const double> q,
                                          std::span<const double> v, std::span<double> a_free,
                                          std::span<double> a_contact) override;
  bool far(std::span<const double> u) const override;
  std::size_t moving_size() const override;
  /// Bristles of points within the law's reach do.
  bool evolves(std::size_t i) const override;
  std::size_t group_size() const override;

 private:
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive);
  void read_positions(std::span<const double> q);
  void read_state(std::span<const double> q, std::span<const double> v);
  /// Whether that is the present state, whose bristles are the law's own affair.
  bool is_at(std::span<const double> q, std::span<const double> v) const;
  void write_velocities(std::span<double> v, std::span<const double> bristles) const;
  /// The numbers of a Bristle of point `point`, or their rates, in one of the vectors below.
  contact::Bristle<double> bristle_at(std::span<const double> numbers, std::size_t point) const;
  void put_bristle(const contact::Bristle<double>& bristle, std::size_t point,
                   std::span<double> numbers) const;
  void evaluate_forces(bool trial);
  void apply_external_forces();
  void apply_contact_forces(bool trial);
  template <class Law>
  void apply_contact_force(const Law& law, std::size_t i, bool trial);
  void leave_alone(std::size_t point, bool trial);
  void bound_points();
  /// Whether no boundary point of the body is within the law's reach.
  bool passed_over(std::size_t body, bool trial);
  void commit_points();
  void publish_orientations(std::span<BodyState> bodies) const;
  void take_inputs();
  void set_joint_torques();

  const Experiment* experiment_;
  int index_;
  const contact::Terrain* ground_;
  const WorldInputs* inputs_;
  std::size_t first_joint_;  ///< where the robot's joints begin in WorldInputs::joint_torques
  std::span<const std::size_t> forces_;  ///< of the experiment's, those that act on this robot
  bool adaptive_ = false;                ///< the integrator chooses its own steps
  contact::AnyForceLaw law_;
  std::size_t bristle_states_ = 0;  ///< numbers that the law integrates, of a point
  bool semi_implicit_ = false;      ///< its positions move with the new velocities
  /// The step that is taken, what a law gets for one, and the step before it [s].
  double law_step_, law_step_before_;
  dts::Model<double> model_;
  dts::State<double> state_;
  dts::Workspace<double> workspace_;
  std::vector<ContactPoint> points_;
  /// bristle_states_ numbers a point: the law's continuous state, with which an accepted state goes
  /// on (as the law let go of some), and its rates at the state evaluated last.
  std::vector<double> bristles_, next_bristles_, bristle_rates_;
  std::vector<std::size_t> first_points_;  ///< of each body, into points_; one more at the end
  /// Of each body: the ground's force at the state evaluated last [N], and its impulse over the
  /// last step [N s].
  std::vector<Vector3d> ground_forces_, ground_impulses_;
  bool has_means_ = true;
  std::vector<PointsBox> boxes_;  ///< of each body; infinite where no body may be passed over
  std::vector<int> passed_;       ///< of each body: 0, or 1 and the commits since it is passed over
  double reach_ = 0.;             ///< farthest above any ground where the law still acts [m]
  std::string notice_;
  std::vector<dts::JointProperties<double>> joints_;
  /// A joint with dry friction, and whether it slipped when its anchor was committed.
  struct DryJoint {
    std::size_t joint = 0;
    bool slips = false;
  };
  std::vector<DryJoint> dry_joints_;
  /// Where the dry friction of each joint is hooked (dts/joint_forces.h), committed once a step;
  /// before: the present step, to undo it.
  std::vector<double> anchors_, anchors_before_;
  std::vector<double> joint_torques_;
  std::vector<double> q_, v_, a_, q_before_, v_before_;
};

}  // namespace hookpoint::simulation
