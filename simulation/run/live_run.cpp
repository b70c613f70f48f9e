#include "simulation/run/live_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "simulation/engine_interface/step_count.h"
#include "simulation/run/loop.h"
#include "text/number.h"

namespace hookpoint::simulation {

struct LiveRun::Track {
  Track(Loaded from, std::vector<std::string> with, std::span<const StartValue> starts)
      : loaded(std::move(from)),
        overrides(std::move(with)),
        world(loaded->experiment, loaded->make_engine(loaded->experiment)) {
    if (!starts.empty()) {
      started = simulation::started(loaded->experiment, world, starts);
      world.restart(*started);
      changes = starts.size();
    }
    for (const Port& port : world.settable()) {
      inputs.emplace(port.trail, *port.value);
      if (is_momentary(port.trail)) buttons.push_back(port);
    }
    try {
      size = world.state_size();
    } catch (const ExperimentError& error) {
      no_history = error.what();
    }
  }
  bool is_momentary(const std::string& trail) const {
    if (!loaded->experiment.values) return false;
    return std::ranges::any_of(*loaded->experiment.values, [&](const ValueSpec& value) {
      return value.momentary && value.trail == trail;
    });
  }
  const Experiment& experiment() const { return started ? *started : loaded->experiment; }
  std::int64_t step() const { return world.state().step; }

