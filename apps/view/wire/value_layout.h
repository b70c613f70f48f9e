// The values that snapshots carry beside poses and contacts: of which trails, and where they are read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/wiring/ports.h"

namespace hookpoint::view {

/// The port of a trail, none where the world has no such; its value is right from now on.
std::optional<simulation::Port> begin_port(const simulation::Experiment& experiment,
                                           const std::vector<simulation::Port>& ports,
                                           const std::string& trail);

class ValueLayout {
 public:
  /// From now on these trails, as a new layout; `ports`: all of the world, which live until the next call.
  void lay_out(std::vector<std::string> trails, const simulation::Experiment& experiment,
               const std::vector<simulation::Port>& ports);

  std::int64_t number() const { return number_; }
  /// Their values now, NaN of trails that are no ports. O(trails), allocates nothing.
  std::span<const double> read();
  /// The "layout" of docs/view_protocol.md.
  std::string text() const;

 private:
  std::int64_t number_ = 0;
  std::vector<std::string> trails_, units_;
  std::vector<const double*> sources_;  ///< null where no port has the trail
  std::vector<double> values_;
};

}  // namespace hookpoint::view
