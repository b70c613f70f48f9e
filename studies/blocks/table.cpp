#include "studies/blocks/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "output/latex/latex.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/subject.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

struct TableBlock {
  std::string title;
  Placed<std::string> rows, columns, value;
  Placed<std::vector<std::string>> subjects;
  bool may_be_empty = false;
};

const Fields<TableBlock>& table_fields() {
  static const Fields<TableBlock> fields{
      text_field("title", &TableBlock::title, "heading; default: the metric"),
      required(words_field("rows", 1, &TableBlock::rows, "what runs down: subject, or a sweep")),
      required(
          words_field("columns", 1, &TableBlock::columns, "what runs across: subject, or a sweep")),
      required(words_field("value", 1, &TableBlock::value, "the metric in the cells")),
      words_field("subjects", 100, &TableBlock::subjects, "subjects that enter; default: all"),
      may_be_empty_field(&TableBlock::may_be_empty, "no run of it has a value")};
  return fields;
}

/// Whether the field names a sweep or is `subject`; if not, an error.
bool is_table_side(const Placed<std::string>& name, const StudyParts& so_far,
                   Diagnostics& diagnostics) {
  if (*name == "subject" || so_far.sweep_index(*name) >= 0) return true;
  std::vector<std::string> known = so_far.sweep_names();
  known.emplace_back("subject");
  report_unknown(name.position(), "Sweep", *name, known, diagnostics);
  return false;
}

}  // namespace

void add_table_class(language::Schema& schema) {
  language::ClassSchema table = block_class(
      "Table", "A metric over two of what the study varied, each cell the mean of its runs.",
      schemas(table_fields()), {"Only"});
  table.only_in = "Study";
  schema.add(std::move(table));
}

TableSpec load_table(const Object& object, const StudyParts& so_far, Diagnostics& diagnostics) {
  const TableBlock block = load_fields(object, table_fields());
  TableSpec table;
  table.name = object.name;
  const auto has_name = [&](const PlotPlan& plot) { return plot.spec.name == table.name; };
  if (std::ranges::find(table_names, table.name) != table_names.end() ||
      std::ranges::any_of(so_far.plots, has_name))
    diagnostics.error(
        object.position,
        fmt::format("the study leaves another {}.csv; give the Table another name", table.name));
  if (std::ranges::find(output::latex_names, table.name) != output::latex_names.end())
    diagnostics.error(
        object.position,
        fmt::format("the study itself leaves {}.tex; give the Table another name", table.name));
  table.title = block.title;
  table.rows = *block.rows;
  table.columns = *block.columns;
  table.value = *block.value;
  const bool rows = is_table_side(block.rows, so_far, diagnostics);
  const bool columns = is_table_side(block.columns, so_far, diagnostics);
  if (rows && columns && table.rows == table.columns)
    diagnostics.error(block.columns.position(),
                      fmt::format("`{}` already runs down the rows", table.columns));
  metric_unit(block.value, so_far, diagnostics);
  table.subjects = named_subjects(block.subjects.field, so_far, diagnostics);
  table.where = so_far.admitted(load_conditions(object, so_far, diagnostics));
  table.may_be_empty = block.may_be_empty;
  return table;
}

}  // namespace hookpoint::studies
