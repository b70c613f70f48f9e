// Runs that differ in the seed alone as one: means with their intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

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
