// Statistics of a sample: mean, standard error, Student's t, interval, quantile, correlation.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace hookpoint::studies {

/// Arithmetic mean of one value or more, summed from the first to the last.
double mean(std::span<const double> values);

/// Mean, summed in the order of std::reduce (four at a time): the fits of `method = cmaes` depend
/// on these bits.
double mean_by_fours(std::span<const double> values);

/// Standard deviation over sqrt(n), with n - 1 in the denominator; 0 below two values.
double standard_error(std::span<const double> values);

/// 97.5 % quantile of Student's t distribution with `count` - 1 degrees of freedom, at least 1:
/// half of the two-sided 95 % interval of a mean of `count` values, in standard errors.
double student_quantile(double count);

/// A mean and the half-width of its interval.
struct MeanInterval {
  double mean = 0., half_width = 0.;
};
/// Mean and half of its 95 % interval by Student's t. The true mean of independent normal values
/// lies within it with 95 %. Nothing below two values.
std::optional<MeanInterval> mean_interval(std::span<const double> values);

/// Value below which a further draw falls with the chance `part`, by linear interpolation between
/// the values: of n drawn, the k-th from below at k/(n + 1). At most the outermost ones.
double quantile(std::vector<double> values, double part);

/// Correlation of two equally long rows; 0 where one of them does not change but by rounding.
double correlation(std::span<const double> one, std::span<const double> other);

}  // namespace hookpoint::studies
