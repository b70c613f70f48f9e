#include "studies/blocks/wall.h"

#include "studies/blocks/matrix.h"

namespace hookpoint::studies {

namespace {

Fields<WallBlock> make_wall_fields() {
  Fields<WallBlock> fields;
  append(fields,
         heading_fields("heading of the report", "what the wall shows, first thing in the report"));
  append(fields,
         {boolean_field("score_card", &WallBlock::score_card,
                        "whether it compares its subjects: the report begins with a card of "
                        "decades of error, and a truth that does not hold is a finding, no "
                        "failure")});
  return fields;
}

const Fields<WallBlock>& wall_fields() {
  static const Fields<WallBlock> fields = make_wall_fields();
  return fields;
}

const Fields<SceneBlock>& scene_fields() {
  static const Fields<SceneBlock> fields{
      text_field("title", &SceneBlock::title, "what it shows"),
      text_field("file", &SceneBlock::file, "if not scenes/NAME.hook"),
      quick_field(&SceneBlock::quick),
      number_field("accepted", "?", &SceneBlock::accepted,
                   "an error that others accept, which the score card shows beside the subjects"),
      text_field("accepted_by", &SceneBlock::accepted_by, "who accepts it")};
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

WallBlock wall_block(const language::Object& wall) { return load_fields(wall, wall_fields()); }

SceneBlock scene_block(const language::Object& scene) { return load_fields(scene, scene_fields()); }

std::string scene_file(const language::Object& scene) {
  const Placed<std::string> file = scene_block(scene).file;
  return file ? *file : "scenes/" + scene.name + ".hook";
}

}  // namespace hookpoint::studies
