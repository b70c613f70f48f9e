// Table blocks: which metric over what.
#include <fmt/format.h>

#include <algorithm>

#include "studies/plan/plan_builder.h"

namespace hookpoint::studies {

using language::Object;

bool PlanBuilder::is_table_side(const Object& block, const char* field) {
  const std::string& name = block.word(field);
  if (name == "subject" || sweep_index(name) >= 0) return true;
  std::vector<std::string> known = sweep_names();
  known.emplace_back("subject");
  unknown(block.find(field)->position, "Sweep", name, known);
  return false;
}

void PlanBuilder::add_table(const Object& block) {
  TableSpec table;
  table.name = block.name;
  const auto has_name = [&](const auto& other) { return other.name == table.name; };
  if (std::ranges::find(table_names, table.name) != table_names.end() ||
      std::ranges::any_of(plan_.plots, [&](const PlotPlan& plot) { return has_name(plot.spec); }))
    diagnostics_.error(
        block.position,
        fmt::format("the study leaves another {}.csv; give the Table another name", table.name));
  if (block.find("title") != nullptr) table.title = block.word("title");
  table.rows = block.word("rows");
  table.columns = block.word("columns");
  table.value = block.word("value");
  const bool rows = is_table_side(block, "rows"), columns = is_table_side(block, "columns");
  if (rows && columns && table.rows == table.columns)
    diagnostics_.error(block.find("columns")->position,
                       fmt::format("`{}` already runs down the rows", table.columns));
  metric_unit(block, "value");
  table.subjects = named_subjects(block);
  table.where = plan_.admitted(conditions(block));
  table.may_be_empty = block.boolean("may_be_empty");
  plan_.tables.push_back(std::move(table));
}

}  // namespace hookpoint::studies
