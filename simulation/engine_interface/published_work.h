// Work of ground, joints and external forces on a robot over a step, from what an engine publishes.
// With F held over the step of h, or its mean, W = h F . (v_k + v_k+1)/2, at which a step
// M (v_k+1 - v_k) = h F keeps its books exactly; of a force that is a function of the state,
// W = h (F_k . v_k + F_k+1 . v_k+1)/2.
#pragma once

#include <vector>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// [J]
struct WorkParts {
  double ground = 0., joints = 0., forces = 0.;
  double sum() const { return ground + joints + forces; }
};

class PublishedWork {
 public:
  /// Of robot `index`. The experiment outlives it.
  PublishedWork(const Experiment& experiment, std::size_t index);

  /// The next step starts at this state, which needs Engine::publish_ground_forces; `inputs` are held
  /// over it, null where nobody knows them. O(bodies + joints + ground forces).
  void begin(const WorldState& state, const WorldInputs* inputs);
  /// Of the step that has led from there to `state`.
  WorkParts over_step(const WorldState& state) const;

 private:
  double power_of_ground(const WorldState& state) const;
  double of_ground(const WorldState& state, double h) const;
  double of_joints(const WorldState& state, double h) const;
  double of_forces(const WorldState& state, double h) const;
  bool is_own(const GroundForce& force) const {
    return force.body >= first_body_ && force.body < first_body_ + body_count_;
  }

  const Experiment& experiment_;
  const std::size_t index_;
  std::size_t first_body_ = 0, body_count_ = 0;    ///< in WorldState::bodies
  std::size_t first_joint_ = 0, joint_count_ = 0;  ///< in WorldState::joints
  // At the step's start.
  double time_ = 0., power_ = 0.;   ///< power of the ground [W]
  std::vector<BodyState> bodies_;   ///< all that are published
  std::vector<JointState> joints_;  ///< likewise
  std::vector<ForceInput> forces_;  ///< those that are held, or none
  PullInput pull_;
};

}  // namespace hookpoint::simulation
