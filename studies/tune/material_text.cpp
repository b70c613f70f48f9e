#include "studies/tune/material_text.h"

#include <fmt/format.h>

#include "output/figures/plot.h"
#include "output/text/number.h"

namespace hookpoint::studies {
namespace {

/// In SI; "1/m" is no unit that a file may write after a number.
std::string field_line(const language::Field& field) {
  const std::string& unit = field.schema->unit;
  const bool named = !unit.empty() && (unit.front() < '0' || unit.front() > '9');
  return fmt::format("  {} = {}{};\n", field.schema->name, output::shortest(field.numbers.front()),
                     named ? " " + unit : "");
}

}  // namespace

std::string comment_line(const std::string& text) { return "// " + output::one_line(text) + "\n"; }

std::string material_block(const language::Object& material, const std::string& name) {
  std::string text = "Material " + name + " {\n";
  for (const language::Field& field : material.fields)
    if (!field.numbers.empty()) text += field_line(field);
  return text + "}\n";
}

}  // namespace hookpoint::studies
