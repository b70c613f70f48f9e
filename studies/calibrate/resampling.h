// What data like these could have been as well: bootstrap samples of residuals, and the parts of a
// cross-validation. Seeded; knows residuals only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "studies/calibrate/least_squares.h"

namespace hookpoint::studies {

/// How often each of `count` things is drawn, as many draws as there are, with replacement.
std::vector<int> draw_with_replacement(std::size_t count, std::mt19937_64& random);

/// What is to be added to the residuals, wherever they are taken, for those at the optimum to be
/// drawn anew, within each curve of `sizes` samples: whole blocks of neighbours from anywhere in
/// it, around its end (Politis & Romano 1992), less their mean, times sqrt(n/(n - constants)) for
/// what the fit took of them.
Residuals shift_of_blocks(const Residuals& at_optimum, std::span<const std::size_t> sizes,
                          std::size_t block, std::size_t constants, std::mt19937_64& random);

/// Length of a block for these curves: the cube root of the longest one's length, and twice the lag
/// over which residuals hang together, within a quarter of the length.
std::size_t block_length(const Residuals& at_optimum, std::span<const std::size_t> sizes);

/// How many correlated residuals say as much as one independent one, mean over the curves of
/// `sizes` samples: 1 + 2 sum of the autocorrelations up to the lag at which chance explains them;
/// 1 of white noise, (1 + a)/(1 - a) of noise whose autocorrelation is a^lag.
double statistical_inefficiency(const Residuals& at_optimum, std::span<const std::size_t> sizes);

/// Which of `folds` parts each of `count` things is in, drawn by `seed`, as equally large as can
/// be.
std::vector<std::size_t> fold_of_each(std::size_t count, std::size_t folds, std::uint64_t seed);

/// The value below which a further draw falls with the chance `part`, by linear interpolation
/// between the values: of n drawn, the k-th from below at k/(n + 1). At most the outermost ones.
double quantile(std::vector<double> values, double part);

/// Student's t of `things` - 1 degrees of freedom, two at least, beyond which either way lies 2.5
/// %.
double student_end(double things);

/// The part of a bootstrap's samples that lies beyond either end of an interval of 95 %, where
/// `things` independent ones were drawn from: 2.5 % of many. Of few less, as they spread about
/// their own mean and Student's t is wider than the normal distribution: Phi(-t sqrt(m/(m - 1)))
/// with m - 1 degrees of freedom (the expanded percentile interval: Hesterberg, "What teachers
/// should know about the bootstrap", 2015).
double tail_of_interval(double things);

/// Correlation of two equally long rows; 0 where one of them does not change but by rounding.
double correlation(std::span<const double> one, std::span<const double> other);

}  // namespace hookpoint::studies
