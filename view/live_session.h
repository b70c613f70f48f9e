// A live run and those who look on and take part: it steps at the pace that is asked for, tells
// them where everything is, and carries out what they ask between two steps. Nobody who looks on is
// ever waited for.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/audience.h"
#include "view/file_fields.h"
#include "view/file_watch.h"
#include "view/pace.h"
#include "view/shown.h"
#include "view/subjects.h"
#include "view/traces.h"

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
  /// The first of those who look on is waited for so long before time begins [s].
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
  void look_up_plotted();
  void answer_requests();
  void reload();
  bool awaits_first_page() const;
  bool plays() const;
  void advance(Clock::time_point until);
  void take_asked_steps(Clock::time_point until);
  /// Whether a step was taken.
  bool step();
  void sample();
  void end(const std::string& reason, bool failed);
  void log_end();
  void publish();
  void tell_changes();
  Clock::time_point next_wake() const;

  void carry_out(const Asked& asked);
  // "" or why not.
  std::string perform(const SetPorts& command);
  std::string perform(const Pause& command);
  std::string perform(const Run& command);
  std::string perform(const SetSpeed& command);
  std::string perform(const Seek& command);
  std::string perform(const Reset& command);
  std::string perform(const EditField& command);
  std::string perform(const Quit& command);
  // What holds more than that, or takes longer.
  void reply(const Asked& asked, const StepOn& command);
  void reply(const Asked& asked, const AskTrace& command);
  void reply(const Asked& asked, const ListFields& command);
  void reply(const Asked& asked, const ListChanges& command);
  void reply(const Asked& asked, const AskPatch& command);
  void reply(const Asked& asked, const KeepPicture& command);

  Subjects& subjects_;
  Audience& audience_;
  LiveSessionRequest request_;
  Pace pace_;
  Traces traces_;
  FileWatch files_;
  std::vector<const double*> plotted_;  ///< one a column of the traces; null: no port
  std::vector<double> sample_;
  std::optional<std::int64_t> last_step_;
  std::uint64_t generation_ = 0, take_ = 0;
  std::size_t changes_told_ = 0;
  std::int64_t snapshots_ = 0, sampled_ = -1;  ///< how many; the last step in the traces
  std::optional<Asked> stepping_;              ///< a request whose steps are being taken
  std::int64_t steps_left_ = 0;                ///< of it
  Clock::time_point begun_;
  bool paused_ = false, ended_ = false, failed_ = false, quit_ = false;
  Clock::time_point next_snapshot_;
};

}  // namespace hookpoint::view
