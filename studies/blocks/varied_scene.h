// What blocks that vary a scene's constants have in common: the files, and the Material that is
// varied.
#pragma once

#include <string>
#include <vector>

#include "studies/blocks/block.h"

namespace hookpoint::studies {

struct VariedSceneBlock : Heading {
  Placed<std::string> scene, terrain;
  std::string material;
};

Fields<VariedSceneBlock> varied_scene_fields(std::string question);

/// The files of scene and terrain that a block names.
std::vector<std::string> scene_files(const VariedSceneBlock& block);

}  // namespace hookpoint::studies
