#include "reference/peer_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::StepStatus;

bool finite(const Vector3d& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
bool finite(const BodyState& body) {
  const Quaterniond& q = body.orientation;
  return finite(body.position) && finite(body.velocity) && finite(body.angular_velocity) &&
         finite(body.contact_force) && finite(Vector3d{q.x, q.y, q.z}) && std::isfinite(q.w);
}

class PeerEngine final : public simulation::Engine {
 public:
  PeerEngine(const simulation::Experiment& experiment, std::unique_ptr<PeerWorld> world)
      : world_(std::move(world)),
        deltat_(experiment.deltat),
        inputs_(simulation::initial_inputs(experiment)) {
    for (const auto& robot : experiment.robots) {
      trails_.push_back(robot.name + "." + (robot.base.name.empty() ? "base" : robot.base.name));
      BodyState body;
      body.position = robot.location;
      body.orientation = robot.orientation;
      body.velocity = robot.velocity;
      body.angular_velocity = robot.angular_velocity;
      state_.bodies.push_back(body);
    }
    next_ = state_.bodies;
  }

  StepStatus step() override {
    if (!failure_.ok()) return failure_;
    const std::string trouble = world_->advance(inputs_.forces);
    world_->read(next_);
    for (std::size_t i = 0; i < next_.size(); ++i)
      if (!finite(next_[i]))
        return fail(StepStatus::Kind::not_finite, i,
                    "the state is not finite; look for an extreme force, mass or speed, or reduce "
                    "deltat");
    if (!trouble.empty())
      return fail(StepStatus::Kind::solver_failed, 0, trouble + "; a smaller deltat may help");
    // Copied, not swapped: whoever reads a value keeps its address.
    std::ranges::copy(next_, state_.bodies.begin());
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * deltat_;
    if (std::string notice = world_->notice(); !notice.empty()) {
      std::array<char, 32> time{};
      std::snprintf(time.data(), time.size(), "%g s: ", state_.time);
      state_.notices.push_back(time.data() + std::move(notice));
    }
    return {};
  }

  const simulation::WorldState& state() const override { return state_; }
  simulation::WorldInputs& inputs() override { return inputs_; }

 private:
  /// The library's own state is lost with the failure, so every later step repeats it.
  StepStatus fail(StepStatus::Kind kind, std::size_t body, std::string advice) {
    failure_ = {kind, state_.time, body < trails_.size() ? trails_[body] : std::string(),
                std::move(advice)};
    return failure_;
  }

  std::unique_ptr<PeerWorld> world_;
  double deltat_;
  simulation::WorldInputs inputs_;
  std::vector<std::string> trails_;
  simulation::WorldState state_;
  std::vector<BodyState> next_;
  StepStatus failure_;
};

}  // namespace

std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     std::unique_ptr<PeerWorld> world) {
  return std::make_unique<PeerEngine>(experiment, std::move(world));
}

}  // namespace hookpoint::reference
