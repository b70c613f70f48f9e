// The root of an increasing function, for the closed forms that have no explicit solution.
#pragma once

namespace hookpoint {

/// Where `f`, negative at `low` and not at `high`, changes sign: to the last bit that bisection can
/// give.
template <class Function>
double bisect(Function f, double low, double high) {
  double middle = 0.5 * (low + high);
  while (middle > low && middle < high) {
    (f(middle) < 0. ? low : high) = middle;
    middle = 0.5 * (low + high);
  }
  return middle;
}

}  // namespace hookpoint
