#include "apps/view/session/movie_session.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/view/session/keep_picture.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::view {
namespace {

using namespace std::chrono_literals;
using text::JsonWriter;

/// A trace is waited for so long before it is answered with what is known of it so far.
constexpr auto trace_patience = 500ms;
constexpr auto between_progress = 500ms;

constexpr const char* unchangeable =
    "a movie is not changed: `hookpoint run --resume MOVIE --at TIME` continues from that time";

}  // namespace

MovieSession::MovieSession(const ShownMovie& movie, Audience& audience, MovieSessionRequest request)
    : movie_(movie),
      audience_(audience),
      request_(std::move(request)),
      reel_(movie),
      traces_(movie) {
  show();
}

void MovieSession::show() {
  generation_ = reel_.generation();
  std::vector<simulation::Port> ports = reel_.world().ports();
  Shown shown = request_.describe(ports);
  for (simulation::Port& port : ports) port.writable = nullptr;
  want(shown.plotted);
  audience_.show(std::move(shown.description), movie_.experiment, std::move(ports),
                 std::move(shown.trails));
}

void MovieSession::want(const std::vector<std::string>& trails) {
  std::vector<simulation::Port> ports;
  traces_.want(trails, [&](const std::string& trail) {
    if (ports.empty()) ports = reel_.world().ports();
    return simulation::look_up_port(movie_.experiment, ports, trail).has_value();
  });
}

double MovieSession::time_of(std::int64_t step) const {
  return static_cast<double>(step) * movie_.experiment.deltat;
}

void MovieSession::run(const std::atomic<bool>& stop) {
  next_snapshot_ = next_progress_ = Clock::now();
  while (!stop && !quit_) {
    audience_.hear();
    while (const std::optional<PageRequest> request = audience_.next()) carry_out(*request);
    if (generation_ != reel_.generation()) show();
    const auto until = std::min(next_snapshot_, Clock::now() + Pace::slice);
    advance(until);
    answer_arrived();
    if (traces_.busy() && !audience_.empty())
      traces_.work(std::max(until, Clock::now() + Pace::slice / 5));
    answer_traces();
    if (Clock::now() >= next_snapshot_) publish();
    if (!quit_) audience_.wait(next_wake());
  }
  if (quit_) audience_.tell_ended("the movie was closed");
}

void MovieSession::advance(Clock::time_point until) {
  if (paused_ || !travelling_.empty()) {
    reel_.go(until);
    return;
  }
  const auto now = Clock::now();
  const double time = reel_.time();
  pace_.reach(now, time);
  if (pace_.requested() == 0.) {
    reel_.aim(reel_.last());
  } else {
    const double due = std::min(pace_.due(now, time) / movie_.experiment.deltat,
                                static_cast<double>(reel_.last()));
    reel_.aim(std::max(reel_.step(), static_cast<std::int64_t>(std::floor(due + 1e-6))));
  }
  if (reel_.go(until) && reel_.step() == reel_.last()) paused_ = true;
}

void MovieSession::answer_arrived() {
  if (travelling_.empty() || !reel_.there()) return;
  publish();
  for (const PageRequest& request : std::exchange(travelling_, {})) audience_.answer(request);
}

void MovieSession::answer_traces() {
  std::erase_if(waiting_, [&](const WaitingTrace& waiting) {
    const AskTrace& trace = waiting.trace;
    if (!traces_.known(trace.trails, trace.to) && Clock::now() < waiting.until) return false;
    const Traces::Extract extract =
        traces_.extract(trace.trails, trace.from, trace.to, trace.points);
    audience_.answer_trace(waiting.request,
                           encode_trace(waiting.request.id, extract.times, extract.values));
    return true;
  });
}

void MovieSession::publish() {
  next_snapshot_ = std::max(next_snapshot_ + Pace::between_snapshots, Clock::now());
  tell_differences();
  tell_progress();
  const bool shown = reel_.there() || (!paused_ && travelling_.empty() && reel_.whole());
  if (audience_.empty() || !shown) return;
  SessionState state;
  state.number = ++snapshots_;
  state.past = reel_.step() < reel_.last();
  state.paused = paused_;
  state.speed_asked = pace_.requested();
  state.speed_reached = paused_ ? 0. : pace_.reached();
  state.history_first = time_of(reel_.first());
  state.history_last = time_of(reel_.last());
  reel_.publish(audience_, state);
}

