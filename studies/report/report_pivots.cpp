#include "studies/report/report_pivots.h"

#include <fmt/format.h>

#include "studies/report/page_parts.h"
#include "studies/report/report_page.h"
#include "studies/results/pivot.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

std::string pivot_cell(const PivotCell& cell) {
  if (cell.rows == 0) return "<td></td>";
  std::string text =
      fmt::format("<td class=\"first{}\">{}", cell.failed > 0 ? " fails" : "",
                  cell.interval ? text_of(*cell.interval) : text::rounded(cell.mean, "–"));
  if (cell.difference)
    text += fmt::format("<small>difference {}</small>", text_of(*cell.difference));
  if (const auto spread = spread_of(cell); spread && !cell.interval)
    text += fmt::format("<small>{} … {}</small>", spread->first, spread->second);
  if (cell.predicted)
    text += fmt::format("<small>closed form {}</small>", text::rounded(*cell.predicted));
  if (cell.values < cell.rows)
    text += fmt::format("<small>{} of {} runs have a value</small>", cell.values, cell.rows);
  if (const int all = cell.passed + cell.failed; all > 0)
    text += fmt::format("<small class=\"{}\">{} {}/{}</small>", cell.failed == 0 ? "good" : "bad",
                        cell.failed == 0 ? "✓" : "✗", cell.passed, all);
  return text + "</td>";
}

}  // namespace

std::string pivot_tables(const StudyResult& study) {
  std::string text;
  for (const TableSpec& spec : shown_tables(study)) {
    const Pivot pivot = pivot_of(study, spec);
    text +=
        section(pivot.title) + (pivot.note.empty() ? "" : text_block("facts", html(pivot.note)));
    text += fmt::format(
        "<div class=\"scroll\" tabindex=\"0\"><table class=\"summary\"><thead>"
        "<tr class=\"groups\"><th></th><th class=\"first\" colspan=\"{}\">{}</th></tr>\n"
        "<tr class=\"units\"><th class=\"text\">{}</th>",
        pivot.columns.size(), html(pivot.across), html(pivot.down));
    for (const std::string& column : pivot.columns)
      text += "<th class=\"first\">" + html(column) + "</th>";
    text += "</tr></thead><tbody>\n";
    for (std::size_t row = 0; row < pivot.rows.size(); ++row) {
      text += "<tr><th scope=\"row\">" + html(pivot.rows[row]) + "</th>";
      for (std::size_t column = 0; column < pivot.columns.size(); ++column)
        text += pivot_cell(pivot.at(row, column));
      text += "</tr>\n";
    }
    text += "</tbody></table></div>\n";
    if (pivot.seeds > 0)
      text += text_block(
          "note soft",
          html("Mean " + interval_note(pivot) +
               (pivot.first.empty() ? "" : "; difference to " + pivot.first + ", paired by seed") +
               "."));
    if (pivot.several && pivot.seeds == 0)
      text += text_block("note soft",
                         "Where several runs fall into a cell: their mean, below it the least and "
                         "the largest.");
  }
  return text;
}

}  // namespace hookpoint::studies
