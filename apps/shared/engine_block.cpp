#include "apps/shared/engine_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "language/document/document.h"
#include "language/tree/fields.h"

namespace hookpoint::application {
namespace {

using language::Fields;
using language::number_field;
using language::text_field;
using language::words_field;
using reference::ProgramDefinition;

constexpr int most_words = 100;

const Fields<ProgramDefinition>& engine_fields() {
  static const Fields<ProgramDefinition> fields{
      required(words_field("command", most_words, &ProgramDefinition::command,
                           "the program and its arguments; it runs in the folder of this file, no "
                           "shell sees them")),
      words_field("settings", most_words, &ProgramDefinition::settings,
                  "names that `settings =` accepts of this engine, which its program knows; if not "
                  "given, default"),
      words_field("files", most_words, &ProgramDefinition::files,
                  "files of that folder, beside the command's own, on which its numbers depend: "
                  "runs are another's when one changes"),
      text_field("install", &ProgramDefinition::install,
                 "what to do where the program does not start"),
      positive(number_field("deadline", "s", &ProgramDefinition::deadline,
                            "for each answer; a program that is later is ended")),
  };
  return fields;
}

}  // namespace

void add_engine_class(language::Schema& schema) {
  language::ClassSchema engine;
  engine.name = engine_class_name;
  engine.doc =
      "an engine that is a program (docs/engine_protocol.md); in a file of its own, which lies in a "
      "folder `engines` or is included";
  engine.top_level = true;
  engine.own_file = true;
  engine.naming = language::Naming::required;
  engine.fields = schemas(engine_fields());
  schema.add(std::move(engine));
}

std::vector<ProgramDefinition> read_engines(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& search_path,
    const std::function<bool(const std::string&)>& known,
    const std::function<void(const language::Diagnostics&)>& tell) {
  language::Schema schema;
  add_engine_class(schema);
  language::Library library(schema, search_path);
  language::Diagnostics diagnostics;
  std::vector<ProgramDefinition> engines;
  if (const auto other = library.other_than(file, engine_class_name)) {
    diagnostics.error(*other,
                      "an Engine stands in a file of its own, which the others include: this does "
                      "not belong beside it");
  } else if (const auto root = library.evaluate(file, {}, diagnostics)) {
    for (const language::Object* object : root->children_of(engine_class_name)) {
      // Blocks of included files belong to those files.
      if (!std::filesystem::equivalent(object->position.file->path, file)) continue;
      ProgramDefinition engine = load_fields(*object, engine_fields());
      engine.name = object->name;
      engine.folder =
          std::filesystem::absolute(object->position.file->path).lexically_normal().parent_path();
      if (engine.settings.empty()) engine.settings.emplace_back("default");
      if (known(engine.name))
        diagnostics.error(object->position,
                          fmt::format("there is an engine `{}` already", engine.name));
      engines.push_back(std::move(engine));
    }
  }
  tell(diagnostics);
  return diagnostics.error_count() > 0 ? std::vector<ProgramDefinition>{} : engines;
}

std::vector<std::filesystem::path> engine_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "engines", none))
    if (entry.path().extension() == ".hook") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace hookpoint::application
