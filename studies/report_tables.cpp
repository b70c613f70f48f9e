#include "studies/report_tables.h"

#include <algorithm>
#include <array>

#include "output/number.h"
#include "output/plot.h"
#include "studies/report_page.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t most_rows = 5000;
constexpr std::size_t most_failures = 40;

/// What a metric's columns have to show, over all subjects.
struct MetricShape {
  bool predicted = false, verdict = false;
};

std::vector<MetricShape> shapes_of(const StudyResult& study) {
  std::vector<MetricShape> shapes(study.metrics.size());
  for (const RunResult& row : study.rows) {
    for (std::size_t i = 0; i < row.metrics.size(); ++i) {
      shapes[i].predicted |= row.metrics[i].predicted.has_value();
      shapes[i].verdict |= row.metrics[i].ok.has_value();
    }
  }
  return shapes;
}

std::string number(const std::optional<double>& value) {
  return value ? output::rounded(*value) : "<span class=\"soft\">–</span>";
}

std::string unit_of(const std::string& unit) { return unit.empty() ? "" : " [" + html(unit) + "]"; }

/// The subject's marker in its colour, as in the figures.
std::string swatch(std::size_t subject) {
  const output::SeriesStyle style = output::series_style(static_cast<int>(subject));
  const std::string name = std::array{"■", "●", "▲", "▼", "◆", "⬟"}[(style.filled_marker - 5) / 2];
  return "<span class=\"swatch\" style=\"color:" + style.color + "\">" + name + "</span>";
}

std::string verdict_text(const MetricSummary& metric) {
  const int all = metric.passed + metric.failed;
  if (all == 0) return "";
  const std::string count = std::to_string(metric.passed) + "/" + std::to_string(all);
  return metric.failed == 0 ? "<small class=\"good\">✓ " + count + "</small>"
                            : "<small class=\"bad\">✗ " + count + "</small>";
}

std::string metric_cells(const StudyResult& study, const MetricSummary& summary, std::size_t metric,
                         const MetricShape& shape) {
  const std::string fails = summary.failed > 0 ? " fails" : "";
  if (!shape.predicted) {
    std::string cell = "<td class=\"first" + fails + "\">";
    cell += number(summary.values > 0 ? std::optional(summary.median) : std::nullopt);
    if (summary.least < summary.largest)
      cell += "<small>" + output::rounded(summary.least, 3) + " … " +
              output::rounded(summary.largest, 3) + "</small>";
    return cell + verdict_text(summary) + "</td>";
  }
  if (summary.worst < 0)
    return "<td class=\"first\">" + number({}) + "</td><td>" + number({}) + "</td>";
  const RunResult& row = study.rows[static_cast<std::size_t>(summary.worst)];
  const MetricValue& worst = row.metrics[metric];
  std::string cells = "<td class=\"first" + fails + "\" title=\"" +
                      html(parameters_text(study, row)) + "\">" + number(worst.measured);
  if (summary.values > 1)
    cells += "<small>median " + output::rounded(summary.median, 3) + "</small>";
  return cells + "</td><td class=\"" + fails + "\">" + number(worst.predicted) +
         verdict_text(summary) + "</td>";
}

std::string finished_cell(const SubjectSummary& subject) {
  if (subject.rows() > 0 && subject.skipped == subject.rows())
    return "<td class=\"soft\">skipped</td>";
  const std::string count = std::to_string(subject.finished) + "/" + std::to_string(subject.rows());
  return subject.stopped > 0 ? "<td class=\"bad\">✗ " + count + "</td>" : "<td>" + count + "</td>";
}

std::string summary_head(const StudyResult& study, const std::vector<MetricShape>& shapes) {
  std::string groups = "<tr class=\"groups\"><th></th><th></th>";
  std::string columns = "<tr class=\"units\"><th class=\"text\">subject</th><th>runs</th>";
  for (std::size_t i = 0; i < study.metrics.size(); ++i) {
    const std::string span = shapes[i].predicted ? " colspan=\"2\"" : "";
    groups += "<th class=\"first\"" + span + ">" + html(spoken(study.metrics[i].name)) +
              "<span class=\"soft\">" + unit_of(study.metrics[i].unit) + "</span></th>";
    columns += shapes[i].predicted ? "<th class=\"first\">worst</th><th>closed form</th>"
                                   : "<th class=\"first\">median</th>";
  }
  return "<thead>" + groups + "</tr>\n" + columns + "</tr></thead>\n";
}

std::string verdict_cell(const MetricValue& value) {
  if (!value.ok) return "<td></td>";
  return *value.ok ? "<td class=\"good\">✓</td>" : "<td class=\"bad fails\">✗</td>";
}

/// Words for the filter: fails, stopped, skipped, ok.
std::string kinds_of(const RunResult& row) {
  std::string kinds;
  const bool fails = std::any_of(row.metrics.begin(), row.metrics.end(),
                                 [](const MetricValue& value) { return !value.ok.value_or(true); });
  if (fails) kinds += "fails ";
  switch (outcome_of(row)) {
    case RunOutcome::finished:
      return kinds + "finished";
    case RunOutcome::stopped:
      return kinds + "stopped";
    case RunOutcome::skipped:
      return kinds + "skipped";
  }
  return kinds;
}

std::string sorted_head(const std::string& style, const std::string& content) {
  return "<th data-sorts=\"\" class=\"" + style + "\">" + content + "</th>";
}

