// The bootstrap: draws with replacement, and the tail of the intervals from such draws.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace hookpoint::studies {

/// How often each of `count` things is drawn, as many draws as there are, with replacement.
std::vector<int> draw_with_replacement(std::size_t count, std::mt19937_64& random);

/// The part of a bootstrap's samples that lies beyond either end of an interval of 95 %, where
/// `things` independent ones were drawn from: 2.5 % of many. Of few less, as they spread about
/// their own mean and Student's t is wider than the normal distribution: Phi(-t sqrt(m/(m - 1)))
/// with m - 1 degrees of freedom (the expanded percentile interval: Hesterberg, "What teachers
/// should know about the bootstrap", 2015).
double tail_of_interval(double things);

}  // namespace hookpoint::studies
