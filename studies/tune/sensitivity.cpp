#include "studies/tune/sensitivity.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <random>

#include "studies/results/statistics.h"
#include "studies/search/bootstrap.h"
#include "studies/search/random_point.h"

namespace hookpoint::studies {
namespace {

using BoxPoint = std::vector<double>;

/// Points of the Sobol sequence, all shifted alike around the box (Cranley & Patterson 1976).
std::vector<BoxPoint> shifted_sequence(std::size_t count, std::size_t dimensions,
                                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  BoxPoint shift(dimensions);
  for (double& part : shift) part = random_point(random);
  boost::random::sobol sequence(dimensions);
  std::vector<BoxPoint> points(count, BoxPoint(dimensions));
  for (BoxPoint& point : points) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      const double place = static_cast<double>(sequence() >> 11) * 0x1p-53 + shift[d];
      point[d] = place - std::floor(place);
    }
  }
  return points;
}

/// The values of one output in the design: f(A), f(B) and f(A with column i of B), sample by
/// sample.
class DesignValues {
 public:
  DesignValues(const std::vector<std::vector<std::optional<double>>>& values, std::size_t constants,
               std::size_t output)
      : values_(values), block_(constants + 2), output_(output) {}

  std::optional<double> at(std::size_t sample, std::size_t member) const {
    return values_[sample * block_ + member][output_];
  }
  bool complete(std::size_t sample) const {
    for (std::size_t member = 0; member < block_; ++member)
      if (!at(sample, member)) return false;
    return true;
  }

 private:
  const std::vector<std::vector<std::optional<double>>>& values_;
  std::size_t block_, output_;
};

/// Fewer samples say nothing: the error of an index goes as one over their square root.
constexpr std::size_t least_samples = 16;

/// Resamples of the bootstrap.
constexpr std::size_t index_resamples = 1000;

/// What the estimators add up over the samples, one row a complete sample: f(A) + f(B) and
/// f(A)^2 + f(B)^2, both less the mean; the squared differences of the first-order indices, one a
/// constant; and those of the total-order ones.
class EstimatorTerms {
 public:
  EstimatorTerms(const DesignValues& values, std::size_t constants, std::size_t samples)
      : constants_(constants) {
    double sum = 0.;
    std::vector<std::size_t> complete;
    for (std::size_t j = 0; j < samples; ++j) {
      if (!values.complete(j)) continue;
      complete.push_back(j);
      sum += *values.at(j, 0) + *values.at(j, 1);
    }
    const double mean = sum / (2. * static_cast<double>(complete.size()));
    for (const std::size_t j : complete) {
      const double a = *values.at(j, 0), b = *values.at(j, 1);
      std::vector<double>& row = rows_.emplace_back(2 + 2 * constants);
      row[0] = (a - mean) + (b - mean);
      row[1] = (a - mean) * (a - mean) + (b - mean) * (b - mean);
      for (std::size_t i = 0; i < constants; ++i) {
        const double mixed = *values.at(j, i + 2);
        row[2 + i] = (b - mixed) * (b - mixed);
        row[2 + constants + i] = (a - mixed) * (a - mixed);
      }
    }
  }

  std::size_t samples() const { return rows_.size(); }

  /// The indices where each sample counts so often; nothing where the output does not vary.
  std::optional<SobolIndices> indices(const std::vector<int>& counts) const {
    std::vector<double> sums(2 + 2 * constants_);
    for (std::size_t j = 0; j < rows_.size(); ++j)
      for (std::size_t k = 0; k < sums.size() && counts[j] > 0; ++k)
        sums[k] += counts[j] * rows_[j][k];
    const double values = 2. * static_cast<double>(rows_.size());
    SobolIndices found{BoxPoint(constants_), BoxPoint(constants_), {}, {}, 0., rows_.size()};
    found.variance = (sums[1] - sums[0] * sums[0] / values) / (values - 1.);
    if (!(found.variance > 0.)) return std::nullopt;
    for (std::size_t i = 0; i < constants_; ++i) {
      found.first[i] = 1. - sums[2 + i] / values / found.variance;
      found.total[i] = sums[2 + constants_ + i] / values / found.variance;
    }
    return found;
  }

 private:
  std::size_t constants_;
  std::vector<std::vector<double>> rows_;
};

std::vector<IndexInterval> intervals_of(const std::vector<std::vector<double>>& resampled,
                                        double tail) {
  std::vector<IndexInterval> intervals;
  for (const std::vector<double>& values : resampled)
    intervals.push_back({quantile(values, tail), quantile(values, 1. - tail)});
  return intervals;
}

std::optional<SobolIndices> indices_of(const DesignValues& values, std::size_t constants,
                                       std::size_t samples, std::uint64_t seed) {
  const EstimatorTerms terms(values, constants, samples);
  if (terms.samples() < least_samples) return std::nullopt;
  auto indices = terms.indices(std::vector<int>(terms.samples(), 1));
  if (!indices) return std::nullopt;
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> first(constants), total(constants);
  for (std::size_t resample = 0; resample < index_resamples; ++resample) {
    const auto drawn = terms.indices(draw_with_replacement(terms.samples(), random));
    if (!drawn) continue;  // it drew none of the samples in which the output varies
    for (std::size_t i = 0; i < constants; ++i) {
      first[i].push_back(drawn->first[i]);
      total[i].push_back(drawn->total[i]);
    }
  }
  const double tail = tail_of_interval(static_cast<double>(terms.samples()));
  indices->first_interval = intervals_of(first, tail);
  indices->total_interval = intervals_of(total, tail);
  return indices;
}

}  // namespace

std::vector<std::optional<SobolIndices>> sobol_indices(std::size_t constants, std::size_t outputs,
                                                       std::size_t samples, std::uint64_t seed,
                                                       const BatchValues& values) {
  std::vector<BoxPoint> design;
  for (const BoxPoint& both : shifted_sequence(samples, 2 * constants, seed)) {
    const auto middle = both.begin() + static_cast<std::ptrdiff_t>(constants);
    const BoxPoint a(both.begin(), middle), b(middle, both.end());
    design.push_back(a);
    design.push_back(b);
    for (std::size_t i = 0; i < constants; ++i) {
      design.push_back(a);
      design.back()[i] = b[i];
    }
  }
  const auto found = values(design);
  std::vector<std::optional<SobolIndices>> all;
  for (std::size_t output = 0; output < outputs; ++output)
    all.push_back(indices_of(DesignValues(found, constants, output), constants, samples, seed));
  return all;
}

}  // namespace hookpoint::studies
