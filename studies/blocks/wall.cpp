#include "studies/blocks/wall.h"

#include "studies/blocks/matrix.h"

namespace hookpoint::studies {

namespace {

const Fields<Heading>& wall_fields() {
  static const Fields<Heading> fields =
      heading_fields("heading of the report", "what the wall shows, first thing in the report");
  return fields;
}

const Fields<SceneBlock>& scene_fields() {
  static const Fields<SceneBlock> fields{
      text_field("title", &SceneBlock::title, "what it shows"),
      text_field("file", &SceneBlock::file, "if not scenes/NAME.hook"),
      quick_field(&SceneBlock::quick)};
  return fields;
}

}  // namespace

void add_wall_classes(language::Schema& schema) {
  schema.add(top_block_class("Wall",
                             "Scenes that bring their own truths (Expect), each under every "
                             "subject that its truths cover.",
                             schemas(wall_fields()), {"Scene", "Subject"}));
  schema.add(block_class("Scene", "A scene of a Wall, by the name of its file in scenes/.",
                         schemas(scene_fields()), {"Fix"}));
}

Heading wall_heading(const language::Object& wall) { return load_fields(wall, wall_fields()); }

SceneBlock scene_block(const language::Object& scene) { return load_fields(scene, scene_fields()); }

std::string scene_file(const language::Object& scene) {
  const Placed<std::string> file = scene_block(scene).file;
  return file ? *file : "scenes/" + scene.name + ".hook";
}

}  // namespace hookpoint::studies
