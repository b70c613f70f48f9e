#include "studies/blocks/block.h"

#include <fmt/format.h>

#include "language/names.h"
#include "language/units.h"

namespace hookpoint::studies {

language::ClassSchema block_class(std::string name, std::string doc,
                                  std::vector<language::FieldSchema> fields,
                                  std::vector<std::string> children) {
  language::ClassSchema schema;
  schema.name = std::move(name);
  schema.doc = std::move(doc);
  schema.fields = std::move(fields);
  schema.children = std::move(children);
  schema.naming = language::Naming::required;
  schema.names_a_subject = true;
  return schema;
}

language::ClassSchema top_block_class(std::string name, std::string doc,
                                      std::vector<language::FieldSchema> fields,
                                      std::vector<std::string> children) {
  language::ClassSchema schema =
      block_class(std::move(name), std::move(doc), std::move(fields), std::move(children));
  schema.names_a_subject = false;
  schema.top_level = true;
  return schema;
}

Fields<Heading> heading_fields(std::string title, std::string question) {
  return {text_field("title", &Heading::title, std::move(title)),
          text_field("question", &Heading::question, std::move(question))};
}

void report_unknown(const language::Position& position, std::string_view kind,
                    const std::string& name, const std::vector<std::string>& known,
                    language::Diagnostics& diagnostics) {
  diagnostics.error(position, fmt::format("no {} is called `{}`{}", kind, name,
                                          language::did_you_mean(name, known)));
}

double number_in(const language::Field& field, std::string_view unit,
                 language::Diagnostics& diagnostics) {
  const std::optional<language::Unit> expected = language::parse_unit(unit);
  if (expected && !language::fits(field.dimension, expected->dimension))
    diagnostics.error(field.position, fmt::format("`{}` is in {}, not {}", field.schema->name,
                                                  language::describe_dimension(expected->dimension),
                                                  language::describe_dimension(field.dimension)));
  return field.numbers.at(0) * (expected ? expected->denominator / expected->numerator : 1.);
}

}  // namespace hookpoint::studies
