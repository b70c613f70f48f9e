#include "simulation/wiring/energy_balance.h"

#include "simulation/engine_interface/held_force.h"
#include "simulation/engine_interface/robot_sums.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

EnergyBalance::EnergyBalance(const Experiment& experiment, Engine& engine)
    : experiment_(experiment),
      engine_(engine),
      first_bodies_{0},
      first_joints_{0},
      explained_(experiment.robots.size()),
      driven_(experiment.robots.size()) {
  for (const RobotSpec& robot : experiment.robots) {
    first_bodies_.push_back(first_bodies_.back() + body_count(robot));
    first_joints_.push_back(first_joints_.back() + joint_count(robot));
  }
}

bool EnergyBalance::is_known() const {
  if (engine_.tells_works() || engine_.tells_ground_forces() == GroundForceTime::last_step)
    return true;
  // Forces of the published instants alone do not tell what an impact between them did. Bodies of
  // different robots touch in our engine only.
  return !experiment_.terrain && experiment_.obstacles.empty();
}

double EnergyBalance::energy(std::size_t i, const Vector3d& gravity) const {
  const WorldState& state = engine_.state();
  const RobotSums sums =
      robot_sums(experiment_.robots[i], gravity, std::span(state.bodies).subspan(first_bodies_[i]),
                 std::span(state.joints).subspan(first_joints_[i]));
  return sums.kinetic_energy + sums.potential_energy;
}

double EnergyBalance::numerical_energy(std::size_t i) const {
  return begun_ ? energy(i, gravity_) - explained_[i] : 0.;
}

void EnergyBalance::prepare() {
  wanted_ = true;
  if (engine_.tells_works()) return engine_.publish_works();
  engine_.publish_ground_forces();
  for (std::size_t i = published_.size(); i < experiment_.robots.size(); ++i)
    published_.emplace_back(experiment_, i).begin(engine_.state(), &engine_.inputs());
}

void EnergyBalance::start_from_here() {
  step_ = engine_.state().step;
  for (std::size_t i = 0; i < joint_positions_.size(); ++i)
    joint_positions_[i] = engine_.state().joints[i].angle;
}

void EnergyBalance::begin() {
  if (begun_) return;
  prepare();
  if (!drives_begun_) start_from_here();
  begun_ = true;
  gravity_ = engine_.inputs().gravity;
  for (std::size_t i = 0; i < explained_.size(); ++i) explained_[i] = energy(i, gravity_);
}

void EnergyBalance::begin_drives() {
  if (drives_begun_) return;
  drives_begun_ = true;
  driven_gravity_ = engine_.inputs().gravity;
  for (const RobotSpec& robot : experiment_.robots)
    for_each_link(robot, [&](const TreeLink& at) { joints_.push_back(joint_properties(at.link)); });
  joint_positions_.resize(joints_.size());
  forced_.resize(experiment_.forces.size());
  start_from_here();
}

void EnergyBalance::restored() {
  if (begun_)
    prepare();
  else if (wanted_)
    begin();
  start_from_here();
}

Pose EnergyBalance::pose(std::size_t body) const {
  const BodyState& state = engine_.state().bodies[body];
  return {state.position, state.orientation};
}

std::size_t EnergyBalance::body_of(const ForceSpec& force) const {
  return first_bodies_[static_cast<std::size_t>(force.robot)] +
         static_cast<std::size_t>(force.body);
}

// Weights gain or lose what the field that has changed gives them where they are.
void EnergyBalance::change_gravity(Vector3d& gravity, std::vector<double>& work) const {
  const Vector3d& now = engine_.inputs().gravity;
  if (now == gravity) return;
  for (std::size_t i = 0; i < work.size(); ++i) work[i] += energy(i, now) - energy(i, gravity);
  gravity = now;
}

void EnergyBalance::take_inputs() {
  const WorldInputs& inputs = engine_.inputs();
  if (begun_) change_gravity(gravity_, explained_);
  if (drives_begun_) change_gravity(driven_gravity_, driven_);
  for (std::size_t i = 0; i < forced_.size(); ++i)
    forced_[i] = pose(body_of(experiment_.forces[i]));
  if (inputs.pull.robot >= 0) pulled_ = pose(inputs.pull.index);
  for (PublishedWork& work : published_) work.begin(engine_.state(), &inputs);
}

void EnergyBalance::add_driven_work() {
  const WorldInputs& inputs = engine_.inputs();
  const WorldState& state = engine_.state();
  for (std::size_t i = 0; i < driven_.size(); ++i) {
    for (std::size_t joint = first_joints_[i]; joint < first_joints_[i + 1]; ++joint) {
      const double position = state.joints[joint].angle;
      driven_[i] += drive_torque(joints_[joint], inputs.joint_torques[joint]) *
                    (position - joint_positions_[joint]);
      joint_positions_[joint] = position;
    }
  }
  for (std::size_t i = 0; i < forced_.size(); ++i) {
    const ForceSpec& force = experiment_.forces[i];
    driven_[static_cast<std::size_t>(force.robot)] +=
        held_force_work(inputs.forces[i], forced_[i], pose(body_of(force)));
  }
  const PullInput& pull = inputs.pull;
  if (pull.robot >= 0)
    driven_[static_cast<std::size_t>(pull.robot)] +=
        held_force_work(pull.force, pulled_, pose(pull.index));
}

void EnergyBalance::take_step() {
  if (engine_.state().step != step_ + 1) return;
  step_ = engine_.state().step;
  if (drives_begun_) add_driven_work();
  if (!begun_) return;
  for (std::size_t i = 0; i < explained_.size(); ++i)
    explained_[i] += published_.empty() ? engine_.state().works[i]
                                        : published_[i].over_step(engine_.state()).sum();
}

}  // namespace hookpoint::simulation
