#include "studies/blocks/matrix.h"

namespace hookpoint::studies {

namespace {

const Fields<Heading>& matrix_fields() {
  static const Fields<Heading> fields =
      heading_fields("heading of the page", "what the matrix shows, first thing in the page");
  return fields;
}

const Fields<PartBlock>& part_fields() {
  static const Fields<PartBlock> fields{
      text_field("file", &PartBlock::file, "if not studies/NAME.hook"),
      quick_field(&PartBlock::quick)};
  return fields;
}

}  // namespace

void add_matrix_classes(language::Schema& schema) {
  schema.add(
      top_block_class("Matrix",
                      "Studies of other files, run one after the other and shown in one page "
                      "of subjects, scenes and metrics.",
                      schemas(matrix_fields()), {"Part"}));
  schema.add(block_class("Part",
                         "The studies of a file in a Matrix, by the name of the file in studies/.",
                         schemas(part_fields())));
}

Heading matrix_heading(const language::Object& matrix) {
  return load_fields(matrix, matrix_fields());
}

PartBlock part_block(const language::Object& part) { return load_fields(part, part_fields()); }

std::string part_file(const language::Object& part) {
  const Placed<std::string> file = part_block(part).file;
  return file ? *file : "studies/" + part.name + ".hook";
}

}  // namespace hookpoint::studies
