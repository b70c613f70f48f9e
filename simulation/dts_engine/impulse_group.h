// Robots under an impulse law: flight under joint torques and external forces to the next impact of
// any of them, collisions through the recursion of forward dynamics, and so on until the step is used
// up (docs/contact_impulse.md). One robot over tiles, or all of an experiment's, which touch each other.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "dts/impulse_response.h"
#include "simulation/dts_engine/impulse_part.h"
#include "simulation/dts_engine/impulse_places.h"
#include "simulation/dts_engine/robot_flight.h"
#include "simulation/dts_engine/work_meter.h"

namespace hookpoint::simulation {

/// Tolerance of impacts of robots [m]: 500 times below the bounce of the default rebound speed, and
/// within reach of one correction of a flight.
inline constexpr double robot_tolerance = 1e-10;
/// Points that a microcollision reverses together at most; more are hit one by one.
inline constexpr std::size_t most_reversed_together = 32;

class ImpulseGroup final : public ImpulsePart, private contact::StruckRobot {
 public:
  /// Robots `robots` of the experiment. Allocates; `advance` does not.
  ImpulseGroup(const Experiment& experiment, RobotRange robots, contact::ImpulseLaw law,
               const contact::Terrain* ground, const WorldInputs& inputs,
               const contact::ImpulseOptions& options = {.tolerance = robot_tolerance});

  std::size_t body_count() const override { return impulses_.size(); }
  std::size_t joint_count() const override { return joint_count_; }
  contact::ImpulseTally advance(const contact::GroundQuery& ground) override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;
  void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                    std::vector<ContactView>& contacts) const override;
  std::span<const double> surface_works() const override { return surface_works_; }
  void measure_work() override;
  void publish_works(std::span<double> works) const override {
    std::ranges::transform(meters_, works.begin(), &WorkMeter::work);
  }

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

  const std::vector<ArticulatedRobot>& robots() const { return robots_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    for (auto& robot : self.robots_) ArticulatedRobot::exchange(robot, archive);
    archive("impulse", self.impulses_);
    archive("contacts", self.contacts_);
    archive("impacts", self.impacts_);
    if (!self.surface_works_.empty()) archive("surface_work", self.surface_works_);
  }

 private:
  /// Where the flight that is under way began.
  struct Start {
    double gap = 0., rate = 0.;
  };

  // contact::StruckRobot, whose points are the places
  std::size_t point_count() const override { return places_->places().size(); }
  const contact::GroundPoint& ground(std::size_t point) const override {
    return places_->places()[point].ground;
  }
  Vector3d velocity(std::size_t point) const override;
  double rounding() const override { return rounding_; }
  Symmetric3d collision_matrix(std::size_t point) override;
  Matrix3d coupling(std::size_t i, std::size_t j) override;
  bool same_bodies(std::size_t i, std::size_t j) const override;
  Vector3d place(std::size_t point) const override;
  void strike(std::size_t point, const Vector3d& impulse) override;
  double begin_reversal(std::size_t struck) override;
  Vector3d flight_acceleration(std::size_t point) const override;
  bool find_reversal(std::span<contact::ReversalPoint> points, std::span<const std::size_t> index,
                     double tolerance) override;

  void go_back() override;
  const std::string& failed_robot() const override;
  contact::AdvanceStatus run(const contact::GroundQuery& ground, contact::ImpulseTally& tally);
  void locate(const contact::GroundQuery& ground, double elapsed);
  double lowest_gap() const;
  double greatest_speed() const;
  double longest_flight(double left) const;
  double safe_time(double longest);
  double landing(double duration, double floor) const;
  integrators::Status begin_flight();
  integrators::Status fly(double duration);
  contact::AdvanceStatus fly_above(const contact::GroundQuery& ground, double elapsed,
                                   double longest, double* duration, contact::ImpulseTally& tally);
  contact::AdvanceStatus inside() const;
  dts::BodyPoint<double> body_point(const PlaceSide& side) const;
  /// Of its place on the body.
  Vector3d velocity_of(const PlaceSide& side) const;
  std::size_t body_number(const PlaceSide& side) const {
    return first_bodies_[side.robot] + side.body;
  }
  void ready_inertias(std::size_t robot);
  void keep_motion();
  /// Calls `visit(i, first_q, first_v)` for each robot.
  template <class Visit>
  void for_each_robot(const Visit& visit) const;

  contact::ImpulseOptions options_;
  const bool together_;  ///< they touch shapes, not tiles
  std::vector<ArticulatedRobot> robots_;
  std::vector<RobotFlight> flights_;
  std::vector<std::size_t> first_bodies_;
  std::size_t joint_count_ = 0;
  std::unique_ptr<ImpulsePlaces> places_;
  std::vector<Start> starts_;  ///< of each place; those that were not there have none
  std::size_t started_ = 0;    ///< places that were there
  contact::ImpulseResolution resolution_;
  double rounding_ = 0.;              ///< of a place's velocity, in the present collisions [m/s]
  std::vector<char> inertias_ready_;  ///< the workspace has those of the present configuration
  std::vector<double> change_;        ///< of the generalised velocity
  std::vector<double> q_before_, v_before_;  ///< the present step, to undo it
  /// Over the step, on each body [N s], and its places that were hit.
  std::vector<Vector3d> impulses_, impulses_before_;
  std::vector<int> contacts_, contacts_before_;
  std::vector<double> surface_works_, works_before_;  ///< of terrain and obstacles [J]
  std::vector<WorkMeter> meters_;                     ///< one a robot, once they are wanted
  // A reversal's: the couplings K_ij of its points, and their velocities.
  std::vector<Matrix3d> couplings_;
  std::vector<Vector3d> velocities_, work_;
};

}  // namespace hookpoint::simulation
