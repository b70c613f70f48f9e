// What a window shows of the subjects that go side by side: the metrics of studies, one after each
// step, and their closed forms.
#pragma once

#include <memory>

#include "apps/view/session/meter.h"
#include "studies/measure/engine_table.h"

namespace hookpoint::application {

/// Null where nothing can be measured: no robot moves, or there is no ground. `engines` and
/// `experiment` outlive it. `behind`: what the run has added up before.
std::unique_ptr<view::Meter> make_meter(const simulation::Experiment& experiment,
                                        const studies::EngineTable& engines,
                                        const view::Tally& behind);

}  // namespace hookpoint::application
