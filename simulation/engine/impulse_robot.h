// An articulated robot under an impulse law: flight under joint torques and external forces to the
// next impact, collisions through the recursion of forward dynamics, and so on until the step is
// used up (docs/contact_impulse.md).
#pragma once

#include <vector>

#include "dts/impulse_response.h"
#include "simulation/engine/contact_point.h"
#include "simulation/engine/impulse_part.h"
#include "simulation/engine/robot_flight.h"

namespace hookpoint::simulation {

/// Tolerance of an articulated robot's impacts [m]: 500 times below the bounce of the default
/// rebound speed, and within reach of one correction of a flight.
inline constexpr double robot_tolerance = 1e-10;
/// Points that a microcollision reverses together at most; more are hit one by one.
inline constexpr std::size_t most_reversed_together = 32;

class ImpulseRobot final : public ImpulsePart, private contact::StruckRobot {
 public:
  /// Robot `index` of the experiment, with chains and a fixed or mobile base. Allocates; `advance`
  /// does not.
  ImpulseRobot(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
               const contact::Terrain* ground, const WorldInputs& inputs,
               const contact::ImpulseOptions& options = {.tolerance = robot_tolerance});

  std::size_t body_count() const override { return robot_.model().body_count(); }
  std::size_t joint_count() const override { return robot_.model().link_count(); }
  contact::ImpulseTally advance(const contact::GroundQuery& ground) override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

  const ArticulatedRobot& robot() const { return robot_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    ArticulatedRobot::exchange(self.robot_, archive);
    archive("impulse", self.impulses_);
    archive("contacts", self.contacts_);
    archive("impacts", self.impacts_);
  }

 private:
  struct Point : BoundaryPoint {
    Vector3d center;                         ///< from the body's origin, world axes [m]
    Vector3d arm;                            ///< of the place that meets the ground, likewise
    contact::GroundPoint ground;             ///< under it
    double start_gap = 0., start_rate = 0.;  ///< where the present flight began
  };

  // contact::StruckRobot
  std::size_t point_count() const override { return points_.size(); }
  const contact::GroundPoint& ground(std::size_t point) const override {
    return points_[point].ground;
  }
  Vector3d velocity(std::size_t point) const override;
  double rounding() const override { return rounding_; }
  Symmetric3d collision_matrix(std::size_t point) override;
  void strike(std::size_t point, const Vector3d& impulse) override;
  double begin_reversal(std::size_t struck) override;
  Vector3d flight_acceleration(std::size_t point) const override;
  bool find_reversal(std::span<contact::ReversalPoint> points, std::span<const std::size_t> index,
                     double tolerance) override;

  static std::vector<Point> points_of(const RobotSpec& robot);
  void go_back() override;
  contact::AdvanceStatus run(const contact::GroundQuery& ground, contact::ImpulseTally& tally);
  void locate(const contact::GroundQuery& ground);
  double lowest_gap() const;
  double greatest_speed() const;
  double longest_flight(double left) const;
  double safe_time(double longest);
  double landing(double duration, double floor) const;
  contact::AdvanceStatus fly_above(const contact::GroundQuery& ground, double longest,
                                   double* duration, contact::ImpulseTally& tally);
  dts::BodyPoint<double> body_point(std::size_t point) const;
  void ready_inertias();

  contact::ImpulseOptions options_;
  ArticulatedRobot robot_;
  RobotFlight flight_;
  std::vector<Point> points_;
  contact::ImpulseResolution resolution_;
  double rounding_ = 0.;         ///< of a point's velocity, in the present collisions [m/s]
  bool inertias_ready_ = false;  ///< the workspace has those of the present configuration
  std::vector<double> change_;   ///< of the generalised velocity
  std::vector<double> q_before_, v_before_;  ///< the present step, to undo it
  /// Over the step, on each body [N s], and its boundary points that were hit.
  std::vector<Vector3d> impulses_, impulses_before_;
  std::vector<int> contacts_, contacts_before_;
  // A reversal's: the couplings K_ij of its points, and their velocities.
  std::vector<Matrix3d> couplings_;
  std::vector<Vector3d> velocities_, work_;
};

}  // namespace hookpoint::simulation
