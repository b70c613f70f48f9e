// What the command line sets in the scenes of a study.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "language/document.h"
#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// The first name of a trail: "world" of "world.deltat".
std::string first_name(const std::string& trail);

/// Those of `settings` that a scene takes: it has a Param of the trail's name, or an object at its
/// top of the trail's first name. Fields of its World come last.
std::vector<language::Override> settings_of_scene(const SceneSettings& settings,
                                                  const std::vector<std::string>& parameters,
                                                  const language::Object& scene,
                                                  const std::string& world);

/// What `options` set, as --set takes it: "slope=5 deg", "world.engine=ode".
std::vector<std::string> setting_words(const language::EvaluateOptions& options);

/// The first of `settings` that sets a field which `one` and `other`, the same scene without the
/// settings, have with different values; null for none.
const language::Override* changed_setting(const std::vector<language::Override>& settings,
                                          const language::Object& one,
                                          const language::Object& other);
/// What is said of it.
std::string decided_already(const language::Override& setting);

/// Why a run of `subject` cannot have `setting`, as it decides of it otherwise; nothing when it
/// can.
std::optional<std::string> setting_problem(const language::Override& setting,
                                           const std::string& world, const SubjectPlan& subject);

}  // namespace hookpoint::studies
