#include "simulation/engine/dts_engine.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "contact/force_law.h"
#include "simulation/effort_watch.h"
#include "simulation/engine/force_robot.h"
#include "simulation/engine/impulse_part.h"
#include "simulation/ground.h"
#include "simulation/restartable.h"

namespace hookpoint::simulation {
namespace {

void add(const IntegratorState& part, IntegratorState& sum) {
  sum.steps += part.steps;
  sum.rejected += part.rejected;
  sum.evaluations += part.evaluations;
  sum.jacobians += part.jacobians;
  sum.events += part.events;
}

class DtsEngine final : public Engine, public Resumable, public Restartable {
 public:
  explicit DtsEngine(const Experiment& experiment)
      : experiment_(experiment),
        inputs_(initial_inputs(experiment_)),
        efforts_(experiment_),
        ground_(make_ground(experiment_)) {
    const contact::LawDescription* law = contact::find_law(experiment_.contact);
    if (law == nullptr)
      throw ExperimentError("there is no contact law `" + experiment_.contact + "`");
    under_impulse_law_ = law->is_impulse_law;
    std::size_t bodies = 0, joints = 0, chains = 0;
    for (std::size_t i = 0; i < experiment_.robots.size(); ++i) {
      parts_.push_back({make_robot(experiment_, i), bodies, joints, chains});
      bodies += parts_.back().robot->body_count();
      joints += parts_.back().robot->joint_count();
      chains += experiment_.robots[i].chains.size();
    }
    state_.bodies.resize(bodies);
    state_.joints.resize(joints);
    if (!under_impulse_law_) {
      state_.points.resize(experiment_.points.size());
      state_.chains.resize(chains);
    }
    publish();
  }

  StepStatus step() override {
    efforts_.look(inputs_, state_.time, state_.notices);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const StepStatus status = parts_[i].robot->step(state_.time);
      if (status.ok()) continue;
      for (std::size_t stepped = 0; stepped < i; ++stepped) parts_[stepped].robot->undo();
      return status;
    }
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    publish();
    return {};
  }

  const WorldState& state() const override { return state_; }
  WorldInputs& inputs() override { return inputs_; }
  void publish_details() override {
    has_details_ = true;
    copy_details();
  }
  void publish_contact_forces(bool wanted) override {
    for (Part& part : parts_) {
      if (ForceDetails* details = part.robot->details()) details->publish_contact_forces(wanted);
    }
  }
  void publish_ground_forces() override {
    if (under_impulse_law_) return;
    state_.ground_force_time = GroundForceTime::now;
    std::size_t points = 0;
    for (const RobotSpec& robot : experiment_.robots) points += boundary_points(robot).size();
    state_.ground_forces.reserve(points);
    copy_ground_forces();
  }
  void tell_contacts(std::vector<ContactView>& contacts) const override {
    contacts.clear();
    for (const Part& part : parts_) {
      const auto bodies =
          std::span(state_.bodies).subspan(part.first_body, part.robot->body_count());
      part.robot->add_contacts(part.first_body, bodies, contacts);
    }
  }
  std::optional<double> ground_energy() const override {
    if (under_impulse_law_) return std::nullopt;
    double sum = 0.;
    for (const Part& part : parts_) sum += part.robot->details()->ground_energy();
    return sum;
  }
  Resumable* resumable() override { return this; }

  std::size_t state_size() const override {
    std::size_t size = 1;
    for (const Part& part : parts_) size += 1 + part.robot->state_size();
    return size;
  }

  std::string state_layout() const override {
    std::string layout = "step";
    for (const Part& part : parts_)
      layout += fmt::format(" {{noticed {}}}", part.robot->state_layout());
    return layout;
  }

  void save(std::span<double> numbers) const override {
    numbers[0] = static_cast<double>(state_.step);
    numbers = numbers.subspan(1);
    for (const Part& part : parts_) {
      const std::size_t size = part.robot->state_size();
      numbers[0] = part.noticed ? 1. : 0.;
      part.robot->save(numbers.subspan(1, size),
                       std::span(state_.bodies).subspan(part.first_body, part.robot->body_count()));
      numbers = numbers.subspan(1 + size);
    }
  }