  Loaded loaded;
  std::vector<std::string> overrides;
  World world;
  std::optional<Experiment> started;  ///< what it starts from, where that is not the file's
  std::unordered_map<std::string, double> inputs;  ///< what may be set, as the file gives it
  std::vector<Port> buttons;                       ///< that come up by themselves
  std::size_t size = 0;                            ///< of its state
  std::string no_history;                          ///< why it cannot be saved, "" if it can
  std::size_t changes = 0;                         ///< how many of the log's were made
};

namespace {

/// A line of a file takes no other's place.
std::string problem_of_text(const std::string& trail, const std::string& value) {
  const auto breaks = [](const std::string& text) {
    return text.find_first_of("\r\n") != std::string::npos;
  };
  if (trail.empty()) return "the trail of a field is missing";
  if (trail.find('=') != std::string::npos) return "a trail has no `=` in it: " + trail;
  if (value.empty()) return fmt::format("`{}` takes a value", trail);
  return breaks(trail) || breaks(value) ? "a change is one line" : "";
}

bool is_of_window(const std::string& trail) { return trail.starts_with("Simulator."); }

std::string difference(const std::vector<StateSection>& before,
                       const std::vector<StateSection>& after) {
  for (const StateSection& section : before) {
    const auto same = std::ranges::find(after, section.name, &StateSection::name);
    if (same == after.end()) return fmt::format("it has no `{}` any more", section.name);
    if (same->layout != section.layout)
      return fmt::format("`{}` would be {} instead of {}", section.name, same->layout,
                         section.layout);
  }
  for (const StateSection& section : after) {
    if (std::ranges::find(before, section.name, &StateSection::name) == before.end())
      return fmt::format("`{}` is new in it", section.name);
  }
  return "its parts are in another order";
}

/// Why the numbers of the one world mean nothing in the other, "" if they do.
std::string why_not_alike(const World& before, const World& after, const Experiment& was,
                          const Experiment& is) {
  if (was.deltat != is.deltat)
    return fmt::format("the step would be {} s instead of {} s", text::rounded(is.deltat, 6),
                       text::rounded(was.deltat, 6));
  if (was.contact != is.contact)
    return fmt::format("what points on the ground remember under {} means nothing under {}",
                       was.contact, is.contact);
  const auto old_layout = before.state_layout(), new_layout = after.state_layout();
  return layout_text(old_layout) == layout_text(new_layout) ? ""
                                                            : difference(old_layout, new_layout);
}

/// A step of another length is another moment.
void check_times(const std::vector<Change>& script, double deltat) {
  for (std::size_t i = 0; i < script.size(); ++i) {
    const double time = static_cast<double>(script[i].step) * deltat;
    if (std::abs(time - script[i].time) <= 1e-3 * deltat + 1e-12 * time) continue;
    throw ChangesError(fmt::format(
        "line {}: step {} is at {} s here, not at {} s: the file is of a run with another deltat",
        line_of_change(i), script[i].step, text::rounded(time, 9),
        text::rounded(script[i].time, 9)));
  }
}

}  // namespace

LiveRun::LiveRun(Load load, LiveRunRequest request, std::vector<Change> script)
    : load_(std::move(load)), request_(std::move(request)), script_(std::move(script)) {
  for (; scripted_ < script_.size(); ++scripted_) {
    std::optional<StartValue> start = start_value_of(script_[scripted_]);
    if (!start) break;
    starts_.push_back(std::move(*start));
  }
  track_ = make_track({});
  check_times(script_, experiment().deltat);
  files_ = open_files(*track_);
  begin_take();
  if (start_.ok()) make_scripted_changes();
}

LiveRun::~LiveRun() = default;

const Experiment& LiveRun::experiment() const { return track_->experiment(); }
World& LiveRun::world() { return track_->world; }
const World& LiveRun::world() const { return track_->world; }
const std::vector<std::string>& LiveRun::overrides() const { return track_->overrides; }

std::int64_t LiveRun::last_step() const {
  return step_count(experiment().duration, experiment().deltat);
}

std::vector<std::string> LiveRun::names() const {
  std::vector<std::string> names = files_->names();
  if (!request_.folder.empty() && !log_.changes().empty()) names.emplace_back(ChangeLog::file_name);
  return names;
}

// Experiments and their worlds.

/// What ran once runs the same again, whatever has become of the file: a take is repeated by it.
LiveRun::Loaded LiveRun::loaded(const std::vector<std::string>& overrides, std::string& problem) {
  for (const auto& [key, experiment] : loaded_)
    if (key == overrides) return experiment;
  std::optional<LoadedExperiment> experiment = load_(overrides, problem);
  if (!experiment) return nullptr;
  loaded_.emplace_back(overrides, std::make_shared<const LoadedExperiment>(std::move(*experiment)));
  return loaded_.back().second;
}

std::unique_ptr<LiveRun::Track> LiveRun::make_track(const std::vector<std::string>& overrides) {
  std::string problem;
  Loaded from = loaded(overrides, problem);
  if (!from) throw ExperimentError(problem);
  return std::make_unique<Track>(std::move(from), overrides, starts_);
}

/// The world of `track` under an override more, where its numbers stand; none where that cannot be.
std::unique_ptr<LiveRun::Track> LiveRun::edited(Track& track, const std::string& trail,
                                                const std::string& value, std::string& problem) {
  std::vector<std::string> overrides = track.overrides;
  std::erase_if(overrides, [&](const std::string& text) { return text.starts_with(trail + "="); });
  overrides.push_back(trail + "=" + value);
  try {
    // An engine that cannot be saved says so before anything is loaded.
    std::vector<double> numbers(track.world.state_size());
    Loaded from = loaded(overrides, problem);
    if (!from) return nullptr;
    auto next = std::make_unique<Track>(std::move(from), std::move(overrides), starts_);
    const std::string why =
        why_not_alike(track.world, next->world, track.experiment(), next->experiment());
    if (!why.empty()) {
      problem = fmt::format(
          "`{}` cannot become {} while the run continues: {}. A reset takes it, once it stands in "
          "the file",
          trail, value, why);
      return nullptr;
    }
    track.world.save(numbers);
    next->world.restore(numbers);
    // A number that was restored and that the file gives otherwise is as the file has it.
    for (const Port& port : next->world.settable()) {
      const auto before = track.inputs.find(port.trail);
      const double after = next->inputs.at(port.trail);
      if (before != track.inputs.end() && (before->second != after || port.trail == trail))
        next->world.set(port, after);
    }
    next->changes = track.changes;
    return next;
  } catch (const ExperimentError& error) {
    problem = error.what();
    return nullptr;
  }
}

void LiveRun::use(std::unique_ptr<Track> track) {
  if (writes()) files_->rebind(track->experiment(), track->world, track->world.ports());
  track_ = std::move(track);
  ++generation_;
}

// A take: rows from time 0 on, and the changes that led to them.

RunFilesRequest LiveRun::files_of(const LoadedExperiment& loaded) const {
  return {request_.folder, request_.trails, loaded.text, request_.leaves_files,
          loaded.engine,   loaded.sources,  true};
}

std::unique_ptr<RunFiles> LiveRun::open_files(Track& track) const {
  return std::make_unique<RunFiles>(track.experiment(), track.world, track.world.ports(),
                                    files_of(*track.loaded));
}

void LiveRun::begin_take() {
  closed_ = false;
  log_.truncate(0);
  log_ = ChangeLog(request_.folder.empty() ? std::filesystem::path()
                                           : request_.folder / ChangeLog::file_name);
  edits_.clear();
  newest_ = 0;
  last_ = {};
  start_ = {};
  std::vector<Change> changes;
  for (const StartValue& value : starts_) changes.push_back(change_of(value));
  log(changes);
  const std::string& trail = files_->first_not_finite();
  if (trail.empty())
    files_->row(0, track_->world.state().time);
  else
    start_ = stopped_by_port(0., trail);
}

StepStatus LiveRun::step() {
  if (!start_.ok()) return start_;
  if (track_->changes < log_.changes().size()) give_up_future();
  const std::int64_t before = present();
  if (writes() && before == newest_) files_->go_on();
  const StepStatus status = world().step();
  if (!status.ok()) return status;
  if (present() == before) return {};
  if (present() > newest_) {
    if (writes()) {
      if (const std::string& trail = files_->first_not_finite(); !trail.empty())
        return stopped_by_port(world().state().time, trail);
      files_->row(present(), world().state().time);
    }
    newest_ = present();
  }
  make_scripted_changes();
  release_buttons();
  return {};
}

std::string LiveRun::set(std::span<const PortValue> values) {
  std::vector<Port> ports;
  try {
    ports = world().settable(values);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  prepare_change();
  std::vector<Change> changes;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    world().set(ports[i], values[i].value);
    changes.push_back(
        {present(), world().state().time, ports[i].trail, text::shortest(values[i].value)});
  }
  log(changes);
  return "";
}

std::string LiveRun::edit(const std::string& trail, const std::string& value) {
  if (std::string problem = problem_of_text(trail, value); !problem.empty()) return problem;
  const std::optional<double> number = plain_number(value);
  if (number && world().input(trail)) return set(std::vector<PortValue>{{trail, *number}});
  std::string problem;
  std::unique_ptr<Track> next = edited(*track_, trail, value, problem);
  if (!next) return problem;
  prepare_change();
  try {
    use(std::move(next));
  } catch (const ExperimentError& error) {
    return error.what();
  }
  edits_.push_back(log_.changes().size());
  log(std::vector<Change>{{present(), world().state().time, trail, value}});
  return "";
}

std::string LiveRun::reset() {
  std::string problem;
  std::optional<LoadedExperiment> fresh = load_({}, problem);
  if (!fresh) return problem;
  const auto from = std::make_shared<const LoadedExperiment>(std::move(*fresh));
  std::unique_ptr<Track> track;
  try {
    track = std::make_unique<Track>(from, std::vector<std::string>(), std::span<StartValue>());
    check_run_files(from->experiment, track->world.ports(), files_of(*from));
  } catch (const ExperimentError& error) {
    return error.what();
  }
  loaded_.assign(1, {{}, from});
  starts_.clear();
  begin_take(std::move(track));
  return "";
}

std::string LiveRun::start_from(std::span<const StartValue> values) {
  const std::vector<std::string> overrides = track_->overrides;
  std::vector<PortValue> inputs;
  std::vector<StartValue> starts = present_pose(track_->loaded->experiment, world().state());
  starts = merged(std::move(starts), values);
  std::swap(starts_, starts);
  std::unique_ptr<Track> track;
  try {
    track = make_track({});
  } catch (const ExperimentError& error) {
    starts_ = std::move(starts);
    return error.what();
  }
  // What the window itself holds, a pull, is not of the run. A port of the engine hides one of the file.
  std::set<std::string> seen;
  for (const Port& port : world().settable()) {
    const auto own = track_->inputs.find(port.trail);
    const bool is_own = seen.insert(port.trail).second && !is_of_window(port.trail);
    if (is_own && own != track_->inputs.end() && own->second != *port.value)
      inputs.push_back({port.trail, *port.value});
  }
  begin_take(std::move(track));
  for (const std::string& setting : overrides) {
    const std::size_t end = setting.find('=');
    if (std::string problem = edit(setting.substr(0, end), setting.substr(end + 1));
        !problem.empty())
      return problem;
  }
  return inputs.empty() ? "" : set(inputs);
}

/// Of a world at its beginning, in the place of the present one.
void LiveRun::begin_take(std::unique_ptr<Track> track) {
  files_.reset();
  rewriting_.reset();
  files_ = open_files(*track);
  track_ = std::move(track);
  script_.clear();
  scripted_ = 0;
  ++generation_;
  ++take_;
  begin_take();
}

void LiveRun::prepare_change() {
  if (track_->changes < log_.changes().size() || present() < newest_) give_up_future();
  if (writes()) files_->before_change();
}

void LiveRun::log(std::span<const Change> changes) {
  log_.add(changes);
  track_->changes = log_.changes().size();
}

void LiveRun::make_scripted_changes() {
  for (; scripted_ < script_.size() && script_[scripted_].step == present(); ++scripted_) {
    const Change& change = script_[scripted_];
    if (start_value_of(change))
      throw ChangesError(fmt::format("line {}: what a run starts from stands before other changes",
                                     line_of_change(scripted_)));
    if (const std::string problem = edit(change.trail, change.value); !problem.empty())
      throw ChangesError(fmt::format("line {}: {}", line_of_change(scripted_), problem));
  }
}

/// A press is over once whoever listens has heard it.
void LiveRun::release_buttons() {
  for (std::size_t i = 0; i < track_->buttons.size(); ++i) {
    const Port& button = track_->buttons[i];
    if (*button.value == 0.) continue;
    const auto& changes = log_.changes();
    const auto pressed = std::find_if(changes.rbegin(), changes.rend(), [&](const Change& change) {
      return change.trail == button.trail;
    });
    if (pressed == changes.rend() || !world().sampled_after(pressed->step, button)) continue;
    set(std::vector<PortValue>{{button.trail, 0.}});
  }
}

// Back to a past moment, and on from there.

const std::string& LiveRun::no_history() const { return track_->no_history; }

void LiveRun::save(Moment& moment) const {
  moment.step = present();
  moment.changes = track_->changes;
  if (!no_history().empty()) throw ExperimentError(no_history());
  moment.numbers.resize(track_->size);
  world().save(moment.numbers);
}

std::vector<std::string> LiveRun::overrides_at(std::size_t changes) const {
  std::vector<std::string> overrides;
  for (const std::size_t edit : edits_) {
    if (edit >= changes) break;
    const Change& change = log_.changes()[edit];
    std::erase_if(overrides,
                  [&](const std::string& text) { return text.starts_with(change.trail + "="); });
    overrides.push_back(change.trail + "=" + change.value);
  }
  return overrides;
}

void LiveRun::restore(const Moment& moment) {
  const std::vector<std::string> overrides = overrides_at(moment.changes);
  if (overrides != track_->overrides) use(make_track(overrides));
  world().restore(moment.numbers);
  track_->changes = moment.changes;
}

std::string LiveRun::seek(const Moment& from, std::int64_t step,
                          const std::function<void()>& at_each) {
  if (step < from.step || step > newest_)
    return fmt::format("step {} is not between {} and {}", step, from.step, newest_);
  try {
    if (present() == newest_ && track_->changes == log_.changes().size()) save(last_);
    restore(from);
    at_each();
    std::size_t until = track_->changes;
    while (until < log_.changes().size() && (step == newest_ || log_.changes()[until].step < step))
      ++until;
    repeat(track_, step, until, nullptr, at_each);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

/// The next change of the log, again.
void LiveRun::repeat_change(std::unique_ptr<Track>& track, RunFiles* files) {
  const std::size_t index = track->changes;
  const Change& change = log_.changes()[index];
  if (files != nullptr) files->before_change();
  if (std::ranges::binary_search(edits_, index)) {
    std::string problem;
    std::unique_ptr<Track> next = edited(*track, change.trail, change.value, problem);
    if (!next) throw ExperimentError(problem);
    next->changes = index + 1;
    if (track == track_) return use(std::move(next));
    if (files != nullptr) files->rebind(next->experiment(), next->world, next->world.ports());
    track = std::move(next);
  } else {
    const PortValue value{change.trail, *plain_number(change.value)};
    track->world.set(track->world.settable(std::span(&value, 1)).front(), value.value);
  }
  track->changes = index + 1;
}

/// Goes on to `step`, the first `changes` of the log made in their time.
void LiveRun::repeat(std::unique_ptr<Track>& track, std::int64_t step, std::size_t changes,
                     RunFiles* files, const std::function<void()>& at_each) {
  for (;;) {
    while (track->changes < changes && log_.changes()[track->changes].step == track->step()) {
      repeat_change(track, files);
      at_each();
    }
    if (track->step() == step) return;
    const bool changes_follow = track->changes < changes;
    const std::int64_t next = changes_follow ? log_.changes()[track->changes].step : step;
    const auto before = [&] {
      if (files != nullptr) files->go_on();
      return true;
    };
    const auto after = [&] {
      if (files != nullptr) files->row(track->step(), track->world.state().time);
      at_each();
    };
    if (!run_until(track->world, std::min(next, step), before, after).complete())
      throw ExperimentError(
          fmt::format("the run cannot be repeated from step {} on", track->step()));
  }
}

/// What followed the present moment is no longer of the run. Files that have it are emptied now and
/// written when the run is over: until then the changes tell all.
void LiveRun::give_up_future() {
  const bool out_of_date = present() < newest_ || track_->changes < log_.changes().size();
  newest_ = present();
  last_ = {};
  ++take_;
  std::erase_if(edits_, [this](std::size_t edit) { return edit >= track_->changes; });
  if (out_of_date && writes() && files_->has_rows()) {
    files_.reset();
    rewriting_ = make_track({});
    files_ = open_files(*rewriting_);
  }
  log_.truncate(track_->changes);
}

void LiveRun::close() {
  if (closed_) return;
  closed_ = true;
  if (rewriting_) {
    files_->row(0, rewriting_->world.state().time);
    repeat(rewriting_, newest_, log_.changes().size(), files_.get());
  } else if (!last_.numbers.empty() && present() < newest_) {
    restore(last_);
  }
  files_->close();
}

void LiveRun::close_within_step() {
  if (!rewriting_) files_->close_within_step();
}

}  // namespace hookpoint::simulation
