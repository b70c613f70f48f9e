#include "apps/view/session/slider_marks.h"

#include <chrono>
#include <utility>

namespace hookpoint::view {

SliderMarks::~SliderMarks() { stop_ = true; }  // and the future waits

void SliderMarks::show(std::vector<SliderPath> paths) {
  stop_ = true;
  if (found_.valid()) found_.wait();
  paths_ = std::move(paths);
  next_.reset();
  // Whoever asked has a new description, and asks again.
  asked_.clear();
  waiting_.clear();
  found_ = {};
}

void SliderMarks::request(const PageRequest& request, simulation::Experiment now,
                          Audience& audience) {
  if (paths_.empty()) return answer(request, {}, audience);
  waiting_.push_back(request);
  next_ = std::move(now);
  if (!found_.valid()) begin(*std::exchange(next_, std::nullopt));
}

void SliderMarks::begin(simulation::Experiment now) {
  asked_ = std::exchange(waiting_, {});
  stop_ = false;
  found_ = std::async(std::launch::async, [this, now = std::move(now)] {
    std::vector<Mark> marks;
    for (const SliderPath& path : paths_)
      for (const simulation::Stretch& stretch : unstable_stretches(now, path.moves, stop_))
        marks.push_back({path.slider, stretch});
    return marks;
  });
}

void SliderMarks::answer_finished(Audience& audience) {
  if (!found_.valid() || found_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  const std::vector<Mark> marks = found_.get();
  for (const PageRequest& request : asked_) answer(request, marks, audience);
  asked_.clear();
  if (next_) begin(*std::exchange(next_, std::nullopt));
}

void SliderMarks::answer(const PageRequest& request, const std::vector<Mark>& marks,
                         Audience& audience) {
  audience.answer(request, [&](text::JsonWriter& json) {
    json.key("unstable").begin_array();
    for (const Mark& mark : marks) {
      json.begin_object().member("port", mark.slider);
      json.member("from", mark.stretch.least).member("to", mark.stretch.greatest).end_object();
    }
    json.end_array();
  });
}

}  // namespace hookpoint::view
