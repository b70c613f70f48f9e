#include "simulation/impulse_engine.h"

#include "contact/impulse_advance.h"
#include "simulation/ground.h"

namespace hookpoint::simulation {
namespace {

contact::ImpulseLaw impulse_law(const std::string& name) {
  return name == "impulse_reversal" ? contact::ImpulseLaw::impulse_reversal
                                    : contact::ImpulseLaw::impulse;
}

contact::ImpulseBody impulse_body(const BodySpec& body) {
  return {body.mass.mass, body.mass.center_of_mass, body.mass.inertia, body.boundary_points};
}

class ImpulseEngine final : public Engine {
 public:
  explicit ImpulseEngine(const Experiment& experiment)
      : experiment_(experiment),
        inputs_(initial_inputs(experiment_)),
        ground_(make_ground(experiment_)) {
    for (const RobotSpec& robot : experiment_.robots) {
      if (!robot.chains.empty()) {
        throw ExperimentError("the law `" + experiment_.contact + "` moves single bodies; robot `" +
                              robot.name + "` has chains: choose a force law such as `hookpoint`");
      }
      contact::ImpulseBody body = impulse_body(robot.base);
      if (!ground_) body.boundary_points.clear();
      const contact::ImpulseState motion{robot.location, robot.orientation, robot.velocity,
                                         robot.angular_velocity};
      parts_.push_back({robot.mobile,
                        contact::ImpulseAdvance(body, impulse_law(experiment_.contact)),
                        motion,
                        motion,
                        {}});
    }
    state_.bodies.resize(parts_.size());
    publish();
  }

  StepStatus step() override {
    for (Part& part : parts_) part.before = part.motion;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!parts_[i].mobile) continue;
      const StepStatus status = advance(i);
      if (status.ok()) continue;
      for (Part& part : parts_) part.motion = part.before;
      return status;
    }
    publish();
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    return {};
  }

  const WorldState& state() const override { return state_; }
  WorldInputs& inputs() override { return inputs_; }

 private:
  struct Part {
    bool mobile;
    contact::ImpulseAdvance law;
    contact::ImpulseState motion;
    contact::ImpulseState before;  ///< the present step, to undo it
    contact::AdvanceResult result;
  };

  StepStatus advance(std::size_t i) {
    const auto ground = [&](const Vector3d& point) {
      const contact::TilePoint tile = ground_->query(point);
      if (tile.outside && state_.notices.empty()) {
        state_.notices.push_back(experiment_.robots[i].name + ": " +
                                 ground_->outside_message(point));
      }
      return contact::GroundPoint{-tile.depth, tile.normal,
                                  &experiment_.materials[tile.material].constants};
    };
    Part& part = parts_[i];
    part.result = part.law.advance(part.motion, experiment_.deltat, load_on(i), ground);
    const contact::AdvanceStatus status = part.result.status;
    if (status == contact::AdvanceStatus::ok) return {};
    const bool lost = status == contact::AdvanceStatus::not_finite;
    return {lost ? StepStatus::Kind::not_finite : StepStatus::Kind::solver_failed, state_.time,
            experiment_.robots[i].name + ".base", contact::advice(status)};
  }

  void publish() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const contact::ImpulseState& motion = parts_[i].motion;
      const contact::AdvanceResult& result = parts_[i].result;
      state_.bodies[i] = {motion.position,
                          motion.orientation,
                          motion.velocity,
                          motion.angular_velocity,
                          (1. / experiment_.deltat) * result.impulse,
                          result.contacts};
      state_.impacts += static_cast<std::uint64_t>(result.impacts);
    }
  }

  /// The external forces on a body, about its centre of mass, at the step's start.
  contact::ImpulseLoad load_on(std::size_t i) const {
    contact::ImpulseLoad load{experiment_.gravity, {}, {}};
    const BodySpec& body = experiment_.robots[i].base;
    for (std::size_t k = 0; k < experiment_.forces.size(); ++k) {
      if (experiment_.forces[k].robot != static_cast<int>(i)) continue;
      const ForceInput& force = inputs_.forces[k];
      load.force += force.force;
      load.torque += force.torque;
      load.torque +=
          cross(rotate(parts_[i].motion.orientation, force.point - body.mass.center_of_mass),
                force.force);
    }
    return load;
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  const std::optional<contact::Terrain> ground_;
  std::vector<Part> parts_;
  WorldState state_;
};

}  // namespace

std::unique_ptr<Engine> make_impulse_engine(const Experiment& experiment) {
  return std::make_unique<ImpulseEngine>(experiment);
}

}  // namespace hookpoint::simulation