  void restore(std::span<const double> numbers) override {
    state_.step = static_cast<std::int64_t>(numbers[0]);
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    numbers = numbers.subspan(1);
    for (Part& part : parts_) {
      const std::size_t size = part.robot->state_size();
      part.noticed = numbers[0] != 0.;
      part.robot->restore(numbers.subspan(1, size), bodies_of(part));
      if (!part.noticed) part.robot->forget_notice();
      numbers = numbers.subspan(1 + size);
    }
    publish();
  }

  /// Each robot takes the numbers of a new one.
  void restart(const Experiment& start) override {
    restart_inputs(start, inputs_);
    state_.step = 0;
    state_.time = 0.;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      const auto fresh = make_robot(start, i);
      std::vector<BodyState> bodies(fresh->body_count());
      std::vector<JointState> joints(fresh->joint_count());
      fresh->publish(bodies, joints);
      std::vector<double> numbers(fresh->state_size());
      fresh->save(numbers, bodies);
      part.robot->restore(numbers, bodies_of(part));
      part.robot->forget_notice();
      part.noticed = false;
    }
    publish();
  }

 private:
  /// A robot, where its published values begin, and whether its notice has been told.
  struct Part {
    std::unique_ptr<RobotPart> robot;
    std::size_t first_body = 0, first_joint = 0, first_chain = 0;
    bool noticed = false;
  };

  std::unique_ptr<RobotPart> make_robot(const Experiment& experiment, std::size_t index) const {
    const contact::Terrain* ground = ground_ ? &*ground_ : nullptr;
    if (under_impulse_law_) return make_impulse_part(experiment, index, ground, inputs_);
    return std::make_unique<ForceRobot>(experiment, index, ground, inputs_);
  }

  std::span<BodyState> bodies_of(const Part& part) {
    return std::span(state_.bodies).subspan(part.first_body, part.robot->body_count());
  }

  void publish() {
    state_.integrator = {};
    state_.impacts = 0;
    for (Part& part : parts_) {
      add(part.robot->statistics(), state_.integrator);
      state_.impacts += part.robot->impacts();
      if (!part.noticed && !part.robot->notice().empty()) {
        state_.notices.push_back(part.robot->notice());
        part.noticed = true;
      }
      part.robot->publish(
          bodies_of(part),
          std::span(state_.joints).subspan(part.first_joint, part.robot->joint_count()));
    }
    if (has_details_) copy_details();
    if (state_.ground_force_time != GroundForceTime::unknown) copy_ground_forces();
  }

  void copy_ground_forces() {
    state_.ground_forces.clear();
    for (Part& part : parts_)
      part.robot->details()->add_ground_forces(part.first_body, state_.ground_forces);
  }

  void copy_details() {
    if (under_impulse_law_) return;
    for (std::size_t i = 0; i < state_.points.size(); ++i) {
      const PointSpec& point = experiment_.points[i];
      Part& part = parts_[static_cast<std::size_t>(point.robot)];
      state_.points[i] = part.robot->details()->point_state(static_cast<std::size_t>(point.body),
                                                            static_cast<std::size_t>(point.point));
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      parts_[i].robot->details()->publish_hips(
          std::span(state_.chains)
              .subspan(parts_[i].first_chain, experiment_.robots[i].chains.size()));
    }
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  EffortWatch efforts_;
  const std::optional<contact::Terrain> ground_;
  std::vector<Part> parts_;
  WorldState state_;
  bool under_impulse_law_ = false;
  bool has_details_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_dts(const Experiment& experiment) {
  return std::make_unique<DtsEngine>(experiment);
}

EngineDescription describe_dts() { return {"dts", HOOKPOINT_VERSION, "double", true, {}, {}}; }

}  // namespace hookpoint::simulation
