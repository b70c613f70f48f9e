#include "studies/calibrate/resampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "studies/results/statistics.h"
#include "studies/search/random_point.h"

namespace hookpoint::studies {
namespace {

/// Shorter curves say nothing of how their residuals are correlated.
constexpr std::size_t least_correlated = 8;

/// Sum of the products of residuals that are `lag` samples apart, each less their mean.
double autocovariance(std::span<const double> curve, std::size_t lag) {
  const double middle = mean(curve);
  double sum = 0.;
  for (std::size_t i = lag; i < curve.size(); ++i)
    sum += (curve[i] - middle) * (curve[i - lag] - middle);
  return sum;
}

/// The first lag at which the residuals of a curve are correlated no more than by chance
/// (2/sqrt(n)).
std::size_t decorrelation_lag(std::span<const double> curve) {
  const std::size_t count = curve.size();
  const double chance = 2. / std::sqrt(static_cast<double>(count)) * autocovariance(curve, 0);
  std::size_t lag = 1;
  while (lag < count && std::abs(autocovariance(curve, lag)) > chance) ++lag;
  return lag;
}

}  // namespace

Residuals shift_of_blocks(const Residuals& at_optimum, std::span<const std::size_t> sizes,
                          std::size_t block, std::size_t constants, std::mt19937_64& random) {
  Residuals shift(at_optimum.size());
  const auto all = static_cast<double>(at_optimum.size());
  const auto taken = static_cast<double>(constants);
  const double widened = all > taken ? std::sqrt(all / (all - taken)) : 1.;
  std::size_t first = 0;
  for (const std::size_t size : sizes) {
    const std::span<const double> curve(at_optimum.data() + first, size);
    const double middle = mean(curve);
    std::size_t from = 0;
    for (std::size_t i = 0; i < size; ++i, ++from) {
      if (i % block == 0) from = random_index(random, size);
      shift[first + i] = widened * (curve[from % size] - middle) - curve[i];
    }
    first += size;
  }
  return shift;
}

std::size_t block_length(const Residuals& at_optimum, std::span<const std::size_t> sizes) {
  std::size_t length = 1, first = 0;
  for (const std::size_t size : sizes) {
    const std::span<const double> curve(at_optimum.data() + first, size);
    first += size;
    if (size < least_correlated) continue;
    const auto root = static_cast<std::size_t>(std::cbrt(static_cast<double>(size)));
    length = std::max(length, std::min(std::max(root, 2 * decorrelation_lag(curve)), size / 4));
  }
  return length;
}

double statistical_inefficiency(const Residuals& at_optimum, std::span<const std::size_t> sizes) {
  double sum = 0., samples = 0.;
  std::size_t first = 0;
  for (const std::size_t size : sizes) {
    const std::span<const double> curve(at_optimum.data() + first, size);
    first += size;
    const auto count = static_cast<double>(size);
    double inefficiency = 1.;
    const double variance = autocovariance(curve, 0);
    if (size >= least_correlated && variance > 0.)
      for (std::size_t lag = 1, end = decorrelation_lag(curve); lag < end; ++lag)
        inefficiency += 2. * autocovariance(curve, lag) / variance;
    sum += count * std::clamp(inefficiency, 1., count);
    samples += count;
  }
  return samples > 0. ? sum / samples : 1.;
}

std::vector<std::size_t> fold_of_each(std::size_t count, std::size_t folds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::size_t> fold(count);
  for (std::size_t i = 0; i < count; ++i) fold[i] = i % folds;
  for (std::size_t i = count; i > 1; --i) std::swap(fold[i - 1], fold[random_index(random, i)]);
  return fold;
}

}  // namespace hookpoint::studies
