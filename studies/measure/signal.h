// Quantities that a Plot draws over time.
#pragma once

#include <span>
#include <string_view>

#include "studies/measure/observer.h"

namespace hookpoint::studies {

/// A quantity that a Plot may draw over time.
struct SignalDefinition {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  double (*value)(const RunContext&, const Observation&);
  bool since_settle = false;  ///< value and time are counted from `settle`
  bool needs_points = false;  ///< reads Observation::points
};
std::span<const SignalDefinition> signal_table();
const SignalDefinition* find_signal(std::string_view name);

}  // namespace hookpoint::studies
