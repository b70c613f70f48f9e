#include "apps/cli/study_boards.h"

#include "studies/report/figures.h"
#include "studies/results/summary.h"

namespace hookpoint::cli {
namespace {

std::string word_of(studies::RunOutcome outcome) {
  switch (outcome) {
    case studies::RunOutcome::finished:
      return "finished";
    case studies::RunOutcome::expected:
      return "foretold";
    case studies::RunOutcome::stopped:
      return "stopped";
    case studies::RunOutcome::skipped:
      return "skipped";
    case studies::RunOutcome::refused:
      return "refused";
  }
  return "";
}

}  // namespace

view::BoardStudy board_of(const studies::StudyResult& table) {
  view::BoardStudy board;
  board.name = table.name;
  board.title = table.title.empty() ? studies::spoken(table.name) : table.title;
  board.question = table.question;
  const std::vector<int> styles = studies::subject_styles(table);
  for (std::size_t i = 0; i < table.subjects.size(); ++i)
    board.subjects.push_back(
        {table.subjects[i].name, styles[i], studies::composition(table.subjects[i])});
  for (const studies::SweepColumn& sweep : table.sweeps)
    board.columns.push_back({sweep.name, sweep.unit, true, sweep.words});
  for (const studies::MetricColumn& metric : table.metrics)
    board.columns.push_back({metric.name, metric.unit});
  for (const studies::RunResult& run : table.rows) {
    view::BoardRow row = board_row(run);
    row.outcome = row.status = "";
    board.rows.push_back(std::move(row));
  }
  board.progress.total = board.rows.size();
  for (std::size_t plot = 0; plot < table.plots.size(); ++plot)
    board.figures.push_back(board_figure(table, plot));
  return board;
}

view::BoardRow board_row(const studies::RunResult& run) {
  view::BoardRow row;
  row.subject = static_cast<std::size_t>(run.subject);
  row.varied = run.parameters;
  row.outcome = word_of(studies::outcome_of(run));
  row.status = run.status;
  for (const studies::MetricValue& value : run.metrics)
    row.cells.push_back({value.measured, value.predicted, value.ok});
  return row;
}

view::BoardFigure board_figure(const studies::StudyResult& study, std::size_t plot) {
  studies::Figure figure = studies::make_figure(study, plot);
  if (figure.map) return {figure.caption, std::move(*figure.map)};
  if (figure.panels) return {figure.caption, std::move(*figure.panels)};
  output::PanelPlot single{.name = figure.plot.name,
                           .title = figure.plot.title,
                           .subtitle = figure.plot.subtitle,
                           .across = 1,
                           .own_axes = false,
                           .panels = {figure.plot}};
  return {figure.caption, std::move(single)};
}

}  // namespace hookpoint::cli
