// The scene of a row as a file that a window or a picture opens.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

struct SceneFile {
  std::filesystem::path file;
  std::vector<std::string> settings;  ///< as --set takes them
};

/// The study's scene with the row's settings. A row on another ground than the scene's, which no
/// setting tells, has its scene written into `folder`, as `scene.hook`. Throws output::FileError.
SceneFile scene_file_of(const StudyPlan& plan, const RowPlan& row,
                        const std::filesystem::path& folder);

}  // namespace hookpoint::studies
