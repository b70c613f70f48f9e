// The run that is watched and those that go beside it: the same experiment under another engine,
// law or integrator, stepped in lockstep, given what users do, and measured.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/view/session/history.h"
#include "apps/view/session/meter.h"
#include "apps/view/wire/snapshot.h"
#include "simulation/run/live_run.h"

namespace hookpoint::view {

struct Subject {
  std::string name;    ///< "hookpoint", "mujoco recommended"
  std::string colour;  ///< "#0072B2"
  std::unique_ptr<simulation::LiveRun> run;
  History history;
  /// None where nothing can be measured: no robot moves, no ground.
  std::unique_ptr<Meter> meter;
  Reading reading{};
  std::vector<simulation::Pose> poses{};
  std::vector<simulation::ContactView> contacts{};
  std::string stopped{};  ///< why it goes no further, "" while it does
  /// Warning of its step, "" where that is stable; the viewers have been sent it.
  std::string step_warning{};
};

/// A message for the viewers.
struct Notice {
  std::string_view level;  ///< "note" or "warning"
  std::string text;
};

class Subjects {
 public:
  /// At least one: the run itself. `make`: their meters.
  Subjects(std::vector<Subject> subjects, MakeMeter make);

  simulation::LiveRun& run() { return *subjects_.front().run; }
  const simulation::LiveRun& run() const { return *subjects_.front().run; }
  std::span<const Subject> all() const { return subjects_; }

  /// All by one step. The status of the run itself; one beside it that fails stops, and
  /// `take_notices` tells.
  simulation::StepStatus step();
  /// "" or what is wrong; then nothing has changed.
  std::string set(std::span<const simulation::PortValue> values);
  std::string edit(const std::string& trail, const std::string& value);
  std::string reset();
  /// All from the same pose (LiveRun::start_from); one beside the run that cannot, stops there.
  std::string start_from(std::span<const simulation::StartValue> values);
  /// Shows `step`, which the history still has; those beside it that cannot go back are left out
  /// until all are back at the newest. "" or what is wrong.
  std::string seek(std::int64_t step);
  /// Why a run that shows a past moment cannot go on from there, "" if it can.
  std::string not_from_here() const;
  bool past() const { return run().world().state().step < run().newest(); }
  /// The first step to which one can go back; the present one where there is no history.
  std::int64_t first_step() const;

  /// `Subjects[i].displacement` and so on, and every port of the run. They live until its
  /// generation grows.
  std::vector<simulation::Port> ports();
  /// Of those ports the trails that are drawn over time: displacements and what is predicted for
  /// them.
  std::vector<std::string> displacements() const;
  /// For snapshots, at the present instant. Valid until the next call.
  std::span<const SubjectState> states();
  /// Messages for the viewers since the last call.
  std::vector<Notice> take_notices();

 private:
  void begin();
  void begin_measuring(Subject& subject, const Tally& behind);
  void observe();
  void read(Subject& subject);
  void keep();
  void follow_takes();
  void warn_of_steps();
  void add_note(std::string text);
  bool shown(const Subject& subject) const;

  std::vector<Subject> subjects_;
  MakeMeter make_meter_;
  std::vector<SubjectState> states_;
  std::vector<Notice> notices_;
  std::size_t told_ = 0;  ///< notices of the run itself
  std::uint64_t take_ = 0;
};

}  // namespace hookpoint::view
