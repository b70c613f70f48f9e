#include "studies/search/step_warnings.h"

#include "simulation/analysis/step_warning.h"

namespace hookpoint::studies {

void warn_of_step(const simulation::Experiment& experiment, const language::Position& place,
                  const std::string& note, language::Diagnostics& diagnostics) {
  const auto warning = simulation::step_warning(experiment);
  if (!warning) return;
  diagnostics.warning(place, *warning);
  if (!note.empty()) diagnostics.note(place, note);
}

std::optional<std::string> step_warning(const VariedScene& scene,
                                        std::span<const ConstantSetting> constants) {
  language::Diagnostics unreported;
  const auto loaded = scene.load(constants, 1, unreported);
  return loaded ? simulation::step_warning(loaded->experiment) : std::nullopt;
}

}  // namespace hookpoint::studies
