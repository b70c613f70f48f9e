#include "studies/calibrate/resampling.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "studies/tune/random_place.h"

namespace hookpoint::studies {
namespace {

std::size_t draw(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>(random_place(random) * static_cast<double>(count));
}

double mean_of_part(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

/// Shorter curves say nothing of how their residuals are correlated.
constexpr std::size_t least_correlated = 8;

/// Sum of the products of residuals that are `lag` samples apart, each less their mean.
double autocovariance(std::span<const double> curve, std::size_t lag) {
  const double mean = mean_of_part(curve);
  double sum = 0.;
  for (std::size_t i = lag; i < curve.size(); ++i)
    sum += (curve[i] - mean) * (curve[i - lag] - mean);
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

std::vector<int> draw_with_replacement(std::size_t count, std::mt19937_64& random) {
  std::vector<int> drawn(count, 0);
  for (std::size_t i = 0; i < count; ++i) ++drawn[draw(random, count)];
  return drawn;
}

Residuals shift_of_blocks(const Residuals& at_optimum, std::span<const std::size_t> sizes,
                          std::size_t block, std::size_t constants, std::mt19937_64& random) {
  Residuals shift(at_optimum.size());
  const auto all = static_cast<double>(at_optimum.size());
  const auto taken = static_cast<double>(constants);
  const double widened = all > taken ? std::sqrt(all / (all - taken)) : 1.;
  std::size_t first = 0;
  for (const std::size_t size : sizes) {
    const std::span<const double> curve(at_optimum.data() + first, size);
    const double mean = mean_of_part(curve);
    std::size_t from = 0;
    for (std::size_t i = 0; i < size; ++i, ++from) {
      if (i % block == 0) from = draw(random, size);
      shift[first + i] = widened * (curve[from % size] - mean) - curve[i];
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
  for (std::size_t i = count; i > 1; --i) std::swap(fold[i - 1], fold[draw(random, i)]);
  return fold;
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  const double place = std::clamp(part * (count + 1.) - 1., 0., count - 1.);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double student_end(double things) {
  constexpr double upper = 0.975;
  const boost::math::students_t_distribution<double> student(std::max(2., things) - 1.);
  return boost::math::quantile(student, upper);
}

double tail_of_interval(double things) {
  const double many = std::max(2., things);
  const double end = student_end(many) * std::sqrt(many / (many - 1.));
  return 0.5 * std::erfc(end / std::numbers::sqrt2);
}

double correlation(std::span<const double> one, std::span<const double> other) {
  const double mean_one = mean_of_part(one), mean_other = mean_of_part(other);
  double both = 0., first = 0., second = 0.;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double a = one[i] - mean_one, b = other[i] - mean_other;
    both += a * b;
    first += a * a;
    second += b * b;
  }
  // A row that changes by rounding alone does not change.
  constexpr double rounding = 1e-12;
  const double count = static_cast<double>(one.size());
  const auto changes = [&](double squares, double mean) {
    return std::sqrt(squares / count) > rounding * std::abs(mean);
  };
  if (!changes(first, mean_one) || !changes(second, mean_other)) return 0.;
  return both / std::sqrt(first * second);
}

}  // namespace hookpoint::studies
