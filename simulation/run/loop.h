// The loop of a run: step after step, until its last step or until something ends it. The order of
// things within a step is World's (world.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// How a run came to stop.
struct RunEnd {
  enum class Reason {
    last_step,    ///< all of its steps were made
    by_itself,    ///< World::ended
    interrupted,  ///< whoever runs it wanted no further step
    failed        ///< a step could not be made, or what it left could not be used
  };
  Reason reason = Reason::last_step;
  std::string why = {};    ///< of a run that ended by itself
  StepStatus status = {};  ///< of one that failed
  bool complete() const { return reason == Reason::last_step; }
  bool interrupted() const { return reason == Reason::interrupted; }
  bool failed() const { return reason == Reason::failed; }
};

/// Time, body and advice of a failed step: "at 0.51 s (block.base): halve deltat".
std::string failure_text(const StepStatus& status);

/// Steps `run`, a World or what steps as one does, from where it is to step `last`. `before()` is
/// called before each step: false interrupts the run there. `after()` is called after each step
/// that was made: it returns nothing, or a status that ends the run unless it is ok. What holds at
/// the first instant is for the caller to look at. Allocates nothing while the run continues.
template <class Run, class Before, class After>
RunEnd run_until(Run& run, std::int64_t last, Before before, After after) {
  using Reason = RunEnd::Reason;
  while (run.state().step < last) {
    if (std::string why = run.ended(); !why.empty()) return {Reason::by_itself, std::move(why)};
    if (!before()) return {Reason::interrupted};
    if (StepStatus status = run.step(); !status.ok()) return {Reason::failed, {}, status};
    if constexpr (std::is_void_v<std::invoke_result_t<After>>) {
      after();
    } else {
      if (StepStatus status = after(); !status.ok()) return {Reason::failed, {}, status};
    }
  }
  return {};
}

}  // namespace hookpoint::simulation
