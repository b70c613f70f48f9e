#include "simulation/engine/impulse_engine.h"

#include <fmt/format.h>

#include "contact/force_law.h"
#include "simulation/engine/impulse_body.h"
#include "simulation/engine/impulse_robot.h"
#include "simulation/ground.h"

namespace hookpoint::simulation {
namespace {

contact::ImpulseLaw impulse_law(const std::string& name) {
  if (const auto law = contact::find_impulse_law(name)) return *law;
  throw ExperimentError("there is no impulse law `" + name + "`");
}

std::unique_ptr<ImpulsePart> make_part(const Experiment& experiment, std::size_t robot,
                                       const WorldInputs& inputs) {
  const contact::ImpulseLaw law = impulse_law(experiment.contact);
  const bool has_ground = experiment.terrain.has_value();
  if (experiment.robots[robot].chains.empty())
    return std::make_unique<ImpulseBody>(experiment, robot, law, has_ground, inputs);
  return std::make_unique<ImpulseRobot>(experiment, robot, law, has_ground, inputs);
}

class ImpulseEngine final : public Engine, public Resumable {
 public:
  explicit ImpulseEngine(const Experiment& experiment)
      : experiment_(experiment),
        inputs_(initial_inputs(experiment_)),
        ground_(make_ground(experiment_)) {
    std::size_t bodies = 0, joints = 0;
    for (std::size_t i = 0; i < experiment_.robots.size(); ++i) {
      parts_.push_back({make_part(experiment_, i, inputs_), bodies, joints, 0});
      bodies += parts_.back().robot->body_count();
      joints += parts_.back().robot->joint_count();
    }
    state_.bodies.resize(bodies);
    state_.joints.resize(joints);
    publish();
  }

  StepStatus step() override {
    const bool noticed_before = noticed_;
    const std::size_t notices_before = state_.notices.size();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const StepStatus status = advance(i);
      if (status.ok()) continue;
      for (std::size_t stepped = 0; stepped < i; ++stepped) parts_[stepped].robot->undo();
      noticed_ = noticed_before;
      state_.notices.resize(notices_before);
      return status;
    }
    for (const Part& part : parts_) state_.impacts += static_cast<std::uint64_t>(part.impacts);
    publish();
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    return {};
  }

  const WorldState& state() const override { return state_; }
  WorldInputs& inputs() override { return inputs_; }
  Resumable* resumable() override { return this; }

  std::size_t state_size() const override {
    StateCount count;
    exchange(*this, count);
    std::size_t size = count.count();
    for (const Part& part : parts_) size += part.robot->state_size();
    return size;
  }
  std::string state_layout() const override {
    std::string layout = "step impacts noticed";
    for (const Part& part : parts_) layout += fmt::format(" {{{}}}", part.robot->state_layout());
    return layout;
  }
  void save(std::span<double> numbers) const override {
    StateSaver saver(numbers);
    exchange(*this, saver);
    std::span<double> left = numbers.subspan(kOwnNumbers);
    for (const Part& part : parts_) {
      const std::size_t size = part.robot->state_size();
      part.robot->save(left.first(size),
                       std::span(state_.bodies).subspan(part.first_body, part.robot->body_count()));
      left = left.subspan(size);
    }
  }
  void restore(std::span<const double> numbers) override {
    StateRestorer restorer(numbers);
    exchange(*this, restorer);
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    std::span<const double> left = numbers.subspan(kOwnNumbers);
    for (Part& part : parts_) {
      const std::size_t size = part.robot->state_size();
      part.robot->restore(left.first(size), bodies_of(part));
      left = left.subspan(size);
    }
    publish();
  }

 private:
  static constexpr std::size_t kOwnNumbers = 3;  ///< of `exchange`

  struct Part {
    std::unique_ptr<ImpulsePart> robot;
    std::size_t first_body, first_joint;
    std::int64_t impacts;  ///< of the last step
  };

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive(self.state_.step);
    archive(self.state_.impacts);
    archive(self.noticed_);
  }

  std::span<BodyState> bodies_of(const Part& part) {
    return std::span(state_.bodies).subspan(part.first_body, part.robot->body_count());
  }

  StepStatus advance(std::size_t i) {
    const auto ground = [&](const Vector3d& point) {
      const contact::TilePoint tile = ground_->query(point);
      if (tile.outside && !noticed_) {
        noticed_ = true;
        state_.notices.push_back(experiment_.robots[i].name + ": " +
                                 ground_->outside_message(point));
      }
      return contact::GroundPoint{-tile.depth, tile.normal,
                                  &experiment_.materials[tile.material].constants};
    };
    const contact::ImpulseTally tally = parts_[i].robot->advance(ground);
    parts_[i].impacts = tally.impacts;
    if (tally.status == contact::AdvanceStatus::ok) return {};
    const bool lost = tally.status == contact::AdvanceStatus::not_finite;
    return {lost ? StepStatus::Kind::not_finite : StepStatus::Kind::solver_failed, state_.time,
            experiment_.robots[i].name + ".base", contact::advice(tally.status)};
  }

  void publish() {
    for (Part& part : parts_) {
      part.robot->publish(
          bodies_of(part),
          std::span(state_.joints).subspan(part.first_joint, part.robot->joint_count()));
    }
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  const std::optional<contact::Terrain> ground_;
  std::vector<Part> parts_;
  WorldState state_;
  bool noticed_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_impulse_engine(const Experiment& experiment) {
  return std::make_unique<ImpulseEngine>(experiment);
}

}  // namespace hookpoint::simulation
