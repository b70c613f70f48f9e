// The least value of x^T A x/2 + b^T x over x >= 0: which normal impulses bring approaching points to
// rest (Moreau's projection of the velocity on the cone of velocities that do not approach).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hookpoint::contact {

class NonnegativeMinimum {
 public:
  /// For at most `most` unknowns. Allocates; `find` does not.
  explicit NonnegativeMinimum(std::size_t most);

  /// `A` symmetric positive semidefinite, row by row, rows `stride` apart; x and b of equal length. With
  /// redundant unknowns the minimum is one next to x = 0, so that neither the order of the unknowns nor
  /// rounding chooses it. The active-set method of Lawson & Hanson 1974,
  /// chapter 23, from the guess that all are positive: O(n^3) where that is so.
  void find(std::span<const double> A, std::size_t stride, std::span<const double> b,
            std::span<double> x);

 private:
  void solve_free(std::span<const double> A, std::size_t stride, std::span<const double> b,
                  std::span<const double> near, double nearness);

  std::vector<double> L_, feasible_, trial_, y_, near_;
  std::vector<std::size_t> free_;
  std::vector<char> is_free_;
};

}  // namespace hookpoint::contact
