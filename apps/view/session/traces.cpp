#include "apps/view/session/traces.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::view {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Each `stretch` values of `row` as two.
std::vector<double> extremes_of(std::span<const double> row, std::size_t stretch) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < row.size(); i += stretch) {
    Extremes extremes;
    for (const double value : row.subspan(i, std::min(stretch, row.size() - i)))
      extremes.add(value);
    kept.push_back(extremes.first());
    kept.push_back(extremes.second());
  }
  return kept;
}

/// Their instants.
std::vector<double> instants_of(std::span<const double> times, std::size_t stretch) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < times.size(); i += stretch) {
    kept.push_back(times[i]);
    kept.push_back(times[std::min(i + stretch / 2, times.size() - 1)]);
  }
  return kept;
}

}  // namespace

void Extremes::add(double value) {
  if (std::isnan(value)) return;
  if (!(value >= least_)) {
    least_ = value;
    greatest_last_ = false;
  }
  if (!(value <= greatest_)) {
    greatest_ = value;
    greatest_last_ = true;
  }
}

bool Traces::add(const std::string& trail) {
  if (std::ranges::find(trails_, trail) != trails_.end()) return false;
  trails_.push_back(trail);
  columns_.emplace_back(times_.size(), unknown);
  extremes_.emplace_back();
  return true;
}

void Traces::sample(double time, std::span<const double> values) {
  if (stretch_ == 1) {
    times_.push_back(time);
    for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].push_back(values[i]);
  } else {
    if (waiting_ == 0) begin_ = time;
    if (waiting_ == stretch_ / 2) middle_ = time;
    for (std::size_t i = 0; i < columns_.size(); ++i) extremes_[i].add(values[i]);
    if (++waiting_ < stretch_) return;
    times_.push_back(begin_);
    times_.push_back(middle_);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      columns_[i].push_back(extremes_[i].first());
      columns_[i].push_back(extremes_[i].second());
    }
    begin_stretch();
  }
  if (times_.size() >= most_) thin();
}

void Traces::begin_stretch() {
  waiting_ = 0;
  std::ranges::fill(extremes_, Extremes{});
}

void Traces::thin() {
  constexpr std::size_t four = 4;
  times_ = instants_of(times_, four);
  for (std::vector<double>& column : columns_) column = extremes_of(column, four);
  stretch_ = stretch_ == 1 ? four : 2 * stretch_;
}

void Traces::cut(double time) {
  const auto end = std::ranges::upper_bound(times_, time);
  const auto kept = static_cast<std::size_t>(end - times_.begin());
  times_.resize(kept);
  for (std::vector<double>& column : columns_) column.resize(kept);
  begin_stretch();
}

void Traces::clear() {
  times_.clear();
  for (std::vector<double>& column : columns_) column.clear();
  stretch_ = 1;
  begin_stretch();
}

Traces::Extract Traces::extract(const std::vector<std::string>& trails, double from, double to,
                                std::size_t points) const {
  const auto begin = std::ranges::lower_bound(times_, from) - times_.begin();
  const auto end = std::ranges::upper_bound(times_, to) - times_.begin();
  Extract extract;
  const auto first = static_cast<std::size_t>(begin);
  const std::size_t count = end > begin ? static_cast<std::size_t>(end - begin) : 0;
  const std::size_t stretch =
      count <= points ? 1 : 2 * ((count + points - 1) / std::max<std::size_t>(points, 1));
  const std::span<const double> times = std::span(times_).subspan(first, count);
  extract.times =
      stretch == 1 ? std::vector(times.begin(), times.end()) : instants_of(times, stretch);
  for (const std::string& trail : trails) {
    const auto at = std::ranges::find(trails_, trail);
    if (at == trails_.end()) {
      extract.values.emplace_back(extract.times.size(), unknown);
      continue;
    }
    const auto row =
        std::span(columns_[static_cast<std::size_t>(at - trails_.begin())]).subspan(first, count);
    extract.values.push_back(stretch == 1 ? std::vector(row.begin(), row.end())
                                          : extremes_of(row, stretch));
  }
  return extract;
}

}  // namespace hookpoint::view
