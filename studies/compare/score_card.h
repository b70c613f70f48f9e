// A Wall that compares: decades of error of every truth under every subject, and where our laws lose.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/figures/heat_map.h"
#include "output/latex/latex.h"
#include "studies/compare/wall.h"

namespace hookpoint::studies {

/// The card: truths down, what others accept and the subjects across, decades of error in each cell.
/// A run without a number is a cross; an engine that does not take a scene leaves its cell empty.
output::HeatMap score_card(const WallResult& wall);

/// A truth that laws of ours do not meet, and another engine comes nearer to by more than a decade.
struct Loss {
  const WallLine* line = nullptr;
  std::string other;   ///< the nearest subject of another engine
  double theirs = 0.;  ///< its decades of error
  std::vector<std::pair<std::string, std::optional<double>>> ours;  ///< law and decades
};
std::vector<Loss> losses(const WallResult& wall);

/// Names, without types, of what a comparing Wall leaves beside its other files: the table and the
/// card.
inline constexpr const char* score_table_name = "scores";
inline constexpr const char* score_card_name = "score_card";

/// Rows scene, truth, subject, engine, measured, expected, unit, scale, decades, status.
output::CsvTable score_table(const WallResult& wall);

/// The same as LaTeX: a row a truth, a column a subject, decades of error.
output::LatexTable latex_score_table(const WallResult& wall);

}  // namespace hookpoint::studies
