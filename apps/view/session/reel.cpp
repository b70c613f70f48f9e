#include "apps/view/session/reel.h"

#include <algorithm>

#include "simulation/run/shown_scene.h"

namespace hookpoint::view {

Reel::Reel(const ShownMovie& movie) : movie_(movie) {
  begin();
  aim(first());
}

void Reel::begin() {
  world_ = movie_.make_world();
  world_->publish_contact_forces();
  rewind_ = std::make_unique<simulation::Rewind>(movie_.experiment, movie_.reader, *world_);
  ++generation_;
}

void Reel::aim(std::int64_t step) {
  goal_ = std::clamp(step, first(), last());
  // No step leads to time 0: only a world that begins there has all of it.
  if (goal_ == 0 && !(this->step() == 0 && whole())) begin();
  rewind_->turn_to(goal_);
}

void Reel::go_on() {
  std::string differs = rewind_->go_on();
  if (difference_.empty()) difference_ = std::move(differs);
}

bool Reel::go(Clock::time_point until) {
  while (!there() && Clock::now() < until) go_on();
  return there();
}

SubjectState Reel::moment(SessionState& state) {
  world_->tell_contacts(contacts_);
  simulation::shown_poses(movie_.experiment, *world_, poses_);
  state.step = step();
  state.time = time();
  return {true, poses_, contacts_};
}

void Reel::publish(Audience& audience, SessionState state) {
  const SubjectState shown = moment(state);
  audience.publish(state, std::span(&shown, 1));
}

}  // namespace hookpoint::view
