#include "studies/run/scene_file.h"

#include "output/file.h"

namespace hookpoint::studies {

SceneFile scene_file_of(const StudyPlan& plan, const RowPlan& row,
                        const std::filesystem::path& folder) {
  const RowScene scene = plan.scene_of(row);
  if (!scene.ground) return {scene.file, plan.settings_of(row)};
  language::Diagnostics untold;
  const auto loaded = load_scene(*plan.library, scene, untold);
  if (!loaded) return {scene.file, plan.settings_of(row)};
  std::filesystem::create_directories(folder);
  output::write_file(folder / "scene.hook", loaded->printed);
  return {folder / "scene.hook", {}};
}

}  // namespace hookpoint::studies
