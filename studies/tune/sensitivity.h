// Which constants matter: variance-based indices of any function over the unit box.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hookpoint::studies {

/// Points of the unit box in; of each, one value an output, or nothing where there is none.
using BatchValues = std::function<std::vector<std::vector<std::optional<double>>>(
    std::span<const std::vector<double>> points)>;

/// A 95 % confidence interval.
struct IndexInterval {
  double low = 0., high = 0.;
};

/// Sobol's indices of one output, one a constant.
struct SobolIndices {
  std::vector<double> first;  ///< part of the variance that the constant alone explains
  std::vector<double> total;  ///< part that is left unless the constant is known
  std::vector<IndexInterval> first_interval, total_interval;
  double variance = 0.;
  std::size_t used = 0;  ///< samples in it: those of which all values are there
};

/// `samples` (constants + 2) points in one batch: Saltelli's design of a Sobol sequence in twice as
/// many dimensions as constants, shifted by a random vector from `seed`; Jansen's estimators
/// (Saltelli et al. 2010, Comput. Phys. Commun. 181, table 2, rows (c) and (f)). Intervals are
/// those of a bootstrap over the samples, seeded by `seed` (Archer, Saltelli & Sobol 1997, J. Stat.
/// Comput. Simul. 58; expanded percentiles as of tail_of_interval). A Sobol sequence fills the box
/// more evenly than the independent points that a bootstrap assumes: the intervals are wide rather
/// than narrow. A sample of which a value is missing is left out. An output with fewer than 16
/// samples, or that never changes, has no indices.
std::vector<std::optional<SobolIndices>> sobol_indices(std::size_t constants, std::size_t outputs,
                                                       std::size_t samples, std::uint64_t seed,
                                                       const BatchValues& values);

}  // namespace hookpoint::studies
