#include "simulation/dts_engine.h"

#include <fmt/format.h>

#include <algorithm>

#include "contact/force_law.h"
#include "simulation/dts_robot.h"
#include "simulation/ground.h"
#include "simulation/impulse_engine.h"
#include "simulation/stability.h"

namespace hookpoint::simulation {
namespace {

class DtsEngine final : public Engine {
 public:
  explicit DtsEngine(const Experiment& experiment)
      : experiment_(experiment),
        inputs_(initial_inputs(experiment_)),
        ground_(make_ground(experiment_)) {
    if (!contact::find_force_law(experiment_.contact))
      throw ExperimentError("there is no contact law `" + experiment_.contact + "`");
    std::size_t bodies = 0, joints = 0;
    for (std::size_t i = 0; i < experiment_.robots.size(); ++i) {
      auto robot = std::make_unique<DtsRobot>(experiment_, static_cast<int>(i),
                                              ground_ ? &*ground_ : nullptr, inputs_);
      auto stepper = integrators::make_stepper(experiment_.integrator, *robot);
      if (!stepper)
        throw ExperimentError("there is no integrator `" + experiment_.integrator + "`");
      bodies += robot->model().body_count();
      joints += robot->model().link_count();
      parts_.push_back({std::move(robot), std::move(stepper), false});
    }
    state_.bodies.resize(bodies);
    state_.joints.resize(joints);
    publish();
  }

  StepStatus step() override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const StepStatus status =
          parts_[i].robot->step(*parts_[i].stepper, state_.time, experiment_.deltat);
      if (status.ok()) continue;
      for (std::size_t stepped = 0; stepped < i; ++stepped) parts_[stepped].robot->undo();
      return explained(status);
    }
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    publish();
    return {};
  }

  const WorldState& state() const override { return state_; }
  WorldInputs& inputs() override { return inputs_; }

 private:
  struct Part {
    std::unique_ptr<DtsRobot> robot;
    std::unique_ptr<integrators::Stepper> stepper;
    bool noticed = false;
  };

  /// A failure above the stability bound is the step's, and the bound is the advice.
  StepStatus explained(StepStatus status) const {
    const StabilityBound bound = stability_bound(experiment_);
    if (experiment_.deltat <= bound.step) return status;
    status.kind = StepStatus::Kind::step_too_large;
    status.advice = fmt::format(
        "deltat {:.4g} s is above the largest stable step {:.4g} s of {}: make the step smaller, "
        "the "
        "ground softer, or choose another integrator",
        experiment_.deltat, bound.step, experiment_.integrator);
    return status;
  }

  void publish() {
    std::size_t body = 0, joint = 0;
    for (Part& part : parts_) {
      if (!part.noticed && !part.robot->notice().empty()) {
        state_.notices.push_back(part.robot->notice());
        part.noticed = true;
      }
      const std::size_t links = part.robot->model().link_count();
      part.robot->publish(std::span(state_.bodies).subspan(body, 1 + links),
                          std::span(state_.joints).subspan(joint, links));
      body += 1 + links;
      joint += links;
    }
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  const std::optional<contact::Terrain> ground_;
  std::vector<Part> parts_;
  WorldState state_;
};

}  // namespace

std::unique_ptr<Engine> make_dts(const Experiment& experiment) {
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  if (law && law->is_impulse_law) return make_impulse_engine(experiment);
  return std::make_unique<DtsEngine>(experiment);
}

EngineDescription describe_dts() { return {"dts", HOOKPOINT_VERSION, "double", true, {}}; }

}  // namespace hookpoint::simulation
