#include "contact/geometry/concurrent.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace hookpoint::contact {
namespace {

/// Some of the obstructions, as active as equalities: u = sum lambda_i n_i with n_i . u = d_i.
struct Active {
  std::array<std::size_t, 3> which{};
  std::size_t count = 0;
  std::array<double, 3> lambda{};
};

/// Solves the Gram matrix (n_i . n_j) lambda = d by elimination; false where normals depend on each
/// other or a lambda is negative.
bool solve(std::span<const Obstruction> all, Active& active) {
  const std::size_t n = active.count;
  std::array<std::array<double, 4>, 3> rows{};
  for (std::size_t i = 0; i < n; ++i) {
    const Obstruction& a = all[active.which[i]];
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(a.normal, all[active.which[j]].normal);
    rows[i][n] = a.depth;
  }
  constexpr double dependent = 1e-12;
  for (std::size_t i = 0; i < n; ++i) {
    if (rows[i][i] < dependent) return false;
    for (std::size_t k = i + 1; k < n; ++k) {
      const double factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j <= n; ++j) rows[k][j] -= factor * rows[i][j];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    double value = rows[i][n];
    for (std::size_t j = i + 1; j < n; ++j) value -= rows[i][j] * active.lambda[j];
    active.lambda[i] = value / rows[i][i];
    if (active.lambda[i] < 0.) return false;
  }
  return true;
}

/// By how much u misses the worst obstruction [m].
double worst_miss(std::span<const Obstruction> all, const Active& active) {
  Vector3d u;
  for (std::size_t i = 0; i < active.count; ++i)
    u += active.lambda[i] * all[active.which[i]].normal;
  double miss = 0.;
  for (const Obstruction& obstruction : all)
    miss = std::max(miss, obstruction.depth - dot(u, obstruction.normal));
  return miss;
}

}  // namespace

void share_out(std::span<Obstruction> all) {
  assert(all.size() <= most_obstructions);
  if (all.size() == 1) {
    all[0].part = 1.;
    return;
  }
  double scale = 0.;
  for (Obstruction& obstruction : all) {
    obstruction.part = 0.;
    scale = std::max(scale, obstruction.depth);
  }
  const double rounding = 1e-12 * scale;
  Active best;
  double least_miss = std::numeric_limits<double>::infinity();
  // The fewest that do: equal planes do not share by chance.
  const auto consider = [&](Active active) {
    if (!solve(all, active)) return false;
    const double miss = worst_miss(all, active);
    if (miss < least_miss) {
      least_miss = miss;
      best = active;
    }
    return least_miss <= rounding;
  };
  const auto search = [&] {
    const std::size_t n = all.size();
    for (std::size_t i = 0; i < n; ++i)
      if (consider({{i, 0, 0}, 1, {}})) return;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if (consider({{i, j, 0}, 2, {}})) return;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k)
          if (consider({{i, j, k}, 3, {}})) return;
  };
  search();
  for (std::size_t i = 0; i < best.count; ++i) {
    Obstruction& obstruction = all[best.which[i]];
    obstruction.part = best.lambda[i] / obstruction.depth;
  }
}

}  // namespace hookpoint::contact
