#include "studies/report/report_tables.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "output/figures/plot.h"
#include "studies/report/figures.h"
#include "studies/report/report_page.h"
#include "studies/results/selection.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t most_rows = 5000;
constexpr std::size_t most_listed = 40;
constexpr std::size_t page_columns = 6;

/// Which columns a metric needs beside its measurement: those that some row has values for.
struct NeededColumns {
  bool predicted = false, verdict = false;
};

std::vector<NeededColumns> needed_columns(const StudyResult& study,
                                          std::optional<Regime> regime = {}) {
  std::vector<NeededColumns> needed(study.metrics.size());
  for (const RunResult& row : study.rows) {
    if (regime && row.regime != *regime) continue;
    for (std::size_t i = 0; i < row.metrics.size(); ++i) {
      needed[i].predicted |= row.metrics[i].predicted.has_value();
      needed[i].verdict |= row.metrics[i].ok.has_value();
    }
  }
  return needed;
}

std::string number(const std::optional<double>& value) {
  return text::rounded(value, "<span class=\"soft\">–</span>");
}

std::string unit_of(const std::string& unit) { return unit.empty() ? "" : " [" + html(unit) + "]"; }

bool fails_or_stopped(const RunResult& row) {
  return outcome_of(row) == RunOutcome::stopped ||
         std::any_of(row.metrics.begin(), row.metrics.end(),
                     [](const MetricValue& value) { return !value.ok.value_or(true); });
}

/// `text` as a link to the row in the table of all runs, if it is there.
std::string run_link(const StudyResult& study, std::size_t row, const std::string& text) {
  if (study.rows.size() > most_rows && !fails_or_stopped(study.rows[row])) return text;
  return "<a href=\"#run-" + std::to_string(row) + "\">" + text + "</a>";
}

std::string table_head(std::initializer_list<const char*> titles) {
  std::string head = "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>";
  for (const char* title : titles) head += std::string("<th class=\"text\">") + title + "</th>";
  return head + "</tr></thead><tbody>\n";
}

std::string text_cell(const std::string& content) {
  return "<td class=\"text\">" + content + "</td>";
}

std::string and_more(std::size_t all) {
  if (all <= most_listed) return "";
  return "<p>and " + std::to_string(all - most_listed) + " more, among the runs below.</p>\n";
}

std::string verdict_text(const MetricSummary& metric) {
  const int all = metric.passed + metric.failed;
  if (all == 0) return "";
  const std::string count = std::to_string(metric.passed) + "/" + std::to_string(all);
  return metric.failed == 0 ? "<small class=\"good\">✓ " + count + "</small>"
                            : "<small class=\"bad\">✗ " + count + "</small>";
}

std::string metric_cells(const StudyResult& study, const MetricSummary& summary, std::size_t metric,
                         const NeededColumns& shape) {
  const std::string fails = summary.failed > 0 ? " fails" : "";
  if (!shape.predicted) {
    std::string cell = "<td class=\"first" + fails + "\">";
    cell += number(summary.values > 0 ? std::optional(summary.median) : std::nullopt);
    if (summary.least < summary.largest)
      cell += "<small>" + text::rounded(summary.least, 3) + " … " +
              text::rounded(summary.largest, 3) + "</small>";
    return cell + verdict_text(summary) + "</td>";
  }
  if (summary.worst < 0)
    return "<td class=\"first\">" + number({}) + "</td><td>" + number({}) + "</td>";
  const RunResult& row = study.rows[static_cast<std::size_t>(summary.worst)];
  const MetricValue& worst = row.metrics[metric];
  std::string cells =
      "<td class=\"first" + fails + "\" title=\"" + html(parameters_text(study, row)) + "\">" +
      run_link(study, static_cast<std::size_t>(summary.worst), number(worst.measured));
  if (summary.values > 1) cells += "<small>median " + text::rounded(summary.median, 3) + "</small>";
  return cells + "</td><td class=\"" + fails + "\">" + number(worst.predicted) +
         verdict_text(summary) + "</td>";
}

std::string finished_cell(const SubjectSummary& subject) {
  if (subject.rows() > 0 && subject.skipped == subject.rows())
    return "<td class=\"soft\">skipped</td>";
  if (subject.rows() > 0 && subject.refused == subject.rows())
    return "<td class=\"soft\">refused</td>";
  const std::string count = std::to_string(subject.finished) + "/" + std::to_string(subject.rows());
  return subject.stopped > 0 ? "<td class=\"bad\">✗ " + count + "</td>" : "<td>" + count + "</td>";
}

