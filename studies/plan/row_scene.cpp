#include "studies/plan/row_scene.h"

#include "simulation/identity.h"
#include "simulation/scene/load.h"

namespace hookpoint::studies {

std::optional<LoadedScene> load_scene(language::Library& library, const RowScene& scene,
                                      language::Diagnostics& diagnostics) {
  const auto tree = library.evaluate(scene.file, scene.options, diagnostics);
  if (!tree) return std::nullopt;
  auto experiment = simulation::load_experiment(*tree, diagnostics, library.search_path());
  if (!experiment || diagnostics.has_errors()) return std::nullopt;
  simulation::write_chosen_step(*experiment, *tree);
  LoadedScene loaded{std::move(*experiment), language::print(*tree), {}};
  loaded.sources = simulation::files_read(loaded.experiment);
  for (std::string& source : language::sources_of(*tree)) loaded.sources.insert(std::move(source));
  return loaded;
}

}  // namespace hookpoint::studies
