#include "apps/shared/subject_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "language/names.h"

namespace hookpoint::application {
namespace {

constexpr std::array fields{"engine", "settings", "contact", "integrator"};

const std::vector<std::string>& choices_of(const language::Schema& schema, const char* field) {
  return schema.find("World")->find(field)->choices;
}

[[noreturn]] void refuse(const language::Schema& schema, const std::string& word,
                         const std::string& given_as) {
  std::vector<std::string> known;
  for (const char* field : fields)
    known.insert(known.end(), choices_of(schema, field).begin(), choices_of(schema, field).end());
  const std::string nearest = language::nearest_name(word, known);
  throw SubjectError(
      fmt::format("{} `{}`: there is no engine, setting, contact law or integrator of that name{}; "
                  "`hookpoint engines` lists them, e.g. {} mujoco:recommended, {} rk4",
                  given_as, word, nearest.empty() ? "" : ", did you mean `" + nearest + "`?",
                  given_as, given_as));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> subject_fields(const language::Schema& schema,
                                                                const std::string& words,
                                                                const std::string& given_as) {
  std::vector<std::pair<std::string, std::string>> set;
  const auto given = [&](std::string_view field) {
    return std::ranges::any_of(set, [&](const auto& one) { return one.first == field; });
  };
  std::istringstream text(words);
  for (std::string word; std::getline(text, word, ':');) {
    const auto field = std::ranges::find_if(fields, [&](const char* name) {
      const std::vector<std::string>& choices = choices_of(schema, name);
      return std::ranges::find(choices, word) != choices.end();
    });
    if (field == fields.end()) refuse(schema, word, given_as);
    if (given(*field))
      throw SubjectError(
          fmt::format("{} `{}`: `{}` is a second {}", given_as, words, word, *field));
    set.emplace_back(*field, word);
  }
  if (set.empty()) refuse(schema, words, given_as);
  if (!given("engine")) set.emplace_back("engine", "dts");
  return set;
}

std::string subject_name(const simulation::Experiment& experiment) {
  return experiment.engine == "dts" ? experiment.contact
                                    : experiment.engine + " " + experiment.settings;
}

}  // namespace hookpoint::application
