// A live run and its viewers: it steps at the requested pace, sends them where everything is, and
// carries out their requests between two steps. No viewer is
// ever waited for.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/session/file_watch.h"
#include "apps/view/session/pace.h"
#include "apps/view/session/shown.h"
#include "apps/view/session/slider_marks.h"
#include "apps/view/session/subjects.h"
#include "apps/view/session/traces.h"
#include "apps/view/widgets/file_fields.h"
#include "apps/view/wire/audience.h"

namespace hookpoint::view {

struct LiveSessionRequest {
  std::function<Shown(Subjects&)> describe;
  std::function<std::vector<FileField>()> fields;
  /// A file that holds what was changed, its name and its text. Where there is none, `problem` says
  /// why.
  std::function<std::optional<std::pair<std::string, std::string>>(const simulation::LiveRun&,
                                                                   std::string& problem)>
      patch;
  /// Of the run as it now stands; none: until somebody ends it.
  std::function<std::optional<std::int64_t>(const simulation::LiveRun&)> last_step;
  /// Time to wait for the first browser before the simulation starts [s].
  double patience = 3.;
};

class LiveSession {
 public:
  /// All outlive it.
  LiveSession(Subjects& subjects, Audience& audience, LiveSessionRequest request);

  /// Until `stop`, or somebody quits. Whether every step could be taken.
  bool run(const std::atomic<bool>& stop);

 private:
  using Clock = Pace::Clock;

  void show();
  std::vector<simulation::Port> free_ports() const;
  void look_up_plotted();
  void answer_requests();
  void reload();
  bool awaits_first_page() const;
  bool plays() const;
  bool holds() const;
  void advance(Clock::time_point until);
  void take_asked_steps(Clock::time_point until);
  /// Whether a step was taken.
  bool step();
  void sample();
  void end(const std::string& reason, bool failed);
  void log_end();
  void begin_again();
  void publish();
  void tell_changes();
  Clock::time_point next_wake() const;

  void carry_out(const PageRequest& request);
  // "" or why not.
  std::string perform(const SetPorts& command);
  std::string perform(const Pause& command);
  std::string perform(const Run& command);
  std::string perform(const SetSpeed& command);
  std::string perform(const Seek& command);
  std::string perform(const Reset& command);
  std::string perform(const StartFrom& command);
  std::string perform(const EditField& command);
  std::string perform(const Quit& command);
  // What holds more than that, or takes longer.
  void reply(const PageRequest& request, const StepOn& command);
  void reply(const PageRequest& request, const AskTrace& command);
  void reply(const PageRequest& request, const ListFields& command);
  void reply(const PageRequest& request, const ListChanges& command);
  void reply(const PageRequest& request, const AskPatch& command);
  void reply(const PageRequest& request, const AskUnstable& command);
  void reply(const PageRequest& request, const KeepPicture& command);

  Subjects& subjects_;
  Audience& audience_;
  LiveSessionRequest request_;
  Pace pace_;
  Traces traces_;
  FileWatch files_;
  SliderMarks marks_;
  std::vector<const double*> plotted_;  ///< one a column of the traces; null: no port
  std::vector<double> sample_;
  std::optional<std::int64_t> last_step_;
  std::optional<std::int64_t> hold_step_;  ///< at which a run that plays waits, once
  bool released_ = false;                  ///< somebody has it go on from there
  std::uint64_t generation_ = 0, take_ = 0;
  std::size_t changes_told_ = 0;
  std::int64_t snapshots_ = 0, sampled_ = -1;  ///< how many; the last step in the traces
  std::optional<PageRequest> stepping_;        ///< a request whose steps are being taken
  std::int64_t steps_left_ = 0;                ///< of it
  Clock::time_point begun_;
  bool paused_ = false, ended_ = false, failed_ = false, quit_ = false;
  Clock::time_point next_snapshot_;
};

}  // namespace hookpoint::view
