// A quadratic function of a point, fitted to what was found at many: a rough error made smooth, so
// that its least point does not hang on where one looked. What was found may be any function.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "studies/calibrate/least_squares.h"

namespace hookpoint::studies {

/// Errors of several things at a point, all of them known there.
struct PlacedErrors {
  UnitPoint point;
  std::vector<double> errors;  ///< one a thing
};

/// One quadratic function a thing, by least squares over the best points, best by the sum of their
/// errors, three times as many as it has coefficients (Box & Wilson 1951).
class ResponseSurface {
 public:
  /// Nothing with too few points, or where they lie in a plane.
  static std::optional<ResponseSurface> fit(std::vector<PlacedErrors> looked);

  /// Where the sum over the things, each counted `times`, is least, within three times the box of
  /// the points that were fitted, and the unit box; nothing where the sum is not convex.
  std::optional<UnitPoint> least(std::span<const int> times) const;

 private:
  std::vector<double> middle_, half_width_;        ///< of that box
  std::vector<std::vector<double>> coefficients_;  ///< by coefficient and thing
};

}  // namespace hookpoint::studies
