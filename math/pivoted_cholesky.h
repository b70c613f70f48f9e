// A x = b for a symmetric matrix that is positive semidefinite: where rows of A follow from others, a
// solution of those that do not.
#pragma once

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace hookpoint {

/// Cholesky's factors with the largest remaining pivot first (Golub & Van Loan 2013, section 4.2.8).
class PivotedCholesky {
 public:
  /// For matrices of `size` rows. Allocates; nothing else does.
  explicit PivotedCholesky(std::size_t size) : n_(size), L_(size * size), order_(size), y_(size) {}

  /// Row by row, to be filled before `factor`, which overwrites it.
  double& operator()(std::size_t row, std::size_t column) { return L_[row * n_ + column]; }

  /// Pivots below `tolerance` times the largest count as zero. Returns the rank. O(n rank^2).
  std::size_t factor(double tolerance) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    double least = 0.;
    for (rank_ = 0; rank_ < n_; ++rank_) {
      const std::size_t k = rank_;
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n_; ++i)
        if ((*this)(i, i) > (*this)(pivot, pivot)) pivot = i;
      if (k == 0) least = tolerance * (*this)(pivot, pivot);
      if (!((*this)(pivot, pivot) > least)) break;
      exchange(k, pivot);
      const double root = std::sqrt((*this)(k, k));
      (*this)(k, k) = root;
      for (std::size_t i = k + 1; i < n_; ++i) (*this)(i, k) /= root;
      for (std::size_t i = k + 1; i < n_; ++i)
        for (std::size_t j = k + 1; j <= i; ++j) (*this)(i, j) -= (*this)(i, k) * (*this)(j, k);
    }
    return rank_;
  }

  /// The least pivot that counted as one, as a share of the largest: 1/condition number, as far as the
  /// pivots show it.
  double least_pivot() const {
    if (rank_ == 0) return 1.;
    const double share = L_[(rank_ - 1) * (n_ + 1)] / L_[0];
    return share * share;
  }

  /// With `b` in the order of the rows; x of rows that follow from others is 0. O(rank^2).
  void solve(std::span<const double> b, std::span<double> x) {
    for (std::size_t i = 0; i < rank_; ++i) {
      y_[i] = b[order_[i]];
      for (std::size_t j = 0; j < i; ++j) y_[i] -= (*this)(i, j) * y_[j];
      y_[i] /= (*this)(i, i);
    }
    for (double& value : x) value = 0.;
    for (std::size_t i = rank_; i-- > 0;) {
      for (std::size_t j = i + 1; j < rank_; ++j) y_[i] -= (*this)(j, i) * x[order_[j]];
      x[order_[i]] = y_[i] / (*this)(i, i);
    }
  }

 private:
  /// Rows and columns k and `pivot` > k change places, of the lower triangle.
  void exchange(std::size_t k, std::size_t pivot) {
    if (pivot == k) return;
    std::swap(order_[k], order_[pivot]);
    std::swap((*this)(k, k), (*this)(pivot, pivot));
    for (std::size_t j = 0; j < k; ++j) std::swap((*this)(k, j), (*this)(pivot, j));
    for (std::size_t i = k + 1; i < pivot; ++i) std::swap((*this)(i, k), (*this)(pivot, i));
    for (std::size_t i = pivot + 1; i < n_; ++i) std::swap((*this)(i, k), (*this)(i, pivot));
  }

  std::size_t n_, rank_ = 0;
  std::vector<double> L_;
  std::vector<std::size_t> order_;
  std::vector<double> y_;
};

}  // namespace hookpoint
