#include "studies/results/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace hookpoint::studies {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

double mean_by_fours(std::span<const double> values) {
  return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

double standard_error(std::span<const double> values) {
  if (values.size() < 2) return 0.;
  const double middle = mean(values), count = static_cast<double>(values.size());
  double squares = 0.;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / (count - 1.) / count);
}

double student_quantile(double count) {
  constexpr double upper = 0.975;  // half of the 5 % lie beyond either end
  const boost::math::students_t distribution(std::max(2., count) - 1.);
  return boost::math::quantile(distribution, upper);
}

std::optional<MeanInterval> mean_interval(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const double t = student_quantile(static_cast<double>(values.size()));
  return MeanInterval{mean(values), t * standard_error(values)};
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  const double place = std::clamp(part * (count + 1.) - 1., 0., count - 1.);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double correlation(std::span<const double> one, std::span<const double> other) {
  const double mean_one = mean(one), mean_other = mean(other);
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
  const auto changes = [&](double squares, double middle) {
    return std::sqrt(squares / count) > rounding * std::abs(middle);
  };
  if (!changes(first, mean_one) || !changes(second, mean_other)) return 0.;
  return both / std::sqrt(first * second);
}

}  // namespace hookpoint::studies
