// A run as another process can make it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>

#include "studies/plan/row_scene.h"
#include "studies/run/execute.h"

namespace hookpoint::studies {

struct RunRequest {
  std::string name;      ///< for messages
  std::string identity;  ///< run_identity: whoever makes the run finds the same
  RowScene scene;
  Measurement measurement;
};

/// Who makes runs elsewhere than in this process.
class RemoteRuns {
 public:
  virtual ~RemoteRuns() = default;
  using Request = std::function<RunRequest(std::size_t index)>;
  using Done = std::function<void(std::size_t index, RunRecord record)>;
  /// Makes `count` runs, those of one identity once, and hands each to `done` as it comes, one call
  /// at a time. False when `stop` was set meanwhile.
  virtual bool run(std::size_t count, const Request& request, const Done& done,
                   const std::atomic<bool>& stop) = 0;
};

}  // namespace hookpoint::studies
