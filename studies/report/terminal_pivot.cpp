#include "studies/report/terminal_pivot.h"

#include <algorithm>

#include "output/text/number.h"
#include "studies/report/terminal_blocks.h"

namespace hookpoint::studies {
namespace {

Cell pivot_value(const PivotCell& cell) {
  if (cell.rows == 0) return {"", Tone::faint};
  const Tone tone = cell.failed > 0 ? Tone::bad : cell.passed > 0 ? Tone::good : Tone::plain;
  if (!cell.mean) return {"-", cell.failed > 0 ? Tone::bad : Tone::faint};
  std::string text = cell.interval ? text_of(*cell.interval) : output::rounded(*cell.mean);
  if (cell.difference) text += ", difference " + text_of(*cell.difference);
  if (const auto spread = spread_of(cell); spread && !cell.interval)
    text += " (" + spread->first + " .. " + spread->second + ")";
  if (cell.predicted) text += " / " + output::rounded(*cell.predicted);
  return {text, tone};
}

}  // namespace

std::string terminal_pivot(const Pivot& pivot, const TableStyle& style) {
  ColumnGroup names;
  names.rows.push_back({{pivot.down, Tone::faint, false}});
  for (const std::string& row : pivot.rows) names.rows.push_back({{row, Tone::plain, false}});
  names.measure();
  std::vector<ColumnGroup> columns;
  for (std::size_t column = 0; column < pivot.columns.size(); ++column) {
    ColumnGroup& group = columns.emplace_back();
    group.rows.push_back({{pivot.columns[column], Tone::faint}});
    for (std::size_t row = 0; row < pivot.rows.size(); ++row)
      group.rows.push_back({pivot_value(pivot.at(row, column))});
    group.measure();
  }
  std::string text = pivot.title + " by " + pivot.down + " and " + pivot.across + "\n";
  std::string note = pivot.note;
  const auto add = [&](const char* what) {
    note += (note.empty() ? "" : "; ") + std::string(what);
  };
  if (pivot.several && pivot.seeds == 0) add("mean (least .. largest)");
  if (pivot.seeds > 0) add(interval_note(pivot).c_str());
  if (pivot.predicted) add("behind / the closed form");
  if (!note.empty()) text += toned(note, Tone::faint, style.color) + "\n";
  for (std::size_t next = 0; next < columns.size();) {
    std::vector<const ColumnGroup*> shown{&names};
    do shown.push_back(&columns[next++]);
    while (next < columns.size() &&
           printed_width(shown) + printed_width({&names, &columns[next]}) - names.width() <=
               style.width);
    text += print_groups(shown, style.color);
  }
  return text;
}

}  // namespace hookpoint::studies
