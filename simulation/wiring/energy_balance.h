// Energy that comes and goes with time: the work of what drives the robots, and their numerical energy,
// the change of kinetic and gravitational energy less the work of all that acts
// (docs/integrators.md, "Numerical energy"). Our engine tells that work, over each step
// (Engine::publish_works); of others it follows from what they publish.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/engine_interface/published_work.h"
#include "simulation/experiment/joint_forces.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {

class EnergyBalance {
 public:
  /// Both outlive it.
  EnergyBalance(const Experiment& experiment, Engine& engine);

  /// Whether the engine tells what numerical energy takes: the work of its steps, or forces that are
  /// means over them; without contact nothing more than their motion.
  bool is_known() const;
  /// Numerical energy counts from the present state on, if nobody has begun it yet. Allocates.
  void begin();
  bool has_begun() const { return begun_; }
  /// The same of the work of drives.
  void begin_drives();

  /// Before each step, under the inputs of the step.
  void begin_step() {
    if (begun_ || drives_begun_) take_inputs();
  }
  /// After it. Both cost O(joints + forces) for drives, O(bodies + contacts) for numerical energy,
  /// nothing where nobody has begun.
  void end_step() {
    if (begun_ || drives_begun_) take_step();
  }

  /// Of robot i, since it began [J]. O(bodies).
  double numerical_energy(std::size_t i) const;
  /// Work on robot i since it began of drives of joints, Forces, pulls and changes of gravity [J]. A
  /// drive at its velocity_limit counts as if it held nothing back: an upper bound.
  double driven_work(std::size_t i) const { return driven_[i]; }

  /// An archive has been read, or the engine has become another one: numerical energy continues from
  /// the sums that were read, or begins again.
  void restored();
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive("energy_begun", self.begun_);
    archive("energy_gravity", self.gravity_);
    archive("energy_explained", self.explained_);
  }

 private:
  void take_inputs();
  void take_step();
  void change_gravity(Vector3d& gravity, std::vector<double>& work) const;
  void add_driven_work();
  void prepare();
  /// What is true of the present state when a step begins there.
  void start_from_here();
  /// Kinetic and gravitational energy of robot i under `gravity` [J].
  double energy(std::size_t i, const Vector3d& gravity) const;
  Pose pose(std::size_t body) const;
  /// In WorldState::bodies.
  std::size_t body_of(const ForceSpec& force) const;

  const Experiment& experiment_;
  Engine& engine_;
  std::vector<std::size_t> first_bodies_, first_joints_;  ///< of each robot; one more at the end
  std::vector<JointProperties> joints_;                   ///< of all robots
  bool wanted_ = false, drives_begun_ = false, begun_ = false;
  std::int64_t step_ = 0;  ///< up to which all is summed
  // Until it begins, zeros: a saved state does not depend on who watches.
  Vector3d gravity_;               ///< of the last step [m/s^2]
  std::vector<double> explained_;  ///< of each robot, T + V at first and the work since [J]
  // Of drives.
  Vector3d driven_gravity_;     ///< of the last step [m/s^2]
  std::vector<double> driven_;  ///< of each robot [J]
  // At the start of the present step.
  std::vector<double> joint_positions_;
  std::vector<Pose> forced_;  ///< bodies of the experiment's Forces
  Pose pulled_;
  std::vector<PublishedWork> published_;  ///< one a robot, of an engine that does not tell works
};

}  // namespace hookpoint::simulation
