#include "studies/tune/sensitivity.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <random>

#include "studies/tune/random_place.h"

namespace hookpoint::studies {
namespace {

using BoxPoint = std::vector<double>;

/// Points of the Sobol sequence, all shifted alike around the box (Cranley & Patterson 1976).
std::vector<BoxPoint> shifted_sequence(std::size_t count, std::size_t dimensions,
                                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  BoxPoint shift(dimensions);
  for (double& part : shift) part = random_place(random);
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

std::optional<SobolIndices> indices_of(const DesignValues& values, std::size_t constants,
                                       std::size_t samples) {
  SobolIndices indices{BoxPoint(constants), BoxPoint(constants), 0., 0};
  double sum = 0.;
  for (std::size_t j = 0; j < samples; ++j) {
    if (!values.complete(j)) continue;
    ++indices.used;
    sum += *values.at(j, 0) + *values.at(j, 1);
  }
  if (indices.used < least_samples) return std::nullopt;
  const auto used = static_cast<double>(indices.used);
  const double mean = sum / (2. * used);
  for (std::size_t j = 0; j < samples; ++j) {
    if (!values.complete(j)) continue;
    const double a = *values.at(j, 0), b = *values.at(j, 1);
    indices.variance += (a - mean) * (a - mean) + (b - mean) * (b - mean);
    for (std::size_t i = 0; i < constants; ++i) {
      const double mixed = *values.at(j, i + 2);
      indices.first[i] += (b - mixed) * (b - mixed);
      indices.total[i] += (a - mixed) * (a - mixed);
    }
  }
  indices.variance /= 2. * used - 1.;
  if (!(indices.variance > 0.)) return std::nullopt;
  for (std::size_t i = 0; i < constants; ++i) {
    indices.first[i] = 1. - indices.first[i] / (2. * used) / indices.variance;
    indices.total[i] = indices.total[i] / (2. * used) / indices.variance;
  }
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
    all.push_back(indices_of(DesignValues(found, constants, output), constants, samples));
  return all;
}

}  // namespace hookpoint::studies
