// What a page needs at an instant, as one binary message: doubles, little-endian, in the order of
// docs/view_protocol.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::view {

/// How the session stands.
struct SessionState {
  std::int64_t layout = 0;  ///< of the values
  std::int64_t number = 0;  ///< of the snapshot
  std::int64_t step = 0;
  double time = 0.;  ///< [s]
  bool paused = false, past = false, ended = false, failed = false;
  double speed_asked = 1.;                       ///< 0: as fast as possible
  double speed_reached = 0.;                     ///< simulated over elapsed time
  double history_first = 0., history_last = 0.;  ///< [s]
};

/// One of the worlds that are shown: the run itself, or one beside it.
struct SubjectState {
  bool fine = true;                         ///< false once it has stopped by itself
  std::span<const simulation::Pose> poses;  ///< of simulation::shown_frames
  std::span<const simulation::ContactView> contacts;
};

/// O(values + poses + contacts).
std::shared_ptr<const std::string> encode_snapshot(const SessionState& state,
                                                   std::span<const double> values,
                                                   std::span<const SubjectState> subjects);

/// The answer to a request for a trace: instants, then the values of each trail at them.
std::string encode_trace(std::int64_t request, std::span<const double> times,
                         std::span<const std::vector<double>> values);

}  // namespace hookpoint::view
