// Vocabulary of the files of this folder: how a block's class and its fields are declared, and the
// errors that several blocks have.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/fields.h"

namespace hookpoint::studies {

using language::append;
using language::boolean_field;
using language::choice_field;
using language::Fields;
using language::formula_field;
using language::integer_field;
using language::list_field;
using language::number_field;
using language::Placed;
using language::text_field;
using language::words_field;

/// The class of a block inside another, named for what it is about.
language::ClassSchema block_class(std::string name, std::string doc,
                                  std::vector<language::FieldSchema> fields,
                                  std::vector<std::string> children = {});
/// The class of a block at the top of a file, with a name of its own.
language::ClassSchema top_block_class(std::string name, std::string doc,
                                      std::vector<language::FieldSchema> fields,
                                      std::vector<std::string> children);

/// `title` and `question` of a block at the top of a file.
struct Heading {
  std::string title, question;
};
Fields<Heading> heading_fields(std::string title, std::string question);

/// Up to a thousand numbers of one unit.
template <class Block>
language::LoadedField<Block> values_field(std::string_view name,
                                          const language::Field* Block::*member, std::string doc) {
  return list_field(name, "?", 1, 1000, member, std::move(doc));
}

template <class Block>
language::LoadedField<Block> may_be_empty_field(bool Block::*member, const std::string& what) {
  return boolean_field("may_be_empty", member, "whether it is no failure that " + what);
}

/// "no Sweep is called `slop`; did you mean slope?"
void report_unknown(const language::Position& position, std::string_view kind,
                    const std::string& name, const std::vector<std::string>& known,
                    language::Diagnostics& diagnostics);

/// The number in `unit`, in which a table shows what it is compared with; an error where its own
/// unit is of another kind.
double number_in(const language::Field& field, std::string_view unit,
                 language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
