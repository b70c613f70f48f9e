#include "studies/plan/scene_words.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "language/syntax/syntax.h"
#include "studies/plan/scene_probe.h"

namespace hookpoint::studies {
namespace {

bool is_word(std::string_view text) {
  const auto part_of_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0) return false;
  return std::ranges::all_of(text, part_of_word) && text != "true" && text != "false" &&
         text != "pi";
}

/// Adds the words that Params of `file` hold, some of which are given.
void add_words(SceneWords& words, language::Library& library, const std::filesystem::path& file,
               const std::map<std::string, std::string>& given) {
  language::Diagnostics untold;
  const auto declared = library.parameters(file, untold);
  for (const language::ParameterDeclaration& parameter : declared) {
    const auto set = given.find(parameter.name);
    const std::string& text = set == given.end() ? parameter.default_text : set->second;
    if (is_string(text)) {
      words.try_emplace(parameter.name, language::unquote(text));
      continue;
    }
    if (!is_word(text)) continue;
    // In the file itself the name of a Param means what that holds.
    const bool names_another =
        set == given.end() &&
        std::ranges::find(declared, text, &language::ParameterDeclaration::name) != declared.end();
    if (!names_another)
      words.try_emplace(parameter.name, text);
    else if (const auto other = words.find(text); other != words.end())
      words.try_emplace(parameter.name, other->second);
  }
}

}  // namespace

SceneWords words_of(const StudyPlan& plan, const RowPlan& row) {
  SceneWords words;
  for (std::size_t i = 0; i < plan.sweeps.size(); ++i) {
    const SweepColumn& column = plan.sweeps[i].column;
    if (!column.words.empty())
      words[column.name] = column.words[static_cast<std::size_t>(row.values[i])];
  }
  const RowScene scene = plan.scene_of(row);
  add_words(words, *plan.library, scene.file, scene.options.parameters);
  if (scene.ground) add_words(words, *plan.library, scene.ground->file, scene.ground->parameters);
  return words;
}

}  // namespace hookpoint::studies
