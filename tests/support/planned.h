// Tunings and calibrations of a file, planned as `tune` plans them.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/shared/application.h"
#include "studies/calibrate/problem.h"
#include "studies/tune/problem.h"

namespace hookpoint::studies {

/// Those of all Calibrate blocks; none after errors, which the application reports.
inline std::vector<CalibrationPlan> planned_calibrations(application::Application& application,
                                                         const std::filesystem::path& file) {
  std::vector<CalibrationPlan> plans;
  const auto root = application.evaluate(file, {});
  if (!root || !application.load_scene_plugins(*root, file)) return plans;
  for (const language::Object* block : root->children_of("Calibrate")) {
    language::Diagnostics diagnostics;
    auto plan = make_calibration_plan(*root, *block, file.string(), application.library(),
                                      application.engines(), false, diagnostics);
    application.tell(diagnostics);
    if (!plan || diagnostics.has_errors()) return {};
    plans.push_back(std::move(*plan));
  }
  return plans;
}

/// Those of all Tune blocks, one a subject; none after errors, which the application reports.
inline std::vector<TunePlan> planned_tunes(application::Application& application,
                                           const std::filesystem::path& file, bool quick) {
  std::vector<TunePlan> plans;
  const auto root = application.evaluate(file, {});
  if (!root || !application.load_scene_plugins(*root, file)) return plans;
  for (const language::Object* block : root->children_of("Tune")) {
    language::Diagnostics diagnostics;
    auto found = make_tune_plans(*root, *block, file.string(), application.library(),
                                 application.engines(), quick, diagnostics);
    application.tell(diagnostics);
    if (!found || diagnostics.has_errors()) return {};
    for (TunePlan& plan : *found) plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace hookpoint::studies
