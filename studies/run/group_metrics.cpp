#include "studies/run/group_metrics.h"

#include <algorithm>
#include <map>

namespace hookpoint::studies {
namespace {

/// Gives every row the spread over the runs of its group (those that differ from it in the swept
/// value alone); nothing where one of these has no value.
void measure_over_sweep(const StudyPlan& plan, std::size_t metric, StudyResult& result) {
  std::vector<std::optional<double>> of_groups;
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    std::vector<double> parts;
    bool whole = true;
    for (const std::size_t other : plan.rows_along(row, plan.metric_sweeps[metric])) {
      const std::optional<double>& part = result.rows[other].metrics[metric].measured;
      whole = whole && part.has_value();
      if (part) parts.push_back(*part);
    }
    of_groups.push_back(whole ? spread(parts) : std::nullopt);
  }
  for (std::size_t row = 0; row < plan.rows.size(); ++row)
    result.rows[row].metrics[metric].measured = of_groups[row];
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
                           const std::vector<RowOutcome>& outcomes, const StudyResult& result) {
  const std::size_t subjects = plan.subjects.size();
  PeerDistances matrix{result.rows[group.front()].parameters,
                       std::vector<std::optional<double>>(subjects * subjects)};
  for (const std::size_t a : group) {
    for (const std::size_t b : group) {
      if (outcomes[a].status != "ok" || outcomes[b].status != "ok") continue;
      const auto line = static_cast<std::size_t>(plan.rows[a].subject);
      const auto column = static_cast<std::size_t>(plan.rows[b].subject);
      matrix.distances[line * subjects + column] =
          path_distance(outcomes[a].path, outcomes[b].path);
    }
  }
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

void measure_between_subjects(const StudyPlan& plan, std::size_t metric,
                              const std::vector<RowOutcome>& outcomes, StudyResult& result) {
  for (const std::vector<std::size_t>& group : groups_of_subjects(plan)) {
    PeerDistances matrix = distances_of(plan, group, outcomes, result);
    for (const std::size_t row : group)
      result.rows[row].metrics[metric].measured = median_distance(
          matrix, static_cast<std::size_t>(plan.rows[row].subject), plan.subjects.size());
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

void measure_groups(const StudyPlan& plan, const std::vector<RowOutcome>& outcomes,
                    StudyResult& result) {
  for (std::size_t metric = 0; metric < plan.metrics.size(); ++metric) {
    if (plan.metrics[metric]->scope == MetricScope::sweep) measure_over_sweep(plan, metric, result);
    if (plan.metrics[metric]->scope == MetricScope::subjects)
      measure_between_subjects(plan, metric, outcomes, result);
  }
}

}  // namespace hookpoint::studies
