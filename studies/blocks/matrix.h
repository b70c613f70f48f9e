// Matrix blocks, with their Parts: studies of other files on one page.
#pragma once

#include <string>

#include "language/schema/schema.h"
#include "studies/blocks/block.h"

namespace hookpoint::studies {

/// A Part block as its file has it.
struct PartBlock {
  Placed<std::string> file;  ///< left out: studies/NAME.hook
  bool quick = true;         ///< whether it runs under --quick
};

void add_matrix_classes(language::Schema& schema);

Heading matrix_heading(const language::Object& matrix);
PartBlock part_block(const language::Object& part);
/// The file of a Matrix's Part, as it is looked up.
std::string part_file(const language::Object& part);

/// Of a block that runs other files.
template <class Block>
language::LoadedField<Block> quick_field(bool Block::*member) {
  return boolean_field("quick", member, "whether it runs under --quick too");
}

}  // namespace hookpoint::studies
