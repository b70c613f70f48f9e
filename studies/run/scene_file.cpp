#include "studies/run/scene_file.h"

#include "output/files/file.h"

namespace hookpoint::studies {

SceneFile scene_file_of(const StudyPlan& plan, const RowPlan& row,
                        const std::filesystem::path& folder) {
  const ScenePlan scene = plan.scene_of(row);
  if (!scene.ground) return {scene.file, plan.settings_of(row)};
  language::Diagnostics unreported;
  const auto loaded = load_scene(*plan.library, scene, unreported);
  if (!loaded) return {scene.file, plan.settings_of(row)};
  std::filesystem::create_directories(folder);
  output::write_file(folder / "scene.hook", loaded->printed());
  return {folder / "scene.hook", {}};
}

}  // namespace hookpoint::studies
