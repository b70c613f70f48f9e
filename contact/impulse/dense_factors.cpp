#include "contact/impulse/dense_factors.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {

bool factorise_dense(std::span<double> J, std::span<std::size_t> pivot) {
  const std::size_t n = pivot.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t largest = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(J[i * n + k]) > std::abs(J[largest * n + k])) largest = i;
    double* const from = &J[k * n];
    pivot[k] = largest;
    if (largest != k) std::swap_ranges(from, from + n, &J[largest * n]);
    if (!(std::abs(from[k]) > 0.)) return false;
    for (std::size_t i = k + 1; i < n; ++i) {
      double* const to = &J[i * n];
      const double share = to[k] / from[k];
      to[k] = share;
      if (share == 0.) continue;
      for (std::size_t j = k + 1; j < n; ++j) to[j] -= share * from[j];
    }
  }
  return true;
}

void solve_dense(std::span<const double> factors, std::span<const std::size_t> pivot,
                 std::span<double> x) {
  const std::size_t n = pivot.size();
  for (std::size_t k = 0; k < n; ++k) std::swap(x[k], x[pivot[k]]);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = x[i];
    for (std::size_t j = 0; j < i; ++j) sum -= factors[i * n + j] * x[j];
    x[i] = sum;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = x[i];
    for (std::size_t j = i + 1; j < n; ++j) sum -= factors[i * n + j] * x[j];
    x[i] = sum / factors[i * n + i];
  }
}

}  // namespace hookpoint::contact
