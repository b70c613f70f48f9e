// Triangular factors of a small dense matrix, by Gauss with the largest pivot of a column.
#pragma once

#include <cstddef>
#include <span>

namespace hookpoint::contact {

/// Puts the factors of J, row by row, in its place; `pivot` has as many entries as J has rows. False
/// where J is singular. O(n^3)/3; allocates nothing.
bool factorise_dense(std::span<double> J, std::span<std::size_t> pivot);

/// x from J x, by the factors. O(n^2).
void solve_dense(std::span<const double> factors, std::span<const std::size_t> pivot,
                 std::span<double> x);

}  // namespace hookpoint::contact
