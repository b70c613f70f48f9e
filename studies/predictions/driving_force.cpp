#include "studies/predictions/driving_force.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "simulation/dts_engine/dts_engine.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;
using simulation::WorldState;

/// An engine in whose world time passes and nothing moves.
class StandingStill final : public simulation::Engine {
 public:
  explicit StandingStill(const Experiment& experiment)
      : start_(simulation::make_dts(experiment)), deltat_(experiment.deltat) {
    state_ = start_->state();
    inputs_ = simulation::initial_inputs(experiment);
  }
  simulation::StepStatus step() override {
    state_.time = static_cast<double>(++state_.step) * deltat_;
    return {};
  }
  const WorldState& state() const override { return state_; }
  simulation::WorldInputs& inputs() override { return inputs_; }
  void publish_details() override {
    start_->publish_details();
    state_.points = start_->state().points;
    state_.chains = start_->state().chains;
  }

 private:
  std::unique_ptr<simulation::Engine> start_;
  double deltat_;
  WorldState state_;
  simulation::WorldInputs inputs_;
};

/// What a port that decides a force depends on; "" where on signals and constants alone.
class Origins {
 public:
  explicit Origins(const Experiment& experiment) : experiment_(experiment) {}

  /// The first port of something that moves which leads to `prefix`..., a port or an object.
  std::string moving(const std::string& prefix) {
    for (const simulation::WireSpec& wire : experiment_.wires) {
      if (!wire.to.starts_with(prefix)) continue;
      if (std::string found = moving_source(wire.from); !found.empty()) return found;
    }
    return "";
  }

 private:
  std::string moving_source(const std::string& port) {
    if (!seen_.insert(port).second) return "";
    for (const simulation::ComponentSpec& component : experiment_.components) {
      if (!port.starts_with(component.trail + ".")) continue;
      if (!component.attached.empty()) return component.attached;
      return moving(component.trail + ".");
    }
    const bool held = experiment_.values &&
                      std::ranges::any_of(*experiment_.values,
                                          [&](const auto& value) { return value.trail == port; });
    if (held) return moving(port);
    return port;
  }

  const Experiment& experiment_;
  std::set<std::string> seen_;
};

}  // namespace

std::string why_forces_depend_on_motion(const Experiment& experiment) {
  for (const simulation::ForceSpec& force : experiment.forces) {
    const std::string trail = experiment.world + "." + force.name + ".";
    if (const std::string port = Origins(experiment).moving(trail); !port.empty())
      return "the Force " + force.name + " depends on " + port;
  }
  return "";
}

DrivingForce::DrivingForce(const RunContext& context)
    : context_(context),
      world_(*context.experiment, std::make_unique<StandingStill>(*context.experiment)),
      steps_(std::llround(context.duration / context.experiment->deltat)) {}

Vector3d DrivingForce::force() const {
  Vector3d sum = context_.robot_spec().base.mass.mass * context_.experiment->gravity;
  for (const simulation::ForceInput& input : world_.inputs().forces) sum += input.force;
  return sum;
}

Vector3d DrivingForce::moment() const {
  const simulation::RobotSpec& robot = context_.robot_spec();
  Vector3d sum;
  for (const simulation::ForceInput& input : world_.inputs().forces)
    sum +=
        input.torque +
        cross(rotate(robot.orientation, input.point - robot.base.mass.center_of_mass), input.force);
  return sum;
}

bool DrivingForce::advance() {
  return step() < steps_ && world_.step().ok() && world_.ended().empty();
}

}  // namespace hookpoint::studies
