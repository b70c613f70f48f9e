#include "studies/blocks/fix.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/written_values.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

struct FixBlock {
  const language::Field* value = nullptr;
};

const Fields<FixBlock>& fix_fields() {
  static const Fields<FixBlock> fields{
      required(or_words(number_field("value", "?", &FixBlock::value, "the value")))};
  return fields;
}

const language::Field& value_of_fix(const Object& block) {
  return *load_fields(block, fix_fields()).value;
}

}  // namespace

void add_fix_class(language::Schema& schema) {
  schema.add(block_class("Fix", "A value of a Param of the scene.", schemas(fix_fields())));
}

std::string fixed_text(const Object& fix) { return text_of(value_of_fix(fix)); }

const std::vector<std::string>& fixed_words(const Object& fix) { return value_of_fix(fix).words; }

std::vector<Assignment> load_fixes(const Object& owner, const StudyParts& so_far,
                                   Diagnostics& diagnostics) {
  std::vector<Assignment> result;
  const std::vector<std::string> parameters = so_far.parameters();
  for (const Object* block : owner.children_of("Fix")) {
    if (std::ranges::find(parameters, block->name) == parameters.end()) {
      report_unknown(block->position, "Param of the scene", block->name, parameters, diagnostics);
      continue;
    }
    if (so_far.is_varied(block->name)) {
      const bool swept = so_far.sweep_index(block->name) >= 0;
      diagnostics.error(block->position,
                        fmt::format("`{}` is {}: it cannot be fixed as well", block->name,
                                    swept ? "swept" : "set by the Cases"));
      continue;
    }
    result.push_back({block->name, fixed_text(*block)});
  }
  return result;
}

}  // namespace hookpoint::studies
