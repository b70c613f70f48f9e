#include "studies/calibrate/subject_name.h"

namespace hookpoint::studies {
namespace {

const std::vector<std::string>& choices_of(const language::ClassSchema& world, const char* field) {
  return world.find(field)->choices;
}

/// Takes `rest` apart, name by name: names may hold `_` themselves, so each that fits is tried.
bool take_apart(const language::ClassSchema& world, std::string_view rest, SubjectPlan& subject) {
  for (const CompositionWord& part : composition_words) {
    if (!(subject.*part.member).empty()) continue;
    for (const std::string& choice : choices_of(world, part.field)) {
      if (!rest.starts_with(choice)) continue;
      const std::string_view left = rest.substr(choice.size());
      if (!left.empty() && left.front() != '_') continue;
      subject.*part.member = choice;
      if (left.empty() || take_apart(world, left.substr(1), subject)) return true;
      (subject.*part.member).clear();
    }
  }
  return false;
}

}  // namespace

std::optional<SubjectPlan> subject_named(const language::ClassSchema& world,
                                         std::string_view word) {
  SubjectPlan subject;
  if (!take_apart(world, word, subject)) return std::nullopt;
  if (subject.engine.empty()) subject.engine = "dts";
  subject.info.name = std::string(word);
  return subject;
}

std::vector<std::string> subject_parts(const language::ClassSchema& world) {
  std::vector<std::string> names;
  for (const CompositionWord& part : composition_words) {
    const auto& choices = choices_of(world, part.field);
    names.insert(names.end(), choices.begin(), choices.end());
  }
  return names;
}

}  // namespace hookpoint::studies
