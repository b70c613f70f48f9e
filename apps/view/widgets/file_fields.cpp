#include "apps/view/widgets/file_fields.h"

#include "apps/view/widgets/schema.h"
#include "language/tree/print.h"

namespace hookpoint::view {
namespace {

using language::FieldType;

bool can_be_edited(const language::FieldSchema& field) {
  return field.type != FieldType::object && field.type != FieldType::port &&
         field.type != FieldType::words && field.type != FieldType::formula;
}

void collect(const language::Object& root, const language::Object& object,
             std::vector<FileField>& fields) {
  for (const language::FieldSchema& schema : object.schema->fields) {
    const language::Field* field = object.find(schema.name);
    if (field == nullptr || !schema.setting || !can_be_edited(schema)) continue;
    const std::string& unit = object.unit_of(schema);
    fields.push_back({object.trail() + "." + schema.name,
                      language::print_value(root, object, *field), unit == "?" ? "" : unit,
                      schema.doc});
  }
  for (const auto& child : object.children)
    if (!is_widget(child->type)) collect(root, *child, fields);
}

}  // namespace

std::vector<FileField> file_fields(const language::Object& root) {
  std::vector<FileField> fields;
  for (const auto& child : root.children)
    if (!child->implicit && !is_widget(child->type)) collect(root, *child, fields);
  return fields;
}

}  // namespace hookpoint::view
