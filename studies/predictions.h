// Closed forms set beside the measurements. They come from the experiment's constants alone, never
// from a run.
#pragma once

#include <optional>
#include <string_view>

#include "studies/metric.h"

namespace hookpoint::studies {

/// The closed form of `metric` for the run described by `context`, or nothing where there is none
/// (docs/studies.md lists them). They hold for one rigid body on a plane that starts at rest, or on
/// the level at a speed. `friction_mixing`: tangential speed per newton of a peer's sticking
/// contact [m/(N s)], where its constraints have one.
std::optional<double> predict(std::string_view metric, const RunContext& context,
                              std::optional<double> friction_mixing);

/// What friction does in the run described by `context`: none unless `predict`'s conditions hold
/// and the body starts at rest.
Regime regime_of(const RunContext& context);

}  // namespace hookpoint::studies
