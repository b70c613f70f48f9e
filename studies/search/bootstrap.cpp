#include "studies/search/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/results/statistics.h"
#include "studies/search/random_point.h"

namespace hookpoint::studies {

std::vector<int> draw_with_replacement(std::size_t count, std::mt19937_64& random) {
  std::vector<int> drawn(count, 0);
  for (std::size_t i = 0; i < count; ++i) ++drawn[random_index(random, count)];
  return drawn;
}

double tail_of_interval(double things) {
  const double many = std::max(2., things);
  const double end = student_quantile(many) * std::sqrt(many / (many - 1.));
  return 0.5 * std::erfc(end / std::numbers::sqrt2);
}

}  // namespace hookpoint::studies
