#include "studies/blocks/subject.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/blocks/block.h"
#include "studies/blocks/fix.h"
#include "studies/blocks/study_parts.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

/// The World's fields without their defaults; words where the schema has no World.
Fields<Composition> subject_fields(const language::ClassSchema* world) {
  Fields<Composition> fields;
  for (const CompositionWord& word : composition_words) {
    const language::FieldSchema* field = world == nullptr ? nullptr : world->find(word.field);
    const bool chosen = field != nullptr && field->type == language::FieldType::choice;
    fields.push_back(chosen ? choice_field(word.field, field->choices, word.member, word.doc)
                            : words_field(word.field, 1, word.member, word.doc));
  }
  return fields;
}

}  // namespace

void add_subject_class(language::Schema& schema) {
  schema.add(block_class("Subject", "One engine with its law, integrator and settings.",
                         schemas(subject_fields(schema.find("World"))), {"Fix", "Only"}));
}

SubjectPlan subject_of(const Object& block) {
  static const Fields<Composition> fields = subject_fields(nullptr);
  SubjectPlan subject;
  store_fields<Composition>(block, fields, subject);
  subject.info.name = block.name;
  return subject;
}

SubjectPlan load_subject(const Object& block, const StudyParts& so_far, Diagnostics& diagnostics) {
  SubjectPlan subject = subject_of(block);
  const bool peer = !subject.engine.empty() && subject.engine != "dts";
  for (const CompositionWord& word : composition_words)
    if (peer && word.member == &Composition::contact && block.given(word.field))
      diagnostics.error(
          block.find(word.field)->position,
          fmt::format("engine {} has a contact of its own: leave `contact` out", subject.engine));
  for (const SweepPlan& sweep : so_far.sweeps) {
    const std::string& name = sweep.column.name;
    if (sweep.role == SweepRole::world_field && block.given(name))
      diagnostics.error(block.find(name)->position,
                        fmt::format("`{}` is swept: a Subject cannot say it as well", name));
  }
  subject.fixes = load_fixes(block, so_far, diagnostics);
  subject.only = load_conditions(block, so_far, diagnostics);
  return subject;
}

std::vector<int> named_subjects(const language::Field* names, const StudyParts& so_far,
                                Diagnostics& diagnostics) {
  std::vector<int> subjects;
  if (names == nullptr) return subjects;
  const std::vector<std::string> known = so_far.subject_names();
  for (const std::string& word : names->words) {
    const auto subject = std::ranges::find(known, word);
    if (subject == known.end())
      report_unknown(names->position, "Subject", word, known, diagnostics);
    subjects.push_back(static_cast<int>(subject - known.begin()));
  }
  return subjects;
}

}  // namespace hookpoint::studies
