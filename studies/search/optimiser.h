// Seeded searches of a box by the algorithms of pagmo: NSGA-II and CMA-ES. What is searched may be
// any function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hookpoint::studies {

enum class SearchMethod { nsga2, cmaes };

/// What a search hears of a point.
struct Score {
  std::vector<double> objectives;  ///< to be minimised; any where `violation` > 0
  double violation = 0.;  ///< how far the point is from what is required; 0: it is feasible
};

/// Points of the unit box in, their scores out, in the same order. What it throws comes out of the
/// search.
using BatchScore =
    std::function<std::vector<Score>(std::span<const std::vector<double>> points, int generation)>;

struct SearchOptions {
  SearchMethod method = SearchMethod::nsga2;
  std::size_t constants = 1, objectives = 1;
  int population = 40;   ///< of nsga2 a multiple of 4, at least 8
  int generations = 25;  ///< batches that are scored, the first included
  std::uint64_t seed = 1;
  std::vector<std::vector<double>> first;  ///< points that are in the first batch
  double width = 1.;  ///< of the box about first[0] that the others of that batch are in; 1: all
};

/// Scores `generations` batches of `population` points. The first is a Latin hypercube with the
/// points of `first` in it, over the whole box or one of `width` about the first of them. A
/// feasible point is better than any that is not, and of two that are not the one that misses less
/// (Deb's rule: Deb et al. 2002, IEEE Trans. Evol. Comp. 6(2), section VI); CMA-ES takes one
/// objective. The same options and scores give the same points.
void search(const SearchOptions& options, const BatchScore& score);

}  // namespace hookpoint::studies
