#include "studies/results/selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/force_law.h"
#include "text/number.h"

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

namespace {

const std::string& word_of(const SweepColumn& sweep, double value) {
  return sweep.words.at(static_cast<std::size_t>(std::lround(value)));
}

}  // namespace

std::string label_of(const SweepColumn& sweep, double value, int digits) {
  return sweep.words.empty() ? text::rounded(value, digits) : word_of(sweep, value);
}

std::string exact_label_of(const SweepColumn& sweep, double value) {
  return sweep.words.empty() ? text::shortest(value) : word_of(sweep, value);
}

const SubjectInfo& composition_of(const StudyResult& study, const RunResult& row) {
  return row.composition < 0 ? study.subjects[static_cast<std::size_t>(row.subject)]
                             : study.compositions[static_cast<std::size_t>(row.composition)];
}

SubjectInfo composition_of(const simulation::Experiment& experiment, const EngineTable& engines,
                           std::string name) {
  SubjectInfo info;
  info.name = std::move(name);
  info.engine = experiment.engine;
  info.available = engines.available(info.engine);
  if (info.engine != "dts") {
    info.settings = experiment.settings;
    return info;
  }
  info.law = experiment.contact;
  if (contact::find_force_law(info.law) != nullptr) info.integrator = experiment.integrator;
  return info;
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
