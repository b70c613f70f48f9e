#include "studies/tune/bootstrap.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>

#include "studies/tune/random_place.h"

namespace hookpoint::studies {

std::vector<int> draw_with_replacement(std::size_t count, std::mt19937_64& random) {
  std::vector<int> drawn(count, 0);
  for (std::size_t i = 0; i < count; ++i) ++drawn[random_index(random, count)];
  return drawn;
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

}  // namespace hookpoint::studies
