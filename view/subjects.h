// The run that is watched and those that go beside it: the same experiment under another engine,
// law or integrator, stepped in lockstep, given what people do, and measured.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/run/live_run.h"
#include "view/history.h"
#include "view/snapshot.h"

namespace hookpoint::view {

/// What is measured of a subject, beside what closed forms say; NaN where there is none.
struct Reading {
  double displacement, displacement_predicted;  ///< of the feet since the start, downhill [m]
  double slip, slip_predicted;                  ///< way of the boundary points on the ground [m]
  double penetration, penetration_predicted;    ///< mean of the points that touch [m]
  double load, load_predicted;                  ///< of the ground, along its normal [N]
};

/// Measures a run; the same code for every engine.
class Meter {
 public:
  virtual ~Meter() = default;
  /// Called once for the first instant and once after each step.
  virtual void observe(const simulation::WorldState& state) = 0;
  virtual Reading read() const = 0;
};
using MakeMeter = std::function<std::unique_ptr<Meter>(const simulation::Experiment&)>;

struct Subject {
  std::string name;    ///< "hookpoint", "mujoco recommended"
  std::string colour;  ///< "#0072B2"
  std::unique_ptr<simulation::LiveRun> run;
  History history;
  /// None where nothing can be measured: no robot moves, no ground.
  std::unique_ptr<Meter> meter;
  Reading reading{};
  std::vector<simulation::ContactView> contacts{};
  std::string stopped{};  ///< why it goes no further, "" while it does
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
  /// For snapshots, at the present instant. Valid until the next call.
  std::span<const SubjectState> states();
  /// What those who look on should know, each once.
  std::vector<std::string> take_notices();

 private:
  void begin();
  void begin_measuring(Subject& subject);
  void observe();
  void measure(Subject& subject);
  void keep();
  void follow_takes();
  bool shown(const Subject& subject) const;

  std::vector<Subject> subjects_;
  MakeMeter make_meter_;
  std::vector<SubjectState> states_;
  std::vector<std::string> notices_;
  std::size_t told_ = 0;  ///< notices of the run itself
  std::uint64_t take_ = 0;
};

}  // namespace hookpoint::view