std::string summary_head(const StudyResult& study, const std::vector<std::size_t>& metrics,
                         const std::vector<NeededColumns>& needed) {
  std::string groups = "<tr class=\"groups\"><th></th><th></th>";
  std::string columns = "<tr class=\"units\"><th class=\"text\">subject</th><th>runs</th>";
  for (const std::size_t i : metrics) {
    const std::string span = needed[i].predicted ? " colspan=\"2\"" : "";
    groups += "<th class=\"first\"" + span + ">" + html(spoken(study.metrics[i].name)) +
              "<span class=\"soft\">" + unit_of(study.metrics[i].unit) + "</span></th>";
    columns += needed[i].predicted ? "<th class=\"first\">worst</th><th>closed form</th>"
                                   : "<th class=\"first\">median</th>";
  }
  return "<thead>" + groups + "</tr>\n" + columns + "</tr></thead>\n";
}

std::string verdict_cell(const MetricValue& value) {
  if (!value.ok) return "<td></td>";
  return *value.ok ? "<td class=\"good\">✓</td>" : "<td class=\"bad fails\">✗</td>";
}

/// Words for the filter: fails, stopped, expected, skipped, finished.
std::string kinds_of(const RunResult& row) {
  std::string kinds;
  if (std::any_of(row.metrics.begin(), row.metrics.end(),
                  [](const MetricValue& value) { return !value.ok.value_or(true); }))
    kinds += "fails ";
  switch (outcome_of(row)) {
    case RunOutcome::finished:
      return kinds + "finished";
    case RunOutcome::expected:
      return kinds + "expected";
    case RunOutcome::stopped:
      return kinds + "stopped";
    case RunOutcome::skipped:
      return kinds + "skipped";
    case RunOutcome::refused:
      return kinds + "refused";
  }
  return kinds;
}

std::string sorted_head(const std::string& style, const std::string& content) {
  return "<th data-sorts=\"\" class=\"" + style + "\">" + content + "</th>";
}

std::string runs_head(const StudyResult& study, const std::vector<NeededColumns>& needed) {
  std::string head = "<thead><tr>";
  for (const SweepColumn& sweep : study.sweeps)
    head += sorted_head(
        "", html(spoken(sweep.name)) + "<span class=\"soft\">" + unit_of(sweep.unit) + "</span>");
  head += sorted_head("text", "subject");
  for (std::size_t i = 0; i < study.metrics.size(); ++i) {
    head += sorted_head("first", html(spoken(study.metrics[i].name)) + "<span class=\"soft\">" +
                                     unit_of(study.metrics[i].unit) + "</span>");
    if (needed[i].predicted) head += sorted_head("", "closed form");
    if (needed[i].verdict) head += "<th></th>";
  }
  return head + sorted_head("text", "status") + "</tr></thead>\n";
}

std::string run_row(const StudyResult& study, const std::vector<NeededColumns>& needed,
                    std::size_t index) {
  const RunResult& row = study.rows[index];
  std::string text =
      "<tr data-kind=\"" + kinds_of(row) + "\" id=\"run-" + std::to_string(index) + "\">";
  for (std::size_t i = 0; i < row.parameters.size(); ++i)
    text += "<td>" + html(label_of(study.sweeps[i], row.parameters[i])) + "</td>";
  text += "<td class=\"text\">" + html(study.subjects[static_cast<std::size_t>(row.subject)].name) +
          "</td>";
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const MetricValue value = i < row.metrics.size() ? row.metrics[i] : MetricValue{};
    text += "<td class=\"first\">" + number(value.measured) +
            (value.half_width ? " ± " + text::rounded(*value.half_width, 2) : "") + "</td>";
    if (needed[i].predicted)
      text += (value.predicted || value.no_form.empty()
                   ? std::string("<td>")
                   : "<td title=\"no closed form: " + html(value.no_form) + "\">") +
              number(value.predicted) + "</td>";
    if (needed[i].verdict) text += verdict_cell(value);
  }
  const bool stopped = outcome_of(row) == RunOutcome::stopped;
  return text + "<td class=\"status" + (stopped ? " bad" : " soft") + "\">" + html(row.status) +
         "</td></tr>\n";
}

}  // namespace

