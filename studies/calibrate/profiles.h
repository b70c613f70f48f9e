// Intervals of all constants of a subject by their profiles, the same after every search.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "studies/calibrate/criterion.h"
#include "studies/calibrate/profile.h"
#include "studies/calibrate/subject_fit.h"

namespace hookpoint::studies {

/// What a method of calibration makes least, as profiles need it.
struct FitMeasure {
  Cases cases;  ///< over which it is made least
  std::function<std::optional<double>(const Residuals& residuals)> error{};
  /// How much worse other points are than the one with these residuals.
  std::function<Excess(const Residuals& at_optimum)> excess_over{};
  /// See ProfileProblem.
  std::function<Residuals(const Residuals& residuals, const Residuals& from)> to_squares{};
};

/// What profiles say of the constants of a fit.
struct Profiles {
  std::vector<ProfileEnd> ends;    ///< lower and upper end of each constant in turn; empty: none
  std::vector<UnitPoint> as_good;  ///< points of separate valleys that explain the data
};

/// Rows of the store that profiles request at most.
std::size_t rows_of_profiles(std::size_t constants);

/// Refines the fit's best point, whatever search found it.
void polish(SubjectFit& fit, const FitMeasure& measure);

/// Profiles every constant about the best point. Where a profile finds a better one the fit moves
/// there and the profiles begin again, a few times at most.
Profiles find_profiles(SubjectFit& fit, const FitMeasure& measure);

}  // namespace hookpoint::studies
