// What data like these could have been as well: bootstrap samples of residuals, and the parts of a
// cross-validation. Seeded; knows residuals only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "studies/calibrate/least_squares.h"
#include "studies/search/bootstrap.h"

namespace hookpoint::studies {

/// What is to be added to the residuals, wherever they are taken, for those at the optimum to be
/// drawn again, within each curve of `sizes` samples: whole blocks of neighbours from anywhere in
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

}  // namespace hookpoint::studies