std::string runs_head(const StudyResult& study, const std::vector<MetricShape>& shapes) {
  std::string head = "<thead><tr>";
  for (const SweepColumn& sweep : study.sweeps)
    head += sorted_head(
        "", html(spoken(sweep.name)) + "<span class=\"soft\">" + unit_of(sweep.unit) + "</span>");
  head += sorted_head("text", "subject");
  for (std::size_t i = 0; i < study.metrics.size(); ++i) {
    head += sorted_head("first", html(spoken(study.metrics[i].name)) + "<span class=\"soft\">" +
                                     unit_of(study.metrics[i].unit) + "</span>");
    if (shapes[i].predicted) head += sorted_head("", "closed form");
    if (shapes[i].verdict) head += "<th></th>";
  }
  return head + sorted_head("text", "status") + "</tr></thead>\n";
}

std::string run_row(const StudyResult& study, const std::vector<MetricShape>& shapes,
                    const RunResult& row) {
  std::string text = "<tr data-kind=\"" + kinds_of(row) + "\">";
  for (const double value : row.parameters) text += "<td>" + output::rounded(value, 6) + "</td>";
  text += "<td class=\"text\">" + html(study.subjects[static_cast<std::size_t>(row.subject)].name) +
          "</td>";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const MetricValue value = i < row.metrics.size() ? row.metrics[i] : MetricValue{};
    text += "<td class=\"first\">" + number(value.measured) + "</td>";
    if (shapes[i].predicted) text += "<td>" + number(value.predicted) + "</td>";
    if (shapes[i].verdict) text += verdict_cell(value);
  }
  const bool stopped = outcome_of(row) == RunOutcome::stopped;
  return text + "<td class=\"status" + (stopped ? " bad" : " soft") + "\">" + html(row.status) +
         "</td></tr>\n";
}

}  // namespace

std::string summary_table(const StudyResult& study, const StudySummary& summary) {
  const std::vector<MetricShape> shapes = shapes_of(study);
  std::string text = "<div class=\"scroll\" tabindex=\"0\"><table class=\"summary\">\n" +
                     summary_head(study, shapes) + "<tbody>\n";
  for (std::size_t i = 0; i < study.subjects.size(); ++i) {
    const SubjectInfo& subject = study.subjects[i];
    text += "<tr><th scope=\"row\">" + swatch(i) + html(subject.name) + "<small>" +
            html(composition(subject)) + "</small></th>" + finished_cell(summary.subjects[i]);
    for (std::size_t metric = 0; metric < study.metrics.size(); ++metric)
      text += metric_cells(study, summary.subjects[i].metrics[metric], metric, shapes[metric]);
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
  return text +
         "<p class=\"note soft\">Worst: the run whose truth fails, else the one farthest from its "
         "closed form; the closed "
         "form beside it is that run's own. Small figures: median, or range, over the sweep.</p>\n";
}

std::string failure_table(const StudyResult& study) {
  const std::vector<Failure> failures = failures_of(study);
  std::string rows;
  for (std::size_t i = 0; i < std::min(failures.size(), most_failures); ++i) {
    const RunResult& row = study.rows[static_cast<std::size_t>(failures[i].row)];
    const auto metric = static_cast<std::size_t>(failures[i].metric);
    rows += "<tr><td class=\"text\">" +
            html(study.subjects[static_cast<std::size_t>(row.subject)].name) +
            "</td><td class=\"text\">" + html(parameters_text(study, row)) +
            "</td><td class=\"text\">" + html(spoken(study.metrics[metric].name)) +
            unit_of(study.metrics[metric].unit) + "</td><td>" +
            number(row.metrics[metric].measured) + "</td><td>" +
            number(row.metrics[metric].predicted) + "</td><td class=\"status\">" +
            html(row.status) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  std::string text =
      "<h2>What does not hold</h2>\n<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th "
      "class=\"text\">subject"
      "</th><th class=\"text\">at</th><th class=\"text\">metric</th><th>measured</th><th>closed "
      "form</th>"
      "<th class=\"text\">status</th></tr></thead><tbody>\n" +
      rows + "</tbody></table></div>\n";
  if (failures.size() > most_failures)
    text += "<p>and " + std::to_string(failures.size() - most_failures) +
            " more, among the runs below.</p>\n";
  return text;
}

std::string runs_table(const StudyResult& study) {
  const std::vector<MetricShape> shapes = shapes_of(study);
  const bool all = study.rows.size() <= most_rows;
  std::string rows;
  std::size_t listed = 0;
  for (const RunResult& row : study.rows) {
    const std::string kinds = kinds_of(row);
    if (listed == most_rows || (!all && kinds != "fails finished" && !kinds.ends_with("stopped")))
      continue;
    rows += run_row(study, shapes, row);
    ++listed;
  }
  std::string text;
  if (!all)
    text += "<p>" + std::to_string(listed) + " of " + std::to_string(study.rows.size()) +
            " runs: those that fail a truth or stopped. results.csv holds every one.</p>\n";
  text +=
      "<div class=\"filter\" hidden><label>Filter <input type=\"search\" placeholder=\"words\" "
      "size=\"24\"></label>"
      "<label>Show <select><option value=\"\">all</option><option value=\"fails\">truth "
      "fails</option>"
      "<option value=\"stopped\">stopped</option><option value=\"skipped\">skipped</option>"
      "<option value=\"finished\">finished</option></select></label><output></output></div>\n";
  return text + "<div class=\"scroll tall\" tabindex=\"0\"><table class=\"runs\">\n" +
         runs_head(study, shapes) + "<tbody>\n" + rows + "</tbody></table></div>\n";
}

}  // namespace hookpoint::studies
