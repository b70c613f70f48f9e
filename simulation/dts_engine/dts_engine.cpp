#include "simulation/dts_engine/dts_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/force_law.h"
#include "simulation/dts_engine/force_robot.h"
#include "simulation/dts_engine/group_part.h"
#include "simulation/dts_engine/impulse_part.h"
#include "simulation/engine_interface/drive_watch.h"
#include "simulation/engine_interface/restartable.h"
#include "simulation/experiment/ground.h"

namespace hookpoint::simulation {
namespace {

/// Of an obstacle, or of ground that moves, in a saved state: its pose and its velocities.
constexpr std::size_t numbers_of_surface = 16;

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
        drives_(experiment_),
        ground_(make_ground(experiment_)),
        together_(step_together(experiment_)),
        ground_moves_(ground_moves(experiment_)) {
    if (contact::find_law(experiment_.contact) == nullptr)
      throw ExperimentError("there is no contact law `" + experiment_.contact + "`");
    std::size_t bodies = 0, joints = 0, chains = 0;
    for (std::size_t i = 0; i < part_count(); ++i) {
      parts_.push_back({make_part(experiment_, i), bodies, joints, chains});
      bodies += parts_.back().robot->body_count();
      joints += parts_.back().robot->joint_count();
      if (ForceDetails* details = parts_.back().robot->details()) details_.push_back(details);
      for (std::size_t robot = i; robot < (together_ ? experiment_.robots.size() : i + 1); ++robot)
        chains += experiment_.robots[robot].chains.size();
      parts_.back().chain_count = chains - parts_.back().first_chain;
    }
    for (Part& part : parts_) part.notice.reserve(longest_notice);
    state_.notices.reserve(parts_.size());
    state_.bodies.resize(bodies);
    state_.joints.resize(joints);
    if (together_)
      state_.surface_works = std::vector<double>(parts_[0].robot->surface_works().size());
    state_.loops.resize(experiment_.loops.size());
    if (tells_details()) {
      state_.points.resize(experiment_.points.size());
      state_.chains.resize(chains);
      state_.body_contacts.resize(bodies);
      surface_sums_.resize((experiment_.terrain ? 1 : 0) + experiment_.obstacles.size());
      state_.surface_contacts.resize(surface_sums_.size());
      state_.reactions.resize(joints);
    }
    publish();
  }

  StepStatus step() override {
    drives_.look(inputs_, state_.joints, state_.time, state_.notices);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const StepStatus status = parts_[i].robot->step(state_.time);
      if (status.ok()) continue;
      for (std::size_t stepped = 0; stepped < i; ++stepped) parts_[stepped].robot->undo();
      return status;
    }
    for_each_surface([&](SurfaceMotion& surface) { advance(surface, experiment_.deltat); });
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    publish();
    return {};
  }

  const WorldState& state() const override { return state_; }
  WorldInputs& inputs() override { return inputs_; }
  // Whoever wants a port calls these: many do, and what is published is up to date.
  void publish_details() override {
    if (!std::exchange(has_details_, true)) copy_details();
  }
  void publish_reactions() override {
    if (!std::exchange(has_reactions_, true)) copy_reactions();
  }
  void enable_mean_forces(bool on) override {
    if (std::exchange(mean_forces_, on) == on) return;
    for (ForceDetails* details : details_) details->enable_mean_forces(on);
    if (has_details_) copy_details();
  }
  GroundForceTime tells_ground_forces() const override {
    return tells_details() ? GroundForceTime::now : GroundForceTime::unknown;
  }
  bool tells_works() const override { return true; }
  void publish_works() override {
    if (!state_.works.empty()) return;
    state_.works.resize(experiment_.robots.size());
    for (Part& part : parts_) part.robot->measure_work();
  }
  void publish_ground_forces() override {
    if (!tells_details()) return;
    state_.ground_force_time = tells_ground_forces();
    std::size_t points = 0;
    for (const RobotSpec& robot : experiment_.robots) points += boundary_points(robot).size();
    if (together_) points *= 2;  // a place between two bodies is told of both
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
    if (!tells_details()) return std::nullopt;
    double sum = 0.;
    for (const ForceDetails* details : details_) sum += details->ground_energy();
    return sum;
  }
  Resumable* resumable() override { return this; }

  std::size_t state_size() const override {
    std::size_t size = 1 + numbers_of_surface * surface_count();
    for (const Part& part : parts_) size += 1 + part.robot->state_size();
    return size;
  }

  std::string state_layout() const override {
    std::string layout = "step";
    if (surface_count() > 0)
      layout += fmt::format(" surface[{}] {{position orientation velocity angular_velocity belt}}",
                            surface_count());
    for (const Part& part : parts_)
      layout += fmt::format(" {{noticed {}}}", part.robot->state_layout());
    return layout;
  }

