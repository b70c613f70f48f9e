#include "contact/impulse/nonnegative_minimum.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {
namespace {

// Share of the mean diagonal that draws x to the last pass's: a pass leaves its share of what is missing,
// and rounding moves redundant unknowns by 1e-16 over it.
constexpr double drawn_share = 1e-6;
constexpr int drawn_passes = 5;
constexpr double gradient_rounding = 1e-12;  // of the largest |b|: below, no unknown is freed

}  // namespace

NonnegativeMinimum::NonnegativeMinimum(std::size_t most)
    : L_(most * most), feasible_(most), trial_(most), y_(most), near_(most), is_free_(most) {
  free_.reserve(most);
}

// trial_: the minimum over the free unknowns, the others 0, by Cholesky's factors.
void NonnegativeMinimum::solve_free(std::span<const double> A, std::size_t stride,
                                    std::span<const double> b, std::span<const double> near,
                                    double nearness) {
  free_.clear();
  for (std::size_t i = 0; i < b.size(); ++i)
    if (is_free_[i]) free_.push_back(i);
  const std::size_t n = free_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = A[free_[i] * stride + free_[j]] + (i == j ? nearness : 0.);
      for (std::size_t k = 0; k < j; ++k) sum -= L_[i * n + k] * L_[j * n + k];
      L_[i * n + j] = i == j ? std::sqrt(std::max(sum, 0.1 * nearness)) : sum / L_[j * n + j];
    }
    double sum = nearness * near[free_[i]] - b[free_[i]];
    for (std::size_t k = 0; k < i; ++k) sum -= L_[i * n + k] * y_[k];
    y_[i] = sum / L_[i * n + i];
  }
  std::fill(trial_.begin(), trial_.end(), 0.);
  for (std::size_t i = n; i-- > 0;) {
    double sum = y_[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= L_[k * n + i] * trial_[free_[k]];
    trial_[free_[i]] = sum / L_[i * n + i];
  }
}

void NonnegativeMinimum::find(std::span<const double> A, std::size_t stride,
                              std::span<const double> b, std::span<double> x) {
  const std::size_t n = b.size();
  double trace = 0., largest = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    trace += A[i * stride + i];
    largest = std::max(largest, std::abs(b[i]));
  }
  const double nearness = drawn_share * trace / static_cast<double>(n);
  std::fill(is_free_.begin(), is_free_.end(), char{1});
  std::fill(feasible_.begin(), feasible_.end(), 0.);
  const std::span<double> near = std::span(near_).first(n);
  std::fill(near.begin(), near.end(), 0.);
  for (int pass = 0; pass < drawn_passes; ++pass) {
    // Each round frees one unknown and lowers the value, so that no set of free ones comes twice.
    for (std::size_t round = 0; round < 3 * n + 3; ++round) {
      while (true) {
        solve_free(A, stride, b, near, nearness);
        double share = 1.;
        for (const std::size_t i : free_)
          if (trial_[i] <= 0.) share = std::min(share, feasible_[i] / (feasible_[i] - trial_[i]));
        if (share >= 1.) break;
        for (const std::size_t i : free_) {
          feasible_[i] += share * (trial_[i] - feasible_[i]);
          if (trial_[i] <= 0. && feasible_[i] <= 1e-14 * std::abs(trial_[i])) {
            feasible_[i] = 0.;
            is_free_[i] = 0;
          }
        }
      }
      for (std::size_t i = 0; i < n; ++i) feasible_[i] = trial_[i];
      double steepest = -gradient_rounding * largest;
      std::size_t next = n;
      for (std::size_t i = 0; i < n; ++i) {
        if (is_free_[i]) continue;
        double gradient = b[i] + nearness * (feasible_[i] - near[i]);
        for (std::size_t j = 0; j < n; ++j) gradient += A[i * stride + j] * feasible_[j];
        if (gradient < steepest) {
          steepest = gradient;
          next = i;
        }
      }
      if (next == n) break;
      is_free_[next] = 1;
    }
    std::copy_n(feasible_.begin(), n, near.begin());
  }
  std::copy_n(feasible_.begin(), n, x.begin());
}

}  // namespace hookpoint::contact
