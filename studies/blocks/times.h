// How long the runs of a Study or a Tune last, and from when on they are measured.
#pragma once

#include <optional>
#include <string>

#include "studies/blocks/block.h"

namespace hookpoint::studies {

struct TimesBlock {
  Placed<double> duration;
  Placed<double> settle = 0.;
  Placed<double> quick_duration, quick_settle;

  /// The field that says how long a run lasts, under --quick where `quick`.
  const Placed<double>& said_duration(bool quick) const {
    return quick && quick_duration ? quick_duration : duration;
  }
};
/// With what `duration` and `settle` mean there.
Fields<TimesBlock> times_fields(std::string duration, std::string settle);

struct RunTimes {
  double settle = 0.;              ///< [s]
  std::optional<double> duration;  ///< [s]; nothing: none is said
};

/// Under --quick a fifth, unless the block says otherwise. `otherwise`: the duration of a block
/// that says none; where that is nothing, a run lasts as it was measured, and is never cut short.
RunTimes load_times(const TimesBlock& block, bool quick, std::optional<double> otherwise = {});

}  // namespace hookpoint::studies
