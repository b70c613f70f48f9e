#include "simulation/experiment/painted_parts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

namespace hookpoint::simulation {
namespace {

constexpr double most_mixed_cells = 1U << 16U;  ///< in one stretch

/// Where the materials may change. A patch's edge is in a cell whose two tiles have their
/// centroids on either side of it, or both on one: that cell stands by itself.
std::vector<double> breaks(const CellRow& cells, const std::vector<double>& edges) {
  std::set<double> breaks{cells.first, cells.last};
  for (const double edge : edges) {
    const double cell =
        std::clamp(std::floor((edge - cells.origin) / cells.spacing), cells.first, cells.last);
    breaks.insert({cell, std::min(cell + 1., cells.last)});
  }
  return {breaks.begin(), breaks.end()};
}

class Painting {
 public:
  Painting(const contact::Terrain& ground, const CellRow& columns, const CellRow& rows)
      : ground_(ground), columns_(columns), rows_(rows) {}

  /// Whether two cells have the same materials.
  bool alike(double c0, double r0, double c1, double r1) const {
    return lower(c0, r0) == lower(c1, r1) && upper(c0, r0) == upper(c1, r1);
  }
  /// Cells that are alike: one material for the lower tiles, one for the upper.
  void add(double c0, double c1, double r0, double r1) {
    const int lower = this->lower(c0, r0), upper = this->upper(c0, r0);
    if (lower == upper || (c1 - c0) * (r1 - r0) > most_mixed_cells) {
      parts_.push_back({lower, {at(c0, r0), at(c1, r0), at(c1, r1), at(c0, r1)}});
      return;
    }
    for (double row = r0; row < r1; ++row)
      for (double column = c0; column < c1; ++column) add_cell(column, row, lower, upper);
  }
  std::vector<PaintedPart> take() { return std::move(parts_); }

 private:
  /// The two tiles of a cell, on either side of its diagonal, cut where the ground ends.
  void add_cell(double c, double r, int lower, int upper) {
    const double c_end = std::min(c + 1., columns_.end), r_end = std::min(r + 1., rows_.end);
    const double diagonal = std::min(c_end - c, r_end - r);
    const Vector3d far = at(c + diagonal, r + diagonal);
    parts_.push_back({lower, {at(c, r), at(c_end, r), at(c_end, r + diagonal), far}});
    parts_.push_back({upper, {at(c, r), far, at(c + diagonal, r_end), at(c, r_end)}});
  }
  int lower(double c, double r) const { return material(c + 2. / 3., r + 1. / 3.); }
  int upper(double c, double r) const { return material(c + 1. / 3., r + 2. / 3.); }
  int material(double column, double row) const {
    return ground_
        .query(columns_.origin + column * columns_.spacing, rows_.origin + row * rows_.spacing, 0.)
        .material;
  }
  Vector3d at(double column, double row) const { return {columns_.at(column), rows_.at(row), 0.}; }

  const contact::Terrain& ground_;
  const CellRow& columns_;
  const CellRow& rows_;
  std::vector<PaintedPart> parts_;
};

/// Without the breaks on whose two sides all is alike.
template <class Alike>
std::vector<double> needed(const std::vector<double>& breaks, const Alike& alike) {
  std::vector<double> kept{breaks.front()};
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    if (!alike(breaks[i - 1], breaks[i])) kept.push_back(breaks[i]);
  kept.push_back(breaks.back());
  return kept;
}

}  // namespace

CellRow cells_of_extent(double origin, double spacing, double size) {
  CellRow cells{origin, spacing, 0., size / spacing, 0.};
  cells.last = std::ceil(cells.end);
  return cells;
}

CellRow cells_between(double spacing, double least, double most) {
  CellRow cells{0., spacing, std::floor(least / spacing), std::ceil(most / spacing), 0.};
  cells.last = cells.end;
  return cells;
}

std::vector<PaintedPart> painted_parts(const contact::Terrain& ground, const CellRow& columns,
                                       const CellRow& rows) {
  std::vector<double> xs, ys;
  for (const contact::MaterialPatch& patch : ground.description().patches) {
    xs.insert(xs.end(), {patch.from_x, patch.to_x});
    ys.insert(ys.end(), {patch.from_y, patch.to_y});
  }
  Painting painting(ground, columns, rows);
  const std::vector<double> all_across = breaks(columns, xs), all_along = breaks(rows, ys);
  // The last break is the end, where no cell begins.
  const auto row_starts = std::span(all_along).first(all_along.size() - 1);
  const auto column_starts = std::span(all_across).first(all_across.size() - 1);
  const std::vector<double> across = needed(all_across, [&](double one, double other) {
    return std::ranges::all_of(row_starts,
                               [&](double row) { return painting.alike(one, row, other, row); });
  });
  const std::vector<double> along = needed(all_along, [&](double one, double other) {
    return std::ranges::all_of(
        column_starts, [&](double column) { return painting.alike(column, one, column, other); });
  });
  for (std::size_t r = 1; r < along.size(); ++r)
    for (std::size_t c = 1; c < across.size(); ++c)
      painting.add(across[c - 1], across[c], along[r - 1], along[r]);
  return painting.take();
}

}  // namespace hookpoint::simulation
