#include "apps/view/session/subjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "simulation/analysis/step_warning.h"
#include "simulation/run/loop.h"
#include "simulation/run/shown_scene.h"

namespace hookpoint::view {
namespace {

using simulation::Port;
using simulation::StepStatus;

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();
constexpr Reading nothing{not_measured, not_measured, not_measured, not_measured,
                          not_measured, not_measured, not_measured, not_measured};

struct Measured {
  const char* name;
  const char* unit;
  double Reading::*value;
};
constexpr Measured measured[] = {{"displacement", "m", &Reading::displacement},
                                 {"displacement_predicted", "m", &Reading::displacement_predicted},
                                 {"slip", "m", &Reading::slip},
                                 {"slip_predicted", "m", &Reading::slip_predicted},
                                 {"penetration", "m", &Reading::penetration},
                                 {"penetration_predicted", "m", &Reading::penetration_predicted},
                                 {"load", "N", &Reading::load},
                                 {"load_predicted", "N", &Reading::load_predicted}};

}  // namespace

Subjects::Subjects(std::vector<Subject> subjects, MakeMeter make)
    : subjects_(std::move(subjects)), make_meter_(std::move(make)) {
  begin();
}

/// Of runs that stand at a new beginning.
void Subjects::begin() {
  for (Subject& subject : subjects_) {
    subject.stopped.clear();
    subject.step_warning.clear();
    subject.history.clear();
    begin_measuring(subject, {});
  }
  take_ = run().take();
  told_ = 0;
  warn_of_steps();
  keep();
}

/// Again after a change, which may have made the ground stiffer; the same warning only once.
void Subjects::warn_of_steps() {
  for (Subject& subject : subjects_) {
    const std::string warning =
        simulation::step_warning(subject.run->experiment()).value_or(std::string());
    if (warning == subject.step_warning) continue;
    subject.step_warning = warning;
    if (warning.empty()) continue;
    const bool alone = subjects_.size() == 1;
    notices_.push_back({"warning", alone ? warning : subject.name + ": " + warning});
  }
}

void Subjects::add_note(std::string text) { notices_.push_back({"note", std::move(text)}); }

/// From the present instant on; again whenever the run's world is another one.
void Subjects::begin_measuring(Subject& subject, const Tally& behind) {
  if (!make_meter_) return;
  subject.run->world().publish_contact_forces();
  subject.meter = make_meter_(subject.run->experiment(), behind);
  if (subject.meter) subject.meter->observe(subject.run->world().state());
  read(subject);
}

/// Of one that cannot be shown there is nothing to read.
void Subjects::read(Subject& subject) {
  subject.reading = subject.meter && shown(subject) ? subject.meter->read() : nothing;
}

void Subjects::keep() {
  for (Subject& subject : subjects_) {
    if (subject.run->no_history().empty() && subject.history.due(subject.run->world().state().step))
      subject.history.keep(*subject.run, subject.meter ? subject.meter->tally() : Tally{});
  }
}

void Subjects::observe() {
  for (Subject& subject : subjects_) {
    if (!subject.meter) continue;
    if (shown(subject)) subject.meter->observe(subject.run->world().state());
    read(subject);
  }
}

/// Moments of a future that was given up are none of this run.
void Subjects::follow_takes() {
  if (run().take() == take_) return;
  take_ = run().take();
  for (Subject& subject : subjects_) subject.history.cut(run().world().state().step);
}

StepStatus Subjects::step() {
  const StepStatus status = run().step();
  if (!status.ok()) return status;
  follow_takes();
  for (Subject& subject : std::span(subjects_).subspan(1)) {
    if (!subject.stopped.empty()) continue;
    const StepStatus own = subject.run->step();
    if (own.ok()) continue;
    subject.stopped = subject.name + " stopped " + simulation::failure_text(own);
    add_note(subject.stopped);
  }
  observe();
  keep();
  return status;
}

std::string Subjects::set(std::span<const simulation::PortValue> values) {
  if (std::string problem = not_from_here(); !problem.empty()) return problem;
  if (std::string problem = run().set(values); !problem.empty()) return problem;
  follow_takes();
  // A port that only the run itself has is nothing to the others.
  for (Subject& subject : std::span(subjects_).subspan(1)) subject.run->set(values);
  return "";
}

std::string Subjects::edit(const std::string& trail, const std::string& value) {
  if (std::string problem = not_from_here(); !problem.empty()) return problem;
  if (std::string problem = run().edit(trail, value); !problem.empty()) return problem;
  follow_takes();
  for (Subject& subject : std::span(subjects_).subspan(1)) {
    if (std::string problem = subject.run->edit(trail, value); !problem.empty())
      add_note(fmt::format("{} continues without the change: {}", subject.name, problem));
  }
  for (Subject& subject : subjects_)
    begin_measuring(subject, subject.meter ? subject.meter->tally_before_change() : Tally{});
  warn_of_steps();
  return "";
}

std::string Subjects::reset() {
  if (std::string problem = run().reset(); !problem.empty()) return problem;
  for (Subject& subject : std::span(subjects_).subspan(1)) {
    if (std::string problem = subject.run->reset(); !problem.empty())
      add_note(fmt::format("{}: {}", subject.name, problem));
  }
  begin();
  return "";
}

std::string Subjects::start_from(std::span<const simulation::StartValue> values) {
  if (std::string problem = run().start_from(values); !problem.empty()) return problem;
  const std::vector<simulation::StartValue>& all = run().starts();
  std::vector<std::string> stopped(subjects_.size());
  for (std::size_t i = 1; i < subjects_.size(); ++i) stopped[i] = subjects_[i].run->start_from(all);
  begin();
  for (std::size_t i = 1; i < subjects_.size(); ++i) {
    if (stopped[i].empty()) continue;
    subjects_[i].stopped = subjects_[i].name + " cannot start from there: " + stopped[i];
    add_note(subjects_[i].stopped);
  }
  return "";
}

std::string Subjects::seek(std::int64_t step) {
  if (const std::string why = run().no_history(); !why.empty()) return why;
  step = std::clamp(step, first_step(), run().newest());
  for (Subject& subject : subjects_) {
    if (!subject.run->no_history().empty() || !subject.stopped.empty()) continue;
    const History::Kept* from = subject.history.before(step);
    if (from == nullptr) return "that moment is no longer in the history";
    std::optional<std::uint64_t> measured;  // the world that the meter is of
    const auto measure = [&] {
      const std::uint64_t generation = subject.run->generation();
      if (!measured)
        begin_measuring(subject, from->tally);
      else if (*measured != generation)
        begin_measuring(subject, subject.meter ? subject.meter->tally_before_change() : Tally{});
      else if (subject.meter)
        subject.meter->observe(subject.run->world().state());
      measured = generation;
    };
    if (std::string problem = subject.run->seek(from->moment, step, measure); !problem.empty())
      return problem;
  }
  for (Subject& subject : subjects_) read(subject);
  return "";
}

std::string Subjects::not_from_here() const {
  if (!past()) return "";
  for (const Subject& subject : subjects_) {
    if (const std::string why = subject.run->no_history(); !why.empty())
      return fmt::format("{} cannot go on from a past moment ({}); go to the newest, or reset",
                         subject.name, why);
  }
  return "";
}

std::int64_t Subjects::first_step() const {
  const History& history = subjects_.front().history;
  if (history.empty()) return run().world().state().step;
  // A step leads to what is shown, but to the beginning.
  return history.first() == 0 ? 0 : history.first() + 1;
}

std::vector<Port> Subjects::ports() {
  std::vector<Port> ports = run().world().ports();
  if (!make_meter_) return ports;
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    for (const Measured& each : measured) {
      Port port;
      port.trail = fmt::format("Subjects[{}].{}", i, each.name);
      port.unit = each.unit;
      port.value = &(subjects_[i].reading.*each.value);
      port.doc = "of " + subjects_[i].name;
      ports.push_back(std::move(port));
    }
  }
  return ports;
}

std::vector<std::string> Subjects::displacements() const {
  std::vector<std::string> trails;
  if (!make_meter_) return trails;
  for (std::size_t i = 0; i < subjects_.size(); ++i)
    for (const char* name : {"displacement", "displacement_predicted"})
      trails.push_back(fmt::format("Subjects[{}].{}", i, name));
  return trails;
}

bool Subjects::shown(const Subject& subject) const {
  return subject.stopped.empty() && (!past() || subject.run->no_history().empty());
}

std::span<const SubjectState> Subjects::states() {
  states_.clear();
  for (Subject& subject : subjects_) {
    const simulation::World& world = subject.run->world();
    world.tell_contacts(subject.contacts);
    simulation::shown_poses(subject.run->experiment(), world, subject.poses);
    states_.push_back({shown(subject), subject.poses, subject.contacts});
  }
  return states_;
}

std::vector<Notice> Subjects::take_notices() {
  const std::vector<std::string>& said = run().world().state().notices;
  for (told_ = std::min(told_, said.size()); told_ < said.size(); ++told_) add_note(said[told_]);
  return std::exchange(notices_, {});
}

}  // namespace hookpoint::view
