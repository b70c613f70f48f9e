#include "studies/calibrate/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "studies/calibrate/outputs.h"
#include "studies/results/statistics.h"

namespace hookpoint::studies {
namespace {

/// A constant whose interval is a greater part of its range is not identified by the data.
constexpr double widest_interval = 0.5;
/// A constant that moves by less than this part of its range with another is no partner of it.
constexpr double least_partner = 0.05;
/// Two optima are farther apart than this part of a range, and than the interval is wide.
constexpr double least_gap = 0.01;

/// The values of a constant that explain the data, normalised.
struct ExplainedRange {
  double low = 0., high = 0.;

  void include(double share) {
    low = std::min(low, share);
    high = std::max(high, share);
  }
  /// Includes those of these points; the one farthest from the interval that is another one, not
  /// its continuation.
  std::optional<double> include(const std::vector<UnitPoint>& points, std::size_t constant) {
    const ExplainedRange before = *this;
    const double gap = std::max(least_gap, before.high - before.low);
    double farthest = gap;
    std::optional<double> apart;
    for (const UnitPoint& point : points) {
      const double share = point[constant];
      include(share);
      const double distance = std::max(before.low - share, share - before.high);
      if (!(distance > farthest)) continue;
      farthest = distance;
      apart = share;
    }
    return apart;
  }
};

std::string unit_of(const CalibrationPlan& plan, const FittedConstant& constant) {
  const std::string& unit = plan.varied[constant.constant].unit.text;
  return unit.empty() ? "" : " " + unit;
}

/// The other constants that move when this one does, from one end of its interval to the other:
/// " with b and c"; "" where there are none.
std::string partners(const SubjectFit& fit, const Profiles& profiles, std::size_t constant) {
  std::string names;
  for (std::size_t other = 0; other < fit.result.constants.size(); ++other) {
    const double from = profiles.ends[2 * constant].point[other];
    const double to = profiles.ends[2 * constant + 1].point[other];
    const double at = fit.result.constants[other].share;
    const double moved = std::max({from, to, at}) - std::min({from, to, at});
    if (other == constant || moved < least_partner) continue;
    names += (names.empty() ? " together with " : " and ") +
             fit.plan.varied[fit.result.constants[other].constant].name;
  }
  return names;
}

std::string why_not_identifiable(const FittedConstant& constant) {
  if (const std::string_view end = range_end(constant.share); !end.empty())
    return fmt::format("the fit ends at the {} end of its range", end);
  const double width = *constant.high - *constant.low;
  if (width > widest_interval)
    return fmt::format("its interval spans {:.0f} % of its range", 100. * width);
  for (const double reached : {*constant.low, *constant.high})
    if (const std::string_view end = range_end(reached); !end.empty())
      return fmt::format("its interval reaches the {} end of its range", end);
  return "";
}

}  // namespace

void set_intervals(SubjectFit& fit, const Profiles& profiles) {
  if (profiles.ends.empty()) return;
  for (std::size_t i = 0; i < fit.result.constants.size(); ++i) {
    FittedConstant& constant = fit.result.constants[i];
    ExplainedRange interval{constant.share, constant.share}, wide = interval;
    std::string beyond;
    for (std::size_t side = 0; side < 2; ++side) {
      const ProfileEnd& end = profiles.ends[2 * i + side];
      interval.include(end.share);
      wide.include(end.wide_share);
      if (end.without_runs)
        beyond = fmt::format("no run has a value beyond the {} end of its interval",
                             side == 0 ? "lower" : "upper");
    }
    const auto apart = interval.include(profiles.as_good, i);
    constant.low = interval.low;
    constant.high = interval.high;
    constant.reason = why_not_identifiable(constant);
    if (constant.reason.empty()) {
      // What an interval of 99.9 % does not identify is not called identified.
      FittedConstant wider = constant;
      wider.low = std::min(interval.low, wide.low);
      wider.high = std::max(interval.high, wide.high);
      wider.reason = why_not_identifiable(wider);
      if (!wider.reason.empty()) constant = wider;
    }
    if (!constant.reason.empty()) constant.reason += partners(fit, profiles, i);
    if (constant.reason.empty()) constant.reason = beyond;
    if (apart && range_end(constant.share).empty())
      constant.reason =
          fmt::format("{} and {}{} explain the data equally well",
                      value_text(fit.plan, constant, constant.share),
                      value_text(fit.plan, constant, *apart), unit_of(fit.plan, constant));
    constant.identifiable = constant.reason.empty();
  }
}

void set_correlations(SubjectFit& fit, const std::vector<UnitPoint>& points) {
  fit.result.resamples = points.size();
  if (points.size() < 2) return;
  std::vector<std::vector<double>> columns(fit.subject.constants.size());
  for (const UnitPoint& point : points)
    for (std::size_t i = 0; i < point.size(); ++i) columns[i].push_back(point[i]);
  for (const std::vector<double>& one : columns) {
    std::vector<double>& row = fit.result.correlations.emplace_back();
    for (const std::vector<double>& other : columns) row.push_back(correlation(one, other));
  }
}

}  // namespace hookpoint::studies