std::string swatch(int subject_style) {
  const output::SeriesStyle style = output::series_style(subject_style);
  const std::string name =
      std::array{"●", "■", "▲", "◆", "⬟"}[static_cast<std::size_t>(style.shape)];
  return "<span class=\"swatch\" style=\"color:" + style.color + "\">" + name + "</span>";
}

std::vector<std::vector<std::size_t>> page_portions(const StudyResult& study,
                                                    const RegimeTable& table) {
  const std::vector<NeededColumns> needed = needed_columns(study, table.regime);
  std::vector<std::vector<std::size_t>> portions;
  std::size_t used = page_columns;
  for (const std::size_t metric : table.metrics) {
    const std::size_t columns = needed[metric].predicted ? 2 : 1;
    if (used + columns > page_columns) {
      portions.emplace_back();
      used = 0;
    }
    portions.back().push_back(metric);
    used += columns;
  }
  return portions;
}

std::string summary_table(const StudyResult& study, const RegimeTable& table,
                          const std::vector<std::size_t>& metrics) {
  const std::vector<NeededColumns> needed = needed_columns(study, table.regime);
  const std::vector<int> styles = subject_styles(study);
  std::string text = "<div class=\"scroll\" tabindex=\"0\"><table class=\"summary\">\n" +
                     summary_head(study, metrics, needed) + "<tbody>\n";
  for (const std::size_t i : table.subjects) {
    const SubjectInfo& subject = study.subjects[i];
    text += "<tr><th scope=\"row\">" + swatch(styles[i]) + html(subject.name) + "<small>" +
            html(composition(subject)) + "</small></th>" + finished_cell(table.summary.subjects[i]);
    for (const std::size_t metric : metrics)
      text +=
          metric_cells(study, table.summary.subjects[i].metrics[metric], metric, needed[metric]);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string truths_table(const StudyResult& study) {
  std::string rows;
  for (const TruthResult& truth : study.truths) {
    const std::string count =
        std::to_string(truth.passed) + "/" + std::to_string(truth.passed + truth.failed);
    const std::string verdict =
        truth.passed + truth.failed == 0
            ? std::string(truth.idleness.idle == Idle::fault ? "<td class=\"bad\">✗ not judged</td>"
                                                             : "<td class=\"soft\">not judged</td>")
        : truth.failed == 0 ? "<td class=\"good\">✓ " + count + "</td>"
                            : "<td class=\"bad\">✗ " + count + "</td>";
    std::string words = html(truth.words + not_judged_words(truth));
    if (truth.first_failure >= 0) {
      const auto row = static_cast<std::size_t>(truth.first_failure);
      words +=
          " <small>first fails in " +
          run_link(study, row,
                   html(study.subjects[static_cast<std::size_t>(study.rows[row].subject)].name +
                        " at " + parameters_text(study, study.rows[row]))) +
          "</small>";
    }
    rows += "<tr>" + verdict + text_cell(html(truth.name)) + "<td class=\"status\">" + words +
            "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 id=\"truths\">Truths</h2>\n" + table_head({"holds", "truth", "what it says"}) + rows +
         "</tbody></table></div>\n";
}

std::string failure_table(const StudyResult& study) {
  const std::vector<Failure> failures = failures_of(study);
  std::string rows;
  for (std::size_t i = 0; i < std::min(failures.size(), most_listed); ++i) {
    const auto index = static_cast<std::size_t>(failures[i].row);
    const RunResult& row = study.rows[index];
    const auto metric = static_cast<std::size_t>(failures[i].metric);
    const std::string subject = html(study.subjects[static_cast<std::size_t>(row.subject)].name);
    rows +=
        "<tr>" + text_cell(run_link(study, index, subject)) +
        text_cell(html(parameters_text(study, row))) +
        text_cell(html(spoken(study.metrics[metric].name)) + unit_of(study.metrics[metric].unit)) +
        text_cell(number(row.metrics[metric].measured)) +
        text_cell(number(row.metrics[metric].predicted)) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 id=\"failures\">What does not hold</h2>\n" +
         table_head({"subject", "at", "metric", "measured", "closed form"}) + rows +
         "</tbody></table></div>\n" + and_more(failures.size());
}

std::string idle_table(const std::vector<IdleBlock>& blocks) {
  std::string rows;
  for (const IdleBlock& block : blocks) {
    const bool fault = block.idleness.idle == Idle::fault;
    rows += "<tr>" +
            text_cell(std::string(fault ? "<span class=\"bad\">✗</span> " : "") + block.kind) +
            text_cell(html(block.name)) + "<td class=\"status\">" + html(block.idleness.why) +
            "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 id=\"idle\">What judges or shows nothing</h2>\n" +
         table_head({"block", "name", "why"}) + rows + "</tbody></table></div>\n";
}

std::string missing_forms_table(const StudyResult& study) {
  std::string rows;
  for (const MissingForm& missing : missing_forms(study)) {
    std::string subjects;
    for (const int subject : missing.subjects)
      subjects += (subjects.empty() ? "" : ", ") +
                  html(study.subjects[static_cast<std::size_t>(subject)].name);
    rows += "<tr>" + text_cell(html(spoken(study.metrics[missing.metric].name))) +
            "<td class=\"status\">" + subjects + "</td><td>" + std::to_string(missing.runs) +
            "</td><td class=\"status\">" + html(missing.why) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 id=\"no-closed-form\">Runs without a closed form</h2>\n" +
         table_head({"metric", "subjects", "runs", "why"}) + rows + "</tbody></table></div>\n";
}

std::string stopped_table(const StudyResult& study) {
  const std::vector<std::size_t> stopped = stopped_rows(study);
  std::string rows;
  for (std::size_t i = 0; i < std::min(stopped.size(), most_listed); ++i) {
    const RunResult& row = study.rows[stopped[i]];
    const std::string subject = html(study.subjects[static_cast<std::size_t>(row.subject)].name);
    rows += "<tr>" + text_cell(run_link(study, stopped[i], subject)) +
            text_cell(html(parameters_text(study, row))) + "<td class=\"status bad\">" +
            html(row.status) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2 id=\"stopped\">Runs that stopped on the way</h2>\n" +
         table_head({"subject", "at", "when and why"}) + rows + "</tbody></table></div>\n" +
         and_more(stopped.size());
}

std::string warning_list(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "";
  std::string text = "<h2>Steps above the stability bound</h2>\n<ul>\n";
  for (const std::string& warning : warnings) text += "<li>" + html(warning) + "</li>\n";
  return text + "</ul>\n";
}

std::string runs_table(const StudyResult& study) {
  const std::vector<NeededColumns> needed = needed_columns(study);
  const bool all = study.rows.size() <= most_rows;
  std::string rows;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < study.rows.size() && listed < most_rows; ++i) {
    if (!all && !fails_or_stopped(study.rows[i])) continue;
    rows += run_row(study, needed, i);
    ++listed;
  }
  std::string text;
  if (!all)
    text += "<p>" + std::to_string(listed) + " of " + std::to_string(study.rows.size()) +
            " runs: those that fail a truth or stopped. <a href=\"results.csv\">results.csv</a> "
            "holds every one.</p>\n";
  if (listed == 0) return text;
  text +=
      "<div class=\"filter\" hidden><label>Filter <input type=\"search\" placeholder=\"words\" "
      "size=\"24\"></label>"
      "<label>Show <select name=\"kind\"><option value=\"\">all</option><option "
      "value=\"fails\">truth "
      "fails</option>"
      "<option value=\"stopped\">stopped</option><option value=\"skipped\">skipped</option>"
      "<option value=\"refused\">refused</option>"
      "<option value=\"finished\">finished</option><option value=\"expected\">broke off as "
      "expected</option></select></label><output></output></div>\n";
  return text + "<div class=\"scroll tall\" tabindex=\"0\"><table class=\"runs\">\n" +
         runs_head(study, needed) + "<tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string provenance_table(const std::vector<std::pair<std::string, std::string>>& lines) {
  if (lines.empty()) return "";
  std::string text = "<h2>Provenance</h2>\n<div class=\"scroll\"><table class=\"wide\"><tbody>\n";
  for (const auto& [name, value] : lines)
    text += "<tr><td>" + html(name) + "</td><td>" + html(value) + "</td></tr>\n";
  return text + "</tbody></table></div>\n";
}

}  // namespace hookpoint::studies
