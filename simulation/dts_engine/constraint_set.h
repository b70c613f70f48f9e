// The constraints of a robot on top of the recursion for its tree: loops, places of two of its bodies
// that stay together, and coupled joints, of which one follows another. The constraint forces lambda
// come from the tree's response to forces at these places and joints,
//     (J M^-1 J^T) lambda = -(J v'_open + J' v),
// a small dense system; O(N) for each row and the cube of the rows (Featherstone 2008, chapter 8;
// docs/loops.md).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dts/impulse_response.h"
#include "dts/spatial.h"
#include "math/pivoted_cholesky.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/loop_places.h"

namespace hookpoint::simulation {

/// A compliant loop: a spring and a damper between a place of body a and one of body b.
struct LoopSpring {
  std::array<dts::BodyPoint<double>, 2> places;
  Vector3d force;                       ///< of the spring on a, world axes [N]
  double stiffness = 0., damping = 0.;  ///< [N/m, N s/m]
};

class ConstraintSet {
 public:
  /// Those of robot `index`. Allocates; nothing else does.
  ConstraintSet(const Experiment& experiment, std::size_t index, const dts::Model<double>& model);

  /// Whether there is a loop that is closed exactly, or a coupled joint.
  bool constrains() const { return row_count() > 0; }

  /// Whether the acceleration of a limb depends on what others do, through a loop, compliant or exact,
  /// or a coupled joint.
  bool joins_limbs() const { return !loops_.empty() || constrains(); }

  /// The compliant loops at the kinematics in the workspace. Allocates.
  std::vector<LoopSpring> springs(const dts::Workspace<double>& workspace) const;
  /// Adds what springs and dampers of compliant loops exert. After forward_kinematics.
  void add_spring_forces(dts::Workspace<double>& workspace) const;
  /// What constraint forces are for: that accelerations keep the constraints met at this moment,
  /// J v' = -J' v; or that a step which begins with J v = 0 ends with them met but for its third
  /// order, J v' = -J' v/2: the path of constant acceleration, which half of it bends as much as the
  /// constraints do (SHAKE: Ryckaert, Ciccotti & Berendsen 1977, J. Comput. Phys. 23).
  enum class Closing { at_this_moment, over_a_step };
  /// Finds the constraint forces. After forward_dynamics of the open tree, whose accelerations are in
  /// the workspace; over a step, after those of this moment at the same positions, whose factors of
  /// J M^-1 J^T it takes.
  void find_forces(const dts::Model<double>& model, const dts::State<double>& state,
                   dts::Workspace<double>& workspace, Closing closing);
  /// Adds the constraint forces that were found last: those of loops on the bodies, those of coupled
  /// joints to `torques`, one a joint [N m, N].
  void add_forces(dts::Workspace<double>& workspace, std::span<double> torques) const;

  /// Moves the state to the nearest one (in the metric of the kinetic energy) that meets the
  /// constraints, and its velocities to those that keep them met; the workspace has the kinematics of
  /// there. Result: the greatest gap that is left [m, of coupled joints rad or m]. At most `rounds` of
  /// Newton's method.
  double close(const dts::Model<double>& model, dts::State<double>& state,
               dts::Workspace<double>& workspace, int rounds);

  /// Changes the velocities to the nearest ones that keep the constraints met, and the kinematics
  /// with them. After `close` or `find_forces` at the same positions.
  void project_velocities(const dts::Model<double>& model, dts::State<double>& state,
                          dts::Workspace<double>& workspace);

  /// What to tell the user of a singular linkage that the robot has come to; "" if none.
  const std::string& notice() const { return notice_; }
  void forget_notice() { notice_.clear(); }

  /// Rank of the constraints at the state that was factored last, and their number.
  std::size_t rank() const { return rank_; }
  std::size_t row_count() const { return 3 * points_.size() + couplings_.size(); }

  /// Of each loop, at the kinematics in the workspace.
  void publish(const dts::Workspace<double>& workspace, std::span<LoopState> loops) const;

  /// Indices of the loops among the experiment's.
  std::span<const std::size_t> loops() const { return loops_; }

 private:
  /// A place of body a that is one of body b; of a hinge there are two, along its axis.
  struct Point {
    std::size_t loop = 0;  ///< index into loops_
    std::array<std::size_t, 2> bodies{};
    LoopPlace p;
    Vector3d force;  ///< on a, world axes [N]
  };

  /// A joint that follows another: q_f = ratio q_l + offset.
  struct Coupling {
    CouplingSpec spec;
    double torque = 0.;          ///< on the follower; on the leader -ratio times that [N m, N]
    std::vector<double> column;  ///< M^-1 J^T, one a generalised velocity

    /// J x: of the joints' positions without the offset, of rates, of accelerations.
    double apart(std::span<const double> joints) const {
      return joints[spec.follower] - spec.ratio * joints[spec.leader];
    }
  };

  /// The place where a loop that is no hinge joins its bodies.
  static Point place_of(const LoopSpec& loop);
  dts::BodyPoint<double> at(const Point& point, std::size_t side,
                            const dts::Workspace<double>& workspace) const;
  Vector3d gap(const Point& point, const dts::Workspace<double>& workspace) const;
  Vector3d gap_rate(const Point& point, const dts::Workspace<double>& workspace) const;
  /// b_ := a vector a point and a number a coupling; the greatest of them.
  template <class OfPoint, class OfCoupling>
  double fill(const OfPoint& of_point, const OfCoupling& of_coupling);
  /// J v' + J' v of the accelerations in the workspace.
  void fill_accelerations_apart(const dts::Model<double>& model, const dts::State<double>& state,
                                const dts::Workspace<double>& workspace, std::span<double> apart);
  /// J' v.
  void fill_bias_apart(const dts::Model<double>& model, const dts::State<double>& state,
                       dts::Workspace<double>& workspace, std::span<double> apart);
  void factor(const dts::Model<double>& model, dts::Workspace<double>& workspace);
  /// The rows of coupled joints in J M^-1 J^T.
  void fill_coupling_rows(const dts::Model<double>& model, dts::Workspace<double>& workspace);
  /// Whether the constraints are those of the start, not fewer.
  void watch_rank();
  /// change_ := -M^-1 J^T times the solution for `b_`.
  void find_change(const dts::Model<double>& model, dts::Workspace<double>& workspace);

  const Experiment& experiment_;
  std::vector<std::size_t> loops_;
  std::vector<Point> points_;
  std::vector<Coupling> couplings_;
  /// J M^-1 J^T [1/kg]: of each point three rows, then of each coupled joint one.
  PivotedCholesky response_;
  std::size_t rank_ = 0;
  /// Of the start: rank, and the least pivot as a share of the largest.
  std::optional<std::pair<std::size_t, double>> regular_;
  std::string singular_, notice_;
  std::vector<double> b_, x_;
  std::vector<double> change_, part_;  ///< of the generalised velocity
  std::vector<dts::Motion<double>> accelerations_;
  dts::Motion<double> still_base_;    ///< no acceleration
  std::vector<double> still_joints_;  ///< none either
  dts::State<double> moved_;
};

}  // namespace hookpoint::simulation
