#include "studies/selection.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::studies {

std::optional<std::size_t> sweep_index(const StudyResult& study, const std::string& name) {
  for (std::size_t i = 0; i < study.sweeps.size(); ++i)
    if (study.sweeps[i].name == name) return i;
  return {};
}

std::optional<std::size_t> metric_index(const StudyResult& study, const std::string& name) {
  for (std::size_t i = 0; i < study.metrics.size(); ++i)
    if (study.metrics[i].name == name) return i;
  return {};
}

bool same_value(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool admits(const StudyResult& study, const SweepValues& where, const RunResult& row) {
  return std::all_of(where.begin(), where.end(), [&](const auto& fixed) {
    const auto sweep = sweep_index(study, fixed.first);
    const auto& values = fixed.second;
    return !sweep || std::any_of(values.begin(), values.end(), [&](double value) {
      return same_value(row.parameters[*sweep], value);
    });
  });
}

}  // namespace hookpoint::studies
