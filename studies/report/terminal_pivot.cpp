#include "studies/report/terminal_pivot.h"

#include <algorithm>

#include "studies/report/terminal_blocks.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

Cell pivot_value(const PivotCell& cell) {
  if (cell.rows == 0) return {"", Tone::faint};
  const Tone tone = cell.failed > 0 ? Tone::bad : cell.passed > 0 ? Tone::good : Tone::plain;
  if (!cell.mean) return {"-", cell.failed > 0 ? Tone::bad : Tone::faint};
  std::string text = cell.interval ? text_of(*cell.interval) : text::rounded(*cell.mean);
  if (const auto spread = spread_of(cell); spread && !cell.interval)
    text += " (" + spread->first + " .. " + spread->second + ")";
  if (cell.predicted) text += " / " + text::rounded(*cell.predicted);
  return {text, tone};
}

Cell pivot_difference(const PivotCell& cell) {
  return cell.difference ? Cell{text_of(*cell.difference)} : Cell{"", Tone::faint};
}

bool has_differences(const Pivot& pivot) {
  return std::ranges::any_of(pivot.cells,
                             [](const PivotCell& cell) { return cell.difference.has_value(); });
}

/// A side of the table without the lines in which `text_of_cell` gives nothing.
std::vector<std::size_t> filled(std::size_t lines, std::size_t across, const auto& text_of_cell) {
  std::vector<std::size_t> kept;
  for (std::size_t line = 0; line < lines; ++line) {
    bool any = false;
    for (std::size_t i = 0; i < across; ++i) any = any || !text_of_cell(line, i).text.empty();
    if (any) kept.push_back(line);
  }
  return kept;
}

/// Rows and columns in which some cell has a text, as many columns side by side as fit.
std::string print_cells(const Pivot& pivot, Cell (*cell_text)(const PivotCell&),
                        const TableStyle& style) {
  const auto cell = [&](std::size_t row, std::size_t column) {
    return cell_text(pivot.at(row, column));
  };
  const auto rows = filled(pivot.rows.size(), pivot.columns.size(), cell);
  const auto shown_columns =
      filled(pivot.columns.size(), pivot.rows.size(),
             [&](std::size_t column, std::size_t row) { return cell(row, column); });
  ColumnGroup names;
  names.rows.push_back({{pivot.down, Tone::faint, false}});
  for (const std::size_t row : rows) names.rows.push_back({{pivot.rows[row], Tone::plain, false}});
  names.measure();
  std::vector<ColumnGroup> columns;
  for (const std::size_t column : shown_columns) {
    ColumnGroup& group = columns.emplace_back();
    group.rows.push_back({{pivot.columns[column], Tone::faint}});
    for (const std::size_t row : rows) group.rows.push_back({cell(row, column)});
    group.measure();
  }
  std::string text;
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

/// In lines that fit.
std::string note_lines(const std::string& note, const TableStyle& style) {
  const std::string lines = wrapped(note, style.width);
  return toned(lines.substr(0, lines.size() - 1), Tone::faint, style.color) + "\n";
}

}  // namespace

std::string terminal_pivot(const Pivot& pivot, const TableStyle& style) {
  std::string text =
      wrapped(pivot.title + " by " + pivot.down + " and " + pivot.across, style.width);
  std::string note = pivot.note;
  const auto add = [&](const std::string& what) { note += (note.empty() ? "" : "; ") + what; };
  if (pivot.several && pivot.seeds == 0) add("mean (least .. largest)");
  if (pivot.seeds > 0) add(interval_note(pivot));
  if (pivot.predicted) add("measured / closed form");
  if (!note.empty()) text += note_lines(note, style);
  text += print_cells(pivot, pivot_value, style);
  if (!has_differences(pivot)) return text;
  text += note_lines("difference to " + pivot.first + ", paired by seed", style);
  return text + print_cells(pivot, pivot_difference, style);
}

}  // namespace hookpoint::studies
