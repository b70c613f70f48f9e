#include "studies/calibrate/criterion.h"

#include <algorithm>
#include <cmath>

#include "studies/results/statistics.h"

namespace hookpoint::studies {

Excess excess_of_squares(const Residuals& at_optimum, std::size_t constants, double worth) {
  const auto count = static_cast<double>(at_optimum.size());
  const auto fitted = static_cast<double>(constants);
  const double least = sum_of_squares(at_optimum);
  const double t = student_quantile(count / worth - fitted + 1.);
  const double variance = worth * least / std::max(1., count - fitted);
  const double margin = std::max(variance * t * t, count * equal_errors * equal_errors);
  return [=](const Residuals& residuals) { return (sum_of_squares(residuals) - least) / margin; };
}

namespace {

/// (m / (t/2 e))^2 with the sign of m, of a mean and the sum of squares of the scores.
double excess_of_mean(const PairedThings& things, double middle, double squares, double count) {
  const double error =
      std::sqrt(things.worth * squares / std::max(1., count - 1.) / std::max(1., count));
  const double margin = std::max(0.5 * student_quantile(things.count) * error, things.equal);
  const double ratio = middle / margin;
  return std::copysign(ratio * ratio, ratio);
}

std::vector<double> differences(const PairedThings& things, const std::vector<double>& parts) {
  std::vector<double> more(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) more[i] = parts[i] - things.at_optimum[i];
  return more;
}

/// Limits the largest to twice the second largest.
void limit_largest(std::vector<double>& more) {
  if (more.size() < 2) return;
  std::vector<double> sizes;
  for (const double one : more) sizes.push_back(std::abs(one));
  std::ranges::nth_element(sizes, sizes.end() - 2);
  const double most = 2. * *(sizes.end() - 2);
  for (double& one : more) one = std::clamp(one, -most, most);
}

}  // namespace

double paired_excess(const PairedThings& things, const std::vector<double>& parts) {
  std::vector<double> more = differences(things, parts);
  if (things.limits_largest) limit_largest(more);
  const double middle = mean(more);
  double squares = 0.;
  for (const double one : more) squares += (one - middle) * (one - middle);
  return excess_of_mean(things, middle, squares, static_cast<double>(more.size()));
}

double paired_excess(const PairedThings& things, const std::vector<double>& parts,
                     const std::vector<double>& scores) {
  return excess_of_mean(things, mean(differences(things, parts)), sum_of_squares(scores),
                        static_cast<double>(scores.size()));
}

}  // namespace hookpoint::studies
