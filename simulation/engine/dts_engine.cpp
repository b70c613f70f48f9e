#include "simulation/engine/dts_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "contact/force_law.h"
#include "simulation/engine/dts_robot.h"
#include "simulation/engine/impulse_engine.h"
#include "simulation/ground.h"

namespace hookpoint::simulation {
namespace {

void add(const integrators::Statistics& part, IntegratorState& sum) {
  sum.steps += part.steps;
  sum.rejected += part.rejected;
  sum.evaluations += part.evaluations;
  sum.jacobians += part.jacobians;
  sum.events += part.events;
}

class DtsEngine final : public Engine, public Resumable {
 public:
  explicit DtsEngine(const Experiment& experiment)
      : experiment_(experiment),
        inputs_(initial_inputs(experiment_)),
        ground_(make_ground(experiment_)) {
    if (!contact::find_force_law(experiment_.contact))
      throw ExperimentError("there is no contact law `" + experiment_.contact + "`");
    std::size_t bodies = 0, joints = 0, chains = 0;
    for (std::size_t i = 0; i < experiment_.robots.size(); ++i) {
      auto robot = std::make_unique<DtsRobot>(experiment_, static_cast<int>(i),
                                              ground_ ? &*ground_ : nullptr, inputs_);
      auto stepper = integrators::make_stepper(
          experiment_.integrator, *robot,
          {experiment_.relative_tolerance, experiment_.absolute_tolerance});
      if (!stepper)
        throw ExperimentError("there is no integrator `" + experiment_.integrator + "`");
      bodies += robot->model().body_count();
      joints += robot->model().link_count();
      chains += robot->model().chain_count();
      parts_.push_back({std::move(robot), std::move(stepper)});
    }
    state_.bodies.resize(bodies);
    state_.joints.resize(joints);
    state_.points.resize(experiment_.points.size());
    state_.chains.resize(chains);
    publish();
  }

  StepStatus step() override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      parts_[i].stepper->save(parts_[i].stepper_before);
      const StepStatus status =
          parts_[i].robot->step(*parts_[i].stepper, state_.time, experiment_.deltat);
      if (status.ok()) continue;
      for (std::size_t stepped = 0; stepped < i; ++stepped) parts_[stepped].robot->undo();
      for (std::size_t begun = 0; begun <= i; ++begun)
        parts_[begun].stepper->restore(parts_[begun].stepper_before);
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
    for (Part& part : parts_) part.robot->publish_contact_forces(wanted);
  }
  void publish_ground_forces() override {
    std::size_t points = 0;
    for (const Part& part : parts_) points += part.robot->contact_points().size();
    state_.ground_forces.reserve(points);
    state_.ground_force_time = GroundForceTime::now;
    copy_ground_forces();
  }
  std::optional<double> ground_energy() const override {
    double sum = 0.;
    for (const Part& part : parts_) sum += part.robot->ground_energy();
    return sum;
  }
  Resumable* resumable() override { return this; }

  std::size_t state_size() const override {
    std::size_t size = 1;
    for (const Part& part : parts_)
      size += 1 + part.robot->state_size() + part.stepper->state_size();
    return size;
  }

  std::string state_layout() const override {
    std::string layout = "step";
    for (const Part& part : parts_)
      layout += fmt::format(" {{noticed {} {}[{}]}}", part.robot->state_layout(),
                            experiment_.integrator, part.stepper->state_size());
    return layout;
  }

  void save(std::span<double> numbers) const override {
    numbers[0] = static_cast<double>(state_.step);
    std::span<double> left = numbers.subspan(1);
    std::size_t body = 0;
    for (const Part& part : parts_) {
      const std::size_t bodies = part.robot->model().body_count();
      left[0] = part.noticed ? 1. : 0.;
      left = left.subspan(1);
      part.robot->save(left.first(part.robot->state_size()),
                       std::span(state_.bodies).subspan(body, bodies));
      left = left.subspan(part.robot->state_size());
      part.stepper->save(left.first(part.stepper->state_size()));
      left = left.subspan(part.stepper->state_size());
      body += bodies;
    }
  }

  void restore(std::span<const double> numbers) override {
    state_.step = static_cast<std::int64_t>(numbers[0]);
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    std::span<const double> left = numbers.subspan(1);
    std::size_t body = 0;
    for (Part& part : parts_) {
      const std::size_t bodies = part.robot->model().body_count();
      part.noticed = left[0] != 0.;
      left = left.subspan(1);
      part.robot->restore(left.first(part.robot->state_size()),
                          std::span(state_.bodies).subspan(body, bodies));
      left = left.subspan(part.robot->state_size());
      part.stepper->restore(left.first(part.stepper->state_size()));
      left = left.subspan(part.stepper->state_size());
      body += bodies;
    }
    publish();
  }

 private:
  struct Part {
    std::unique_ptr<DtsRobot> robot;
    std::unique_ptr<integrators::Stepper> stepper;
    std::array<double, integrators::Stepper::state_size()> stepper_before{};  ///< the present step
    bool noticed = false;
  };

  void publish() {
    std::size_t body = 0, joint = 0;
    state_.integrator = {};
    for (Part& part : parts_) {
      add(part.stepper->statistics(), state_.integrator);
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
    if (has_details_) copy_details();
    if (state_.ground_force_time != GroundForceTime::unknown) copy_ground_forces();
  }

  void copy_ground_forces() {
    state_.ground_forces.clear();
    std::size_t body = 0;
    for (const Part& part : parts_) {
      part.robot->add_ground_forces(body, state_.ground_forces);
      body += part.robot->model().body_count();
    }
  }

  void copy_details() {
    for (std::size_t i = 0; i < state_.points.size(); ++i) {
      const PointSpec& point = experiment_.points[i];
      state_.points[i] =
          parts_[static_cast<std::size_t>(point.robot)].robot->point_state(point.body, point.point);
    }
    std::size_t chain = 0;
    for (const Part& part : parts_) {
      const std::size_t count = part.robot->model().chain_count();
      part.robot->publish_hips(std::span(state_.chains).subspan(chain, count));
      chain += count;
    }
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  const std::optional<contact::Terrain> ground_;
  std::vector<Part> parts_;
  WorldState state_;
  bool has_details_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_dts(const Experiment& experiment) {
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  if (law && law->is_impulse_law) return make_impulse_engine(experiment);
  return std::make_unique<DtsEngine>(experiment);
}

EngineDescription describe_dts() { return {"dts", HOOKPOINT_VERSION, "double", true, {}, {}}; }

}  // namespace hookpoint::simulation
