#include "studies/report/latex_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "language/names.h"
#include "studies/results/pivot.h"
#include "studies/results/seed_means.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {
namespace {

using output::latex_number, output::latex_text, output::LatexTable;

/// Mean, with its interval where there are seeds, and closed form: "$1.2$ ($1.3$)".
std::string cell_text(const PivotCell& cell) {
  if (cell.rows == 0) return "";
  std::string text = latex_number(cell.interval ? cell.interval->mean : cell.mean);
  if (cell.interval) text += " $\\pm$ " + latex_number(cell.interval->half_width);
  if (cell.predicted) text += " (" + latex_number(cell.predicted) + ")";
  return text + (cell.failed > 0 ? output::latex_star : "");
}

std::string caption_of(const Pivot& pivot) {
  std::string caption = pivot.title + ".";
  if (!pivot.note.empty()) caption += " " + pivot.note + ".";
  if (pivot.predicted) caption += " In parentheses: closed form.";
  if (pivot.seeds > 0) caption += " Mean " + interval_note(pivot) + ".";
  if (std::ranges::any_of(pivot.cells, [](const PivotCell& cell) { return cell.failed > 0; }))
    caption += " *: a truth does not hold.";
  return caption;
}

LatexTable latex_pivot(const std::string& name, const Pivot& pivot) {
  LatexTable table{.name = name,
                   .label = name,
                   .caption = caption_of(pivot),
                   .across = latex_text(pivot.across),
                   .head = {latex_text(pivot.down)},
                   .text_columns = 1,
                   .rows = {}};
  for (const std::string& column : pivot.columns) table.head.push_back(latex_text(column));
  for (std::size_t row = 0; row < pivot.rows.size(); ++row) {
    table.rows.push_back({latex_text(pivot.rows[row])});
    for (std::size_t column = 0; column < pivot.columns.size(); ++column)
      table.rows.back().push_back(cell_text(pivot.at(row, column)));
  }
  return table;
}

/// The run to look at first with its closed form, or the median of several.
std::string summary_cell(const StudyResult& study, const MetricSummary& summary,
                         std::size_t metric) {
  if (summary.values == 0 || summary.worst < 0) return "--";
  const auto worst = static_cast<std::size_t>(summary.worst);
  const MetricValue& value = study.rows[worst].metrics[metric];
  const std::string text =
      value.predicted ? latex_number(value.measured) + " (" + latex_number(value.predicted) + ")"
                      : latex_number(summary.median);
  return text + (summary.failed > 0 ? output::latex_star : "");
}

/// So many metrics side by side fill a page's width.
constexpr std::size_t most_metrics = 5;

std::vector<LatexTable> summaries(const StudyResult& study) {
  std::vector<std::string> varied;
  for (const SweepColumn& sweep : study.sweeps) varied.push_back(spoken(sweep.name));
  std::vector<LatexTable> tables;
  for (const RegimeTable& regime : regime_tables(study))
    for (std::size_t first = 0; first < regime.metrics.size(); first += most_metrics) {
      std::string caption = study.title.empty() ? spoken(study.name) : study.title;
      if (!regime.heading.empty()) caption += ": " + regime.heading;
      caption +=
          ". With a closed form, in parentheses, the run that is farthest from it; else the "
          "median" +
          (varied.empty() ? "" : " over " + language::join(varied, ", ")) +
          ". *: a truth does not hold.";
      LatexTable table{.name = output::latex_summary,
                       .label = fmt::format("{}-{}", output::latex_summary, tables.size() + 1),
                       .caption = std::move(caption),
                       .across = "",
                       .head = {"subject"},
                       .text_columns = 1,
                       .rows = {}};
      const std::size_t end = std::min(first + most_metrics, regime.metrics.size());
      for (std::size_t i = first; i < end; ++i) {
        const MetricColumn& metric = study.metrics[regime.metrics[i]];
        table.head.push_back(latex_text(output::column_title(spoken(metric.name), metric.unit)));
      }
      for (const std::size_t subject : regime.subjects) {
        table.rows.push_back({latex_text(study.subjects[subject].name)});
        for (std::size_t i = first; i < end; ++i) {
          const std::size_t metric = regime.metrics[i];
          table.rows.back().push_back(
              summary_cell(study, regime.summary.subjects[subject].metrics[metric], metric));
        }
      }
      tables.push_back(std::move(table));
    }
  return tables;
}

std::string csv_cell(const std::string& cell) {
  double value = 0.;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool number = error == std::errc{} && end == cell.data() + cell.size();
  return number ? latex_number(value) : latex_text(cell);
}

}  // namespace

LatexTable latex_table_of(const std::string& name, const std::string& caption,
                          const output::CsvTable& table, std::size_t columns,
                          std::size_t text_columns) {
  LatexTable latex{.name = name,
                   .label = name,
                   .caption = caption,
                   .across = "",
                   .head = {},
                   .text_columns = text_columns,
                   .rows = {}};
  columns = std::min(columns, table.header.size());
  for (std::size_t i = 0; i < columns; ++i) latex.head.push_back(latex_text(table.header[i]));
  for (const std::vector<std::string>& row : table.rows) {
    latex.rows.emplace_back();
    for (std::size_t i = 0; i < columns; ++i) latex.rows.back().push_back(csv_cell(row[i]));
  }
  return latex;
}

std::vector<LatexTable> latex_tables(const StudyResult& study) {
  if (study.seed_sweep) return latex_tables(over_seeds(study));
  std::vector<LatexTable> tables;
  for (const TableSpec& spec : study.tables)
    tables.push_back(latex_pivot(spec.name, pivot_of(study, spec)));
  std::ranges::move(summaries(study), std::back_inserter(tables));
  return tables;
}

}  // namespace hookpoint::studies
