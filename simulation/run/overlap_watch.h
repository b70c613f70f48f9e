// Bodies that pass through each other because nothing makes them touch: one warning a run, with what would
// make them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "simulation/dts_engine/memoryless_detection.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// Checks every `interval` which shapes overlap: bodies of different robots where the law knows the
/// ground alone, and bodies of one robot without self_contact that no joint joins and that did not
/// overlap at the start. Of engine dts; of others there is no warning. O(n log n) a check.
class OverlapWatch {
 public:
  static constexpr double interval = 0.1;  ///< [s]

  OverlapWatch(const Experiment& experiment, const World& world);

  /// After each step.
  void observe() {
    if (detection_ && world_.state().step % stride_ == 0) look();
  }

  /// "'a.base' and 'b.base' overlap by 0.012 m at 0.3 s, and nothing makes them touch: ...", or "".
  std::string finding() const;

 private:
  using Pair = std::pair<std::size_t, std::size_t>;  ///< of objects
  struct Overlap {
    double depth = 0.;  ///< the greatest [m]
    double since = 0.;  ///< [s]
  };
  void look();
  std::string name_of(std::size_t object) const;

  const Experiment& experiment_;
  const World& world_;
  bool others_touch_ = false;  ///< bodies of different robots do
  std::optional<MemorylessDetection> detection_;
  std::vector<std::size_t> first_bodies_;  ///< of each robot, in WorldState::bodies
  std::int64_t stride_ = 1;                ///< steps from one look to the next
  std::map<Pair, Overlap> overlaps_;
  bool started_ = false;
};

}  // namespace hookpoint::simulation
