// Whether what a component says of itself by linearise() is what its updates do.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/component_bench.h"

namespace hookpoint::testing {

/// Gives the component and each way of its linear form the same samples, about a rest of 0, and
/// returns the greatest difference of outputs over the greatest output. Inputs are driven as they
/// are; a first update at 0 lets what takes two samples begin.
inline double linear_form_error(ComponentBench& bench, double period, int updates = 200) {
  control::Component& component = bench.component();
  const std::vector<control::LinearFeedback> ways = component.linearise();
  EXPECT_FALSE(ways.empty());
  std::vector<std::vector<double>> memories;
  for (const control::LinearFeedback& way : ways)
    memories.emplace_back(control::memory_size(way.gains), 0.);
  double error = 0., greatest = 0.;
  for (int k = 0; k < updates; ++k) {
    const auto sample = [&](std::size_t way, double phase) {
      return k == 0 ? 0. : 1e-3 * std::sin(0.37 * k + static_cast<double>(way) + phase);
    };
    for (std::size_t i = 0; i < ways.size(); ++i) {
      component.values()[ways[i].input] = sample(i, 0.);
      if (ways[i].rate) component.values()[*ways[i].rate] = sample(i, 1.) / period;
    }
    bench.tick();
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const double said = control::feedback(ways[i].gains, sample(i, 0.), sample(i, 1.) / period,
                                            period, memories[i]);
      const double done = component.values()[ways[i].output];
      error = std::max(error, std::abs(done - said));
      greatest = std::max(greatest, std::abs(done));
    }
  }
  EXPECT_GT(greatest, 0.);
  return error / greatest;
}

}  // namespace hookpoint::testing
