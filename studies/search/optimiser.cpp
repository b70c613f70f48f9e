// The one file that sees pagmo. pagmo's NSGA-II knows no constraints. Deb's rule is had exactly by
// what it is told of an infeasible point: every objective is 1e100 (1 + violation), greater than
// any number of a feasible one. Then whoever is feasible dominates whoever is not, of two that are
// not the lesser violation dominates, and fronts of feasible points, in which crowding counts, are
// as they were. CMA-ES only compares values, so the same does for it. pagmo's NSGA-II refuses a
// single objective: it is told it twice, and domination is then the order of its values.
#include "studies/search/optimiser.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <numeric>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <random>
#include <utility>

#include "studies/search/random_point.h"

namespace hookpoint::studies {
namespace {

using Point = std::vector<double>;

constexpr double infeasible = 1e100;

/// What all copies of a problem share, which pagmo makes freely.
struct SharedSearch {
  const SearchOptions& options;
  const BatchScore& score;
  int generation = 0;
  /// A rehearsal: points are written down, not scored.
  bool rehearsed = false;
  std::vector<Point> heard;
  std::map<Point, std::vector<double>> known;  ///< fitness of the generation's points

  /// As pagmo is told them.
  std::size_t objectives() const {
    return options.method == SearchMethod::nsga2 ? std::max<std::size_t>(options.objectives, 2)
                                                 : options.objectives;
  }
  std::vector<std::vector<double>> fitness(std::span<const Point> points) const {
    std::vector<std::vector<double>> all;
    for (Score& scored : score(points, generation)) {
      if (scored.violation > 0.)
        scored.objectives.assign(objectives(), infeasible * (1. + scored.violation));
      scored.objectives.resize(objectives(), scored.objectives.front());
      all.push_back(std::move(scored.objectives));
    }
    return all;
  }
};

/// pagmo's user-defined problem.
struct BoxProblem {
  std::shared_ptr<SharedSearch> shared;

  std::size_t constants() const { return shared ? shared->options.constants : 1; }
  pagmo::vector_double::size_type get_nobj() const { return shared ? shared->objectives() : 1; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(constants(), 0.), pagmo::vector_double(constants(), 1.)};
  }
  pagmo::vector_double fitness(const pagmo::vector_double& point) const {
    if (shared->rehearsed) {
      shared->heard.push_back(point);
      return pagmo::vector_double(get_nobj(), 0.);
    }
    return shared->known.at(point);
  }
  pagmo::vector_double batch_fitness(const pagmo::vector_double& flat) const {
    std::vector<Point> points;
    const auto size = static_cast<std::ptrdiff_t>(constants());
    for (auto at = flat.begin(); at != flat.end(); at += size) points.emplace_back(at, at + size);
    pagmo::vector_double all;
    for (const auto& fitness : shared->fitness(points))
      all.insert(all.end(), fitness.begin(), fitness.end());
    return all;
  }
  /// pagmo asks for it; nothing is ever stored.
  template <class Archive>
  void serialize(Archive&, unsigned) {}
};

/// One point in each of `count` layers of every coordinate (McKay, Beckman & Conover 1979).
std::vector<Point> latin_hypercube(std::size_t count, std::size_t constants,
                                   std::mt19937_64& random) {
  std::vector<Point> points(count, Point(constants));
  std::vector<std::size_t> layers(count);
  for (std::size_t c = 0; c < constants; ++c) {
    std::iota(layers.begin(), layers.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(layers[i - 1], layers[random() % i]);
    for (std::size_t i = 0; i < count; ++i)
      points[i][c] =
          (static_cast<double>(layers[i]) + random_point(random)) / static_cast<double>(count);
  }
  return points;
}

unsigned narrow(std::uint64_t seed) { return static_cast<unsigned>(seed ^ (seed >> 32)); }

pagmo::population first_generation(const SearchOptions& options,
                                   const std::shared_ptr<SharedSearch>& shared) {
  std::mt19937_64 random(options.seed);
  std::vector<Point> points =
      latin_hypercube(static_cast<std::size_t>(options.population), options.constants, random);
  if (options.width < 1.) {
    for (Point& point : points)
      for (std::size_t i = 0; i < point.size(); ++i)
        point[i] = std::clamp(options.first.front()[i] + (point[i] - 0.5) * options.width, 0., 1.);
  }
  const std::size_t given = std::min(options.first.size(), points.size());
  std::copy_n(options.first.begin(), given, points.begin());
  pagmo::population population(pagmo::problem(BoxProblem{shared}), 0, narrow(options.seed));
  const auto fitness = shared->fitness(points);
  for (std::size_t i = 0; i < points.size(); ++i) population.push_back(points[i], fitness[i]);
  return population;
}

void search_by_nsga2(const SearchOptions& options, const std::shared_ptr<SharedSearch>& shared,
                     pagmo::population population) {
  // Crossover and mutation as Deb et al. (2002), section V: 0.9, one constant of each child, both
  // distributions with the index 20.
  pagmo::nsga2 nsga2(1, 0.9, 20., 1. / static_cast<double>(options.constants), 20.,
                     narrow(options.seed));
  nsga2.set_bfe(pagmo::bfe(pagmo::member_bfe{}));
  while (++shared->generation < options.generations) population = nsga2.evolve(population);
}

/// pagmo's CMA-ES scores its points one by one, after it has drawn all of a generation. So it is
/// rehearsed on a copy, which tells the points; these are scored together; then it goes on.
void search_by_cmaes(const SearchOptions& options, const std::shared_ptr<SharedSearch>& shared,
                     pagmo::population population) {
  constexpr double automatic = -1., first_width = 0.3, never = 0.;
  pagmo::cmaes cmaes(1, automatic, automatic, automatic, automatic, first_width * options.width,
                     never, never,
                     /*memory=*/true, /*force_bounds=*/true, narrow(options.seed));
  while (++shared->generation < options.generations) {
    shared->rehearsed = true;
    shared->heard.clear();
    (void)pagmo::cmaes(cmaes).evolve(population);
    shared->rehearsed = false;
    const auto fitness = shared->fitness(shared->heard);
    shared->known.clear();
    for (std::size_t i = 0; i < fitness.size(); ++i)
      shared->known.emplace(shared->heard[i], fitness[i]);
    population = cmaes.evolve(population);
  }
}

}  // namespace

void search(const SearchOptions& options, const BatchScore& score) {
  assert(options.method == SearchMethod::nsga2 || options.objectives == 1);
  const auto shared =
      std::make_shared<SharedSearch>(SharedSearch{options, score, 0, false, {}, {}});
  pagmo::population population = first_generation(options, shared);
  if (options.method == SearchMethod::nsga2)
    search_by_nsga2(options, shared, std::move(population));
  else
    search_by_cmaes(options, shared, std::move(population));
}

}  // namespace hookpoint::studies
