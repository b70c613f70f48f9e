// Warnings of unstable steps in tunings and calibrations, whose constants change the ground.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "studies/search/varied_scene.h"

namespace hookpoint::studies {

/// Warns at `place` where the step of a planned scene is unstable; `note`, unless it is empty, says
/// with which constants.
void warn_of_step(const simulation::Experiment& experiment, const language::Position& place,
                  const std::string& note, language::Diagnostics& diagnostics);

/// Warning of the step of the scene with these constants; none where it is stable, and where the
/// scene cannot be loaded with them.
std::optional<std::string> step_warning(const VariedScene& scene,
                                        std::span<const ConstantSetting> constants);

}  // namespace hookpoint::studies
