#include "studies/run/group_metrics.h"

#include <algorithm>
#include <map>
#include <utility>

namespace hookpoint::studies {
namespace {

/// Gives every row the spread over the runs of its group (those that differ from it in the swept
/// value alone); nothing where one of these has no value.
void measure_over_sweep(const StudyPlan& plan, std::size_t metric, StudyResult& result) {
  for (const std::vector<std::size_t>& group : plan.groups_along(plan.metrics[metric].sweep)) {
    std::vector<double> parts;
    bool whole = true;
    for (const std::size_t row : group) {
      const std::optional<double>& part = result.rows[row].metrics[metric].measured;
      whole = whole && part.has_value();
      if (part) parts.push_back(*part);
    }
    const std::optional<double> of_group = whole ? spread(parts) : std::nullopt;
    for (const std::size_t row : group) result.rows[row].metrics[metric].measured = of_group;
  }
}

/// Rows at equal swept values, in their order.
std::vector<std::vector<std::size_t>> groups_of_subjects(const StudyPlan& plan) {
  std::map<std::vector<int>, std::vector<std::size_t>> groups;
  for (std::size_t row = 0; row < plan.rows.size(); ++row)
    groups[plan.rows[row].values].push_back(row);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [values, rows] : groups) result.push_back(std::move(rows));
  return result;
}

PeerDistances distances_of(const StudyPlan& plan, const std::vector<std::size_t>& group,
                           const StudyRows& kept, const StudyResult& result) {
  const std::size_t subjects = plan.subjects.size();
  PeerDistances matrix{result.rows[group.front()].parameters,
                       std::vector<std::optional<double>>(subjects * subjects)};
  std::vector<std::pair<std::size_t, std::vector<Vector3d>>> paths;  // of subjects that finished
  for (const std::size_t row : group)
    if (result.rows[row].status == "ok")
      paths.emplace_back(static_cast<std::size_t>(plan.rows[row].subject), kept.path(row));
  for (const auto& [line, one] : paths)
    for (const auto& [column, other] : paths)
      matrix.distances[line * subjects + column] = path_distance(one, other);
  return matrix;
}

/// Of the distances of `subject` from the others, the lower of the middle two for an even count.
std::optional<double> median_distance(const PeerDistances& matrix, std::size_t subject,
                                      std::size_t subjects) {
  std::vector<double> others;
  for (std::size_t other = 0; other < subjects; ++other) {
    const auto& distance = matrix.distances[subject * subjects + other];
    if (other != subject && distance) others.push_back(*distance);
  }
  if (others.empty()) return std::nullopt;
  std::ranges::sort(others);
  return others[(others.size() - 1) / 2];
}

void measure_between_subjects(const StudyPlan& plan, std::size_t metric, const StudyRows& kept,
                              StudyResult& result) {
  for (const std::vector<std::size_t>& group : groups_of_subjects(plan)) {
    PeerDistances matrix = distances_of(plan, group, kept, result);
    for (const std::size_t row : group) {
      auto median = median_distance(matrix, static_cast<std::size_t>(plan.rows[row].subject),
                                    plan.subjects.size());
      if (median) *median /= plan.metrics[metric].unit.scale;
      result.rows[row].metrics[metric].measured = median;
    }
    result.peer_distances.push_back(std::move(matrix));
  }
}

}  // namespace

double path_distance(std::span<const Vector3d> a, std::span<const Vector3d> b) {
  double greatest = 0.;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    greatest = std::max(greatest, norm(a[i] - b[i]));
  return greatest;
}

std::optional<double> spread(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const auto [least, greatest] = std::ranges::minmax(values);
  if (!(least > 0.)) return std::nullopt;
  return greatest / least - 1.;
}

void measure_groups(const StudyPlan& plan, const StudyRows& kept, StudyResult& result) {
  for (std::size_t metric = 0; metric < plan.metrics.size(); ++metric) {
    if (plan.metrics[metric].definition->scope == MetricScope::sweep)
      measure_over_sweep(plan, metric, result);
    if (plan.metrics[metric].definition->scope == MetricScope::subjects)
      measure_between_subjects(plan, metric, kept, result);
  }
}

}  // namespace hookpoint::studies