/// Another build computes other last digits: what it shows is still the movie's at every instant.
void MovieSession::tell_differences() {
  if (difference_told_ || reel_.difference().empty() || audience_.empty()) return;
  difference_told_ = true;
  audience_.tell_notice("warning", reel_.difference() +
                                       "; between the movie's instants, what is shown is what this "
                                       "program computes from the one before");
}

void MovieSession::tell_progress() {
  const bool reading = traces_.busy() && !audience_.empty();
  if (!reading && !reading_told_) return;
  if (reading && Clock::now() < next_progress_) return;
  next_progress_ = Clock::now() + between_progress;
  reading_told_ = reading;
  audience_.tell_progress("plots", reading ? traces_.progress() : 1.);
}

MovieSession::Clock::time_point MovieSession::next_wake() const {
  const auto now = Clock::now();
  if (audience_.empty()) return now + Pace::idle;
  if (traces_.busy() || !reel_.there() || (!paused_ && pace_.requested() == 0.)) return now;
  if (paused_) return std::min(next_snapshot_, now + Pace::slice);
  const double next = time_of(reel_.step() + 1);
  return std::min({pace_.when(next), next_snapshot_, now + Pace::slice});
}

void MovieSession::carry_out(const PageRequest& request) {
  std::visit(
      [&](const auto& command) {
        if constexpr (requires { carry_out(request, command); })
          carry_out(request, command);
        else
          audience_.refuse(request, unchangeable);
      },
      request.command);
  next_snapshot_ = std::min(next_snapshot_, Clock::now());
}

void MovieSession::carry_out(const PageRequest& request, const Pause& /*command*/) {
  if (!paused_)
    go_to(request, reel_.step());
  else
    audience_.answer(request);
}

/// At its end a movie begins again.
void MovieSession::carry_out(const PageRequest& request, const Run& /*command*/) {
  if (reel_.there() && reel_.step() == reel_.last()) reel_.aim(reel_.first());
  pace_.restart();
  paused_ = false;
  audience_.answer(request);
}

void MovieSession::carry_out(const PageRequest& request, const StepOn& command) {
  go_to(request, reel_.step() + command.count);
}

void MovieSession::carry_out(const PageRequest& request, const SetSpeed& command) {
  pace_.ask(command.factor);
  audience_.answer(request);
}

void MovieSession::carry_out(const PageRequest& request, const Seek& command) {
  const double deltat = movie_.experiment.deltat;
  const double last = static_cast<double>(reel_.last()) * deltat;
  go_to(request, simulation::step_count(std::clamp(command.time, 0., last), deltat));
}

void MovieSession::carry_out(const PageRequest& request, const Reset& /*command*/) {
  go_to(request, reel_.first());
}

void MovieSession::carry_out(const PageRequest& request, const AskTrace& command) {
  if (command.trails.size() > Traces::most_columns)
    return audience_.refuse(
        request, "a trace has at most " + std::to_string(Traces::most_columns) + " trails");
  want(command.trails);
  waiting_.push_back({request, command, Clock::now() + trace_patience});
}

void MovieSession::carry_out(const PageRequest& request, const ListFields& /*command*/) {
  audience_.answer(request, [](JsonWriter& json) { json.key("fields").begin_array().end_array(); });
}

void MovieSession::carry_out(const PageRequest& request, const ListChanges& /*command*/) {
  audience_.answer(request,
                   [](JsonWriter& json) { json.key("changes").begin_array().end_array(); });
}

void MovieSession::carry_out(const PageRequest& request, const KeepPicture& command) {
  keep_picture(request, command, request_.folder, audience_);
}

void MovieSession::carry_out(const PageRequest& request, const Quit& /*command*/) {
  quit_ = true;
  audience_.answer(request);
}

void MovieSession::go_to(const PageRequest& request, std::int64_t step) {
  paused_ = true;
  pace_.restart();
  reel_.aim(step);
  travelling_.push_back(request);
}

}  // namespace hookpoint::view
