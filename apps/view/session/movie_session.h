// A movie and its viewers: it shows its frames, goes along them at the pace that is requested
// for, and brings what is plotted. Nobody can change anything.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/view/session/movie_traces.h"
#include "apps/view/session/pace.h"
#include "apps/view/session/reel.h"
#include "apps/view/session/shown.h"
#include "apps/view/wire/audience.h"

namespace hookpoint::view {

struct MovieSessionRequest {
  /// Of a world with these ports.
  std::function<Shown(const std::vector<simulation::Port>&)> describe;
  std::filesystem::path folder;  ///< of pictures
};

class MovieSession {
 public:
  /// All outlive it. Throws output::MovieError, simulation::ExperimentError.
  MovieSession(const ShownMovie& movie, Audience& audience, MovieSessionRequest request);

  /// Until `stop`, or somebody quits. Throws output::MovieError when no step leads on.
  void run(const std::atomic<bool>& stop);

 private:
  using Clock = Reel::Clock;
  struct WaitingTrace {
    PageRequest request;
    AskTrace trace;
    Clock::time_point until;  ///< then it is answered with what is known
  };

  void show();
  void advance(Clock::time_point until);
  void answer_arrived();
  void answer_traces();
  void publish();
  void tell_differences();
  void tell_progress();
  Clock::time_point next_wake() const;
  double time_of(std::int64_t step) const;
  void want(const std::vector<std::string>& trails);

  void carry_out(const PageRequest& request);
  void carry_out(const PageRequest& request, const Pause& command);
  void carry_out(const PageRequest& request, const Run& command);
  void carry_out(const PageRequest& request, const StepOn& command);
  void carry_out(const PageRequest& request, const SetSpeed& command);
  void carry_out(const PageRequest& request, const Seek& command);
  void carry_out(const PageRequest& request, const Reset& command);
  void carry_out(const PageRequest& request, const AskTrace& command);
  void carry_out(const PageRequest& request, const ListFields& command);
  void carry_out(const PageRequest& request, const ListChanges& command);
  void carry_out(const PageRequest& request, const KeepPicture& command);
  void carry_out(const PageRequest& request, const Quit& command);
  /// Answered once `step` is shown.
  void go_to(const PageRequest& request, std::int64_t step);

  const ShownMovie movie_;
  Audience& audience_;
  MovieSessionRequest request_;
  Reel reel_;
  MovieTraces traces_;
  Pace pace_;
  std::vector<PageRequest> travelling_;  ///< those to be answered on arrival
  std::vector<WaitingTrace> waiting_;
  std::uint64_t generation_ = 0;
  std::int64_t snapshots_ = 0;
  bool paused_ = true, quit_ = false, difference_told_ = false, reading_told_ = false;
  Clock::time_point next_snapshot_, next_progress_;
};

}  // namespace hookpoint::view
