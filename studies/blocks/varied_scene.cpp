#include "studies/blocks/varied_scene.h"

#include <utility>

namespace hookpoint::studies {

Fields<VariedSceneBlock> varied_scene_fields(std::string question) {
  Fields<VariedSceneBlock> fields;
  append(fields, heading_fields("heading of the report", std::move(question)));
  append(fields,
         {required(text_field("scene", &VariedSceneBlock::scene,
                              "file of the world, whose Params may be varied")),
          text_field("terrain", &VariedSceneBlock::terrain,
                     "file of a Terrain and its Material, in the place of the scene's; its Params "
                     "may be varied"),
          words_field("material", 1, &VariedSceneBlock::material,
                      "the Material whose fields are varied; default: that of the ground, where "
                      "it has one alone")});
  return fields;
}

std::vector<std::string> scene_files(const VariedSceneBlock& block) {
  std::vector<std::string> files{*block.scene};
  if (block.terrain) files.push_back(*block.terrain);
  return files;
}

}  // namespace hookpoint::studies
