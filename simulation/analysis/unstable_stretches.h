// Where along the range of a controller's value the step is above the largest stable one.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// From `least` to `greatest`, in the unit of the value.
struct Stretch {
  double least = 0., greatest = 0.;
};

/// A value of a component, such as "pd1.dconstant", and the range in which a user may move it.
struct MovedValue {
  std::string trail;
  Stretch range;
  bool logarithmic = false;  ///< equal ways are equal factors; the range is then above 0
};

/// The stretches of `moved.range` in which the loops of controllers make `experiment.deltat`
/// unstable that would be stable without them, all other values as the experiment has them. None
/// where the value changes no gain of such a loop, and where the step is unstable by itself.
///
/// The range is sampled at 17 places, equal ways apart, and each change between two of them is
/// bisected to 1/2048 of the way: a stretch between two samples is not seen. Costs a
/// stability_bound a place; stops early, with what was found, once `stop` is true.
std::vector<Stretch> unstable_stretches(const Experiment& experiment, const MovedValue& moved,
                                        const std::atomic<bool>& stop);

}  // namespace hookpoint::simulation