  void save(std::span<double> numbers) const override {
    numbers[0] = static_cast<double>(state_.step);
    numbers = numbers.subspan(1);
    for_each_surface([&](const SurfaceMotion& at) {
      const auto& [p, q, v, w, b] = at;
      std::ranges::copy(std::array{p.x, p.y, p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z,
                                   b.x, b.y, b.z},
                        numbers.begin());
      numbers = numbers.subspan(numbers_of_surface);
    });
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
    for_each_surface([&](SurfaceMotion& at) {
      const std::span<const double> n = numbers.first(numbers_of_surface);
      at.position = {n[0], n[1], n[2]};
      at.orientation = {n[3], n[4], n[5], n[6]};
      at.velocity = {n[7], n[8], n[9]};
      at.angular_velocity = {n[10], n[11], n[12]};
      at.belt_velocity = {n[13], n[14], n[15]};
      numbers = numbers.subspan(numbers_of_surface);
    });
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
      const auto fresh = make_part(start, i);
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
  /// A robot, or all of them together, where its published values begin, and whether its notice has
  /// been told.
  struct Part {
    std::unique_ptr<RobotPart> robot;
    std::size_t first_body = 0, first_joint = 0, first_chain = 0;
    std::size_t chain_count = 0;
    bool noticed = false;
    std::string notice{};  ///< room for it, so that the step in which it comes allocates nothing
  };

  /// Whether what robots touch makes one system of them.
  static bool step_together(const Experiment& experiment) {
    return !experiment.robots.empty() && shapes_matter(experiment);
  }
  /// Of the ground, where it moves, and the obstacles.
  template <class Visit>
  void for_each_surface(const Visit& visit) {
    if (ground_moves_) visit(inputs_.ground);
    for (SurfaceMotion& obstacle : inputs_.obstacles) visit(obstacle);
  }
  template <class Visit>
  void for_each_surface(const Visit& visit) const {
    if (ground_moves_) visit(inputs_.ground);
    for (const SurfaceMotion& obstacle : inputs_.obstacles) visit(obstacle);
  }
  std::size_t surface_count() const { return (ground_moves_ ? 1 : 0) + inputs_.obstacles.size(); }
  std::size_t part_count() const { return together_ ? 1 : experiment_.robots.size(); }

  std::unique_ptr<RobotPart> make_part(const Experiment& experiment, std::size_t index) const {
    const contact::Terrain* ground = ground_ ? &*ground_ : nullptr;
    if (contact::find_impulse_law(experiment.contact) != nullptr)
      return make_impulse_part(experiment, index, ground, inputs_);
    if (together_) return std::make_unique<GroupPart>(experiment, ground, inputs_);
    return std::make_unique<ForceRobot>(experiment, index, ground, inputs_);
  }

  /// Whether the robots' law tells points, hips and ground forces: no impulse law does.
  bool tells_details() const { return details_.size() == parts_.size(); }

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
        part.notice = part.robot->notice();
        state_.notices.push_back(std::move(part.notice));
        part.noticed = true;
      }
      part.robot->publish_loops(state_.loops);
      part.robot->publish(
          bodies_of(part),
          std::span(state_.joints).subspan(part.first_joint, part.robot->joint_count()));
    }
    if (together_)
      std::ranges::copy(parts_[0].robot->surface_works(), state_.surface_works.begin());
    for (std::size_t i = 0; i < parts_.size() && !state_.works.empty(); ++i)
      parts_[i].robot->publish_works(std::span(state_.works).subspan(i));
    if (has_details_) copy_details();
    if (has_reactions_) copy_reactions();
    if (state_.ground_force_time != GroundForceTime::unknown) copy_ground_forces();
  }

  void copy_ground_forces() {
    state_.ground_forces.clear();
    for (std::size_t i = 0; i < details_.size(); ++i)
      details_[i]->add_ground_forces(parts_[i].first_body, state_.ground_forces);
  }

  void copy_reactions() {
    for (std::size_t i = 0; i < details_.size(); ++i)
      details_[i]->publish_reactions(
          std::span(state_.reactions)
              .subspan(parts_[i].first_joint, parts_[i].robot->joint_count()));
  }

  void copy_details() {
    for (std::size_t i = 0; i < state_.points.size(); ++i) {
      const PointSpec& point = experiment_.points[i];
      const auto robot = static_cast<std::size_t>(point.robot);
      state_.points[i] = details_[together_ ? 0 : robot]->point_state(
          robot, static_cast<std::size_t>(point.body), static_cast<std::size_t>(point.point));
    }
    for (std::size_t i = 0; i < details_.size(); ++i) {
      details_[i]->publish_hips(
          std::span(state_.chains).subspan(parts_[i].first_chain, parts_[i].chain_count));
      details_[i]->publish_body_contacts(
          std::span(state_.body_contacts)
              .subspan(parts_[i].first_body, parts_[i].robot->body_count()));
    }
    copy_surface_contacts();
  }

  void copy_surface_contacts() {
    std::ranges::fill(surface_sums_, SurfaceSum{});
    for (const ForceDetails* details : details_) details->add_surface_contacts(surface_sums_);
    const std::size_t obstacles = experiment_.terrain ? 1 : 0;
    for (std::size_t i = 0; i < surface_sums_.size(); ++i) {
      const SurfaceMotion& surface =
          i < obstacles ? inputs_.ground : inputs_.obstacles[i - obstacles];
      const auto& [contacts, mean_force] = surface_sums_[i];
      state_.surface_contacts[i] = {mean_force, static_cast<double>(contacts.count()),
                                    contacts.about(surface.position)};
    }
  }

  const Experiment experiment_;
  WorldInputs inputs_;
  DriveWatch drives_;
  const std::optional<contact::Terrain> ground_;
  const bool together_;  ///< all robots are one part
  const bool ground_moves_;
  std::vector<Part> parts_;
  std::vector<ForceDetails*> details_;  ///< of the parts, in their order; none under an impulse law
  std::vector<SurfaceSum> surface_sums_;  ///< for what is published
  WorldState state_;
  bool has_details_ = false, has_reactions_ = false;
  std::optional<bool> mean_forces_;  ///< as they were enabled; none: as the parts have them
};

}  // namespace

std::unique_ptr<Engine> make_dts(const Experiment& experiment) {
  return std::make_unique<DtsEngine>(experiment);
}

EngineDescription describe_dts() { return {"dts", HOOKPOINT_VERSION, "double", true, {}, {}}; }

}  // namespace hookpoint::simulation
