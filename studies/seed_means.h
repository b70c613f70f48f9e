// Runs that differ in the seed alone as one: means with their intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "studies/result.h"

namespace hookpoint::studies {

/// A mean and how far the true one may lie from it.
struct MeanInterval {
  double mean = 0., half_width = 0.;
};

/// Mean m of n values and t s / sqrt(n): s their standard deviation with n - 1 in the denominator,
/// t the 97.5 % quantile of Student's distribution of n - 1 degrees of freedom. The true mean of
/// independent normal values lies within it with 95 %. Nothing below two values.
std::optional<MeanInterval> mean_interval(std::span<const double> values);

/// The rows as one: each metric the mean of theirs, where every one has a value, with its half
/// width; the closed form likewise; a verdict where all have the same. Its status is `ok` where all
/// are, else the first other one and how many rows have another. Curves are means at equal times,
/// where all have the same times.
RunResult mean_of_rows(const StudyResult& study, std::span<const std::size_t> rows);

/// The study with a row for each N of its rows that differ in the seed alone, and without the sweep
/// of seeds; `runs` points to `study`, which outlives it. A study of one seed is copied.
StudyResult over_seeds(const StudyResult& study);

/// "each run is the mean of 8, of seeds 1 to 8; ± is half its 95 % interval (Student's t)", of what
/// `over_seeds` gave.
std::string seeds_words(const StudyResult& means);

}  // namespace hookpoint::studies
