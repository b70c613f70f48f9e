#include "apps/view/session/live_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "apps/view/session/keep_picture.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/run/loop.h"

namespace hookpoint::view {
namespace {

using simulation::StepStatus;
using text::JsonWriter;

constexpr const char* reset_needed = "the run has ended; reset starts it again";

/// What a person holds there: where a slider's value is copied to a port, that is the slider.
std::string held_by(const simulation::Experiment& experiment, const std::string& trail) {
  const auto copies = [&](const simulation::WireSpec& wire) {
    return (wire.to == trail || wire.to == experiment.world + "." + trail) && !wire.rate &&
           wire.delay == 0. && wire.noise == 0.;
  };
  const auto wire = std::ranges::find_if(experiment.wires, copies);
  if (wire == experiment.wires.end() || !experiment.values) return trail;
  const auto held =
      std::ranges::find(*experiment.values, wire->from, &simulation::ValueSpec::trail);
  return held != experiment.values->end() && held->writable ? wire->from : trail;
}

}  // namespace

LiveSession::LiveSession(Subjects& subjects, Audience& audience, LiveSessionRequest request)
    : subjects_(subjects), audience_(audience), request_(std::move(request)) {
  show();
  sample();
}

/// The run's world is another one: what is read of it is looked up anew.
void LiveSession::show() {
  generation_ = subjects_.run().generation();
  Shown shown = request_.describe(subjects_);
  for (const std::string& trail : shown.plotted) traces_.add(trail);
  look_up_plotted();
  files_.watch(std::move(shown.sources));
  marks_.show(std::move(shown.sliders));
  last_step_ = request_.last_step(subjects_.run());
  hold_step_.reset();
  if (shown.holds && !last_step_) hold_step_ = subjects_.run().last_step();
  audience_.show(std::move(shown.description), subjects_.run().experiment(), free_ports(),
                 std::move(shown.trails));
}

/// All ports; those that a wire drives which nobody holds are not writable.
std::vector<simulation::Port> LiveSession::free_ports() const {
  const simulation::Experiment& experiment = subjects_.run().experiment();
  std::set<std::string> driven;
  for (const simulation::WireSpec& wire : experiment.wires) driven.insert(wire.to);
  std::vector<simulation::Port> ports = subjects_.ports();
  for (simulation::Port& port : ports)
    if (port.writable != nullptr && driven.contains(port.trail) &&
        held_by(experiment, port.trail) == port.trail)
      port.writable = nullptr;
  return ports;
}

void LiveSession::look_up_plotted() {
  const std::vector<simulation::Port> ports = subjects_.ports();
  plotted_.clear();
  for (const std::string& trail : traces_.trails()) {
    const auto port = simulation::look_up_port(subjects_.run().experiment(), ports, trail);
    plotted_.push_back(port ? port->value : nullptr);
  }
  sample_.resize(plotted_.size());
}

bool LiveSession::run(const std::atomic<bool>& stop) {
  next_snapshot_ = begun_ = Clock::now();
  while (!stop && !quit_) {
    answer_requests();
    marks_.answer_finished(audience_);
    if (files_.written()) reload();
    const auto until = std::min(next_snapshot_, Clock::now() + Pace::slice);
    if (stepping_)
      take_asked_steps(until);
    else if (plays() && !awaits_first_page())
      advance(until);
    if (Clock::now() >= next_snapshot_) publish();
    if (!quit_) audience_.wait(next_wake());
  }
  log_end();
  if (quit_) audience_.tell_ended("Simulator.quit is true");
  return !failed_;
}

/// While steps are being taken that somebody request for, what was request after them waits.
void LiveSession::answer_requests() {
  audience_.hear();
  while (!stepping_ && !quit_) {
    const std::optional<PageRequest> request = audience_.next();
    if (!request) return;
    carry_out(*request);
  }
}

void LiveSession::reload() {
  if (const std::string problem = perform(Reset{}); !problem.empty())
    audience_.tell_notice("error",
                          "the file was saved, but the run continues as it was: " + problem);
}

bool LiveSession::awaits_first_page() const {
  return audience_.joined() == 0 &&
         Clock::now() - begun_ < std::chrono::duration<double>(request_.patience);
}

bool LiveSession::plays() const { return !paused_ && !ended_ && subjects_.not_from_here().empty(); }

bool LiveSession::holds() const {
  return hold_step_ && !released_ && subjects_.run().world().state().step == *hold_step_;
}

LiveSession::Clock::time_point LiveSession::next_wake() const {
  const auto now = Clock::now();
  if (stepping_) return now;
  if (awaits_first_page()) return now + Pace::slice;
  if (!plays())
    return audience_.empty() ? now + Pace::idle : std::min(next_snapshot_, now + Pace::slice);
  if (pace_.requested() == 0.) return now;
  const double next = subjects_.run().world().state().time + subjects_.run().experiment().deltat;
  return std::min({pace_.when(next), next_snapshot_, now + Pace::slice});
}

void LiveSession::advance(Clock::time_point until) {
  const double deltat = subjects_.run().experiment().deltat;
  for (auto now = Clock::now();; now = Clock::now()) {
    const double time = subjects_.run().world().state().time;
    pace_.reach(now, time);
    if (holds()) {
      paused_ = true;
      next_snapshot_ = std::min(next_snapshot_, now);
      return;
    }
    if (pace_.requested() != 0. && time + 0.5 * deltat > pace_.due(now, time)) return;
    if (now >= until || !step()) return;
  }
}

void LiveSession::take_asked_steps(Clock::time_point until) {
  while (steps_left_ > 0 && !quit_ && Clock::now() < until)
    steps_left_ = step() ? steps_left_ - 1 : 0;
  if (steps_left_ > 0 && !quit_) return;
  audience_.answer(*stepping_);
  stepping_.reset();
  next_snapshot_ = std::min(next_snapshot_, Clock::now());
}

bool LiveSession::step() {
  simulation::LiveRun& run = subjects_.run();
  const std::int64_t before = run.world().state().step;
  if (last_step_ && before >= *last_step_) {
    end(fmt::format("the run has come to its end at {:.6g} s", run.world().state().time), false);
    return false;
  }
  StepStatus status = subjects_.step();
  if (status.ok() && !run.first_not_finite().empty())
    status = simulation::stopped_by_port(run.world().state().time, run.first_not_finite());
  if (!status.ok()) {
    end("the run stopped " + simulation::failure_text(status), true);
    return false;
  }
  if (run.take() != take_) {
    take_ = run.take();
    traces_.cut((static_cast<double>(before) + 0.5) * run.experiment().deltat);
    sampled_ = before;
  }
  quit_ = quit_ || run.world().quit();
  if (run.world().state().step == before) return false;
  sample();
  return true;
}

void LiveSession::sample() {
  const std::int64_t step = subjects_.run().world().state().step;
  if (step <= sampled_) return;
  sampled_ = step;
  const double time = subjects_.run().world().state().time;
  for (std::size_t i = 0; i < plotted_.size(); ++i)
    sample_[i] = plotted_[i] == nullptr ? std::numeric_limits<double>::quiet_NaN() : *plotted_[i];
  traces_.sample(time, sample_);
}

void LiveSession::end(const std::string& reason, bool failed) {
  ended_ = true;
  failed_ = failed_ || failed;
  subjects_.run().close();
  audience_.tell_notice(failed ? "error" : "note", reason);
}

/// Of a run that was changed the end is a change too: it repeats up to there.
void LiveSession::log_end() {
  simulation::LiveRun& run = subjects_.run();
  if (ended_ || run.changes().empty()) return;
  if (subjects_.past()) subjects_.seek(run.newest());
  if (!run.world().quit())
    subjects_.set(std::vector<simulation::PortValue>{{"Simulator.quit", 1.}});
}

void LiveSession::publish() {
  next_snapshot_ = std::max(next_snapshot_ + Pace::between_snapshots, Clock::now());
  tell_changes();
  // Messages wait for the first viewer.
  if (audience_.empty()) return;
  for (const Notice& notice : subjects_.take_notices())
    audience_.tell_notice(notice.level, notice.text);
  const simulation::WorldState& state = subjects_.run().world().state();
  const double deltat = subjects_.run().experiment().deltat;
  SessionState session;
  session.number = ++snapshots_;
  session.step = state.step;
  session.time = state.time;
  session.past = subjects_.past();
  session.paused =
      paused_ || !subjects_.run().world().running() || !subjects_.not_from_here().empty();
  session.ended = ended_;
  session.failed = failed_;
  session.speed_asked = pace_.requested();
  session.speed_reached = plays() ? pace_.reached() : 0.;
  session.history_first = static_cast<double>(subjects_.first_step()) * deltat;
  session.history_last = static_cast<double>(subjects_.run().newest()) * deltat;
  audience_.publish(session, subjects_.states());
}

void LiveSession::tell_changes() {
  const std::vector<simulation::Change>& changes = subjects_.run().changes();
  changes_told_ = std::min(changes_told_, changes.size());
  for (; changes_told_ < changes.size(); ++changes_told_) {
    const simulation::Change& change = changes[changes_told_];
    audience_.tell_changed(change.step, change.time, change.trail, change.value);
  }
}

void LiveSession::carry_out(const PageRequest& request) {
  std::visit(
      [&](const auto& command) {
        if constexpr (requires { perform(command); }) {
          const std::string problem = perform(command);
          problem.empty() ? audience_.answer(request) : audience_.refuse(request, problem);
        } else if constexpr (requires { reply(request, command); }) {
          reply(request, command);
        } else {
          audience_.refuse(request, "only a page that makes a film sends that");
        }
      },
      request.command);
  if (generation_ != subjects_.run().generation()) show();
  next_snapshot_ = std::min(next_snapshot_, Clock::now());
}

std::string LiveSession::perform(const SetPorts& command) {
  if (ended_) return reset_needed;
  std::vector<simulation::PortValue> values;
  const simulation::Experiment& experiment = subjects_.run().experiment();
  for (const auto& [trail, value] : command.values)
    values.push_back({held_by(experiment, trail), value});
  std::string problem = subjects_.set(values);
  quit_ = quit_ || subjects_.run().world().quit();
  return problem;
}

std::string LiveSession::perform(const Pause& /*command*/) {
  paused_ = true;
  return "";
}

std::string LiveSession::perform(const Run& /*command*/) {
  if (ended_) return reset_needed;
  if (std::string problem = subjects_.not_from_here(); !problem.empty()) return problem;
  paused_ = false;
  released_ = hold_step_ && subjects_.run().world().state().step == *hold_step_;
  pace_.restart();
  if (subjects_.run().world().running()) return "";
  // What the file's own button holds, a person lets go of as well.
  const simulation::Experiment& experiment = subjects_.run().experiment();
  const std::string running = experiment.world + ".running", holder = held_by(experiment, running);
  const std::string problem = subjects_.set(std::vector<simulation::PortValue>{{holder, 1.}});
  if (problem.empty() && subjects_.run().world().running()) return "";
  return fmt::format("{} is false: {} must release it{}", running,
                     holder == running ? "what drives it" : holder,
                     problem.empty() ? "" : " (" + problem + ")");
}

std::string LiveSession::perform(const SetSpeed& command) {
  pace_.ask(command.factor);
  return "";
}

std::string LiveSession::perform(const Seek& command) {
  const double deltat = subjects_.run().experiment().deltat;
  paused_ = true;
  released_ = false;
  pace_.restart();
  const double last = static_cast<double>(subjects_.run().newest()) * deltat;
  return subjects_.seek(simulation::step_count(std::clamp(command.time, 0., last), deltat));
}

std::string LiveSession::perform(const Reset& /*command*/) {
  if (std::string problem = subjects_.reset(); !problem.empty()) return problem;
  begin_again();
  return "";
}

/// A state that is set by hand is looked at before it moves.
std::string LiveSession::perform(const StartFrom& command) {
  std::vector<simulation::StartValue> values;
  for (const auto& [trail, numbers] : command.values) values.push_back({trail, numbers});
  if (std::string problem = subjects_.start_from(values); !problem.empty()) return problem;
  paused_ = true;
  begin_again();
  return "";
}

/// The run is at time 0 of a new take.
void LiveSession::begin_again() {
  ended_ = failed_ = released_ = false;
  pace_.restart();
  traces_.clear();
  sampled_ = -1;
  take_ = subjects_.run().take();
  show();
  sample();
}

std::string LiveSession::perform(const EditField& command) {
  if (ended_) return reset_needed;
  return subjects_.edit(command.trail, command.value);
}

std::string LiveSession::perform(const Quit& /*command*/) {
  quit_ = true;
  return "";
}

void LiveSession::reply(const PageRequest& request, const StepOn& command) {
  if (ended_) return audience_.refuse(request, reset_needed);
  if (const std::string problem = subjects_.not_from_here(); !problem.empty())
    return audience_.refuse(request, problem);
  paused_ = true;
  stepping_ = request;
  steps_left_ = command.count;
}

/// What no port has is not kept: it stays unknown.
void LiveSession::reply(const PageRequest& request, const AskTrace& command) {
  const std::vector<simulation::Port> ports = subjects_.ports();
  bool added = false;
  for (const std::string& trail : command.trails) {
    if (traces_.trails().size() >= Traces::most_columns) break;
    if (simulation::look_up_port(subjects_.run().experiment(), ports, trail))
      added = traces_.add(trail) || added;
  }
  if (added) look_up_plotted();
  const Traces::Extract extract =
      traces_.extract(command.trails, command.from, command.to, command.points);
  audience_.answer_trace(request, encode_trace(request.id, extract.times, extract.values));
}

void LiveSession::reply(const PageRequest& request, const ListFields& /*command*/) {
  audience_.answer(request, [&](JsonWriter& json) {
    json.key("fields").begin_array();
    for (const FileField& field : request_.fields())
      json.begin_object()
          .member("trail", field.trail)
          .member("value", field.value)
          .member("unit", field.unit)
          .member("doc", field.doc)
          .end_object();
    json.end_array();
  });
}

void LiveSession::reply(const PageRequest& request, const ListChanges& /*command*/) {
  audience_.answer(request, [&](JsonWriter& json) {
    json.key("changes").begin_array();
    for (const simulation::Change& change : subjects_.run().changes())
      json.begin_object()
          .member("step", change.step)
          .member("time", change.time)
          .member("trail", change.trail)
          .member("value", change.value)
          .end_object();
    json.end_array();
  });
}

void LiveSession::reply(const PageRequest& request, const AskPatch& /*command*/) {
  std::string problem;
  const auto file = request_.patch(subjects_.run(), problem);
  if (!file) return audience_.refuse(request, problem);
  audience_.answer(request, [&](JsonWriter& json) {
    json.member("name", file->first).member("text", file->second);
  });
}

void LiveSession::reply(const PageRequest& request, const AskUnstable& /*command*/) {
  marks_.request(request, subjects_.run().world().as_it_stands(), audience_);
}

void LiveSession::reply(const PageRequest& request, const KeepPicture& command) {
  keep_picture(request, command, subjects_.run().folder(), audience_);
}

}  // namespace hookpoint::view
