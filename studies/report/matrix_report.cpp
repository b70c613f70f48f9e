// A Matrix for people: the page and the terminal's table.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "studies/report/figures.h"
#include "studies/report/matrix_rows.h"
#include "studies/report/page_files.h"
#include "studies/report/report_claims.h"
#include "studies/report/report_page.h"
#include "studies/report/report_tables.h"
#include "studies/report/terminal_blocks.h"
#include "studies/results/idleness.h"
#include "studies/results/seed_means.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

std::string tag(const char* name, const std::string& style, const std::string& content) {
  return fmt::format("<{0} class=\"{1}\">{2}</{0}>", name, style, content);
}

std::string link(const std::string& address, const std::string& text) {
  return "<a href=\"" + html(address) + "\">" + html(text) + "</a>";
}

std::string anchor(const std::string& study, const std::string& figure) {
  return "figure-" + study + "-" + figure;
}

std::string runs_text(const SubjectSummary& counts) {
  std::string text = counts.rows() == 1 ? "1 run" : fmt::format("{} runs", counts.rows());
  if (counts.stopped > 0) text += fmt::format(", {} stopped", counts.stopped);
  if (counts.refused > 0) text += fmt::format(", {} refused", counts.refused);
  return text;
}

/// The overview's cell of a study and a subject. A click on it filters the table of rows to theirs
/// (report/page/report.js).
std::string cell_html(const MatrixStudy& study, const std::string& subject) {
  const MatrixCell cell = matrix_cell(study, subject);
  if (!cell.there) return "<td class=\"soft\">·</td>";
  text::JsonWriter shows;
  shows.begin_object().member("study", study.result->name).member("subject", subject).end_object();
  std::string shown = shows.text();
  std::ranges::replace(shown, '\n', ' ');
  const auto linked = [&](const char* style, const std::string& text) {
    return fmt::format("<a class=\"{}\" href=\"#rows\" data-shows=\"{}\">{}</a>", style,
                       html(shown), text);
  };
  if (cell.counts.finished + cell.counts.stopped == 0) {
    const std::string why = cell.status.substr(0, cell.status.find(':'));
    return "<td title=\"" + html(cell.status) + "\">" + linked("soft", html(why)) + "</td>";
  }
  const int judged = cell.passed + cell.failed;
  const bool bad = cell.failed > 0 || cell.counts.stopped > 0;
  const char* style = cell.failed > 0 ? "bad" : judged > 0 ? "good" : "";
  const std::string text =
      judged == 0 ? std::string("–")
                  : fmt::format("{} {}/{}", cell.failed > 0 ? "✗" : "✓", cell.passed, judged);
  return fmt::format("<td class=\"{}\">{}<small>{}</small></td>", bad ? "fails" : "",
                     linked(style, text), runs_text(cell.counts));
}

std::string overview(const MatrixResult& matrix) {
  std::string text =
      "<h2>Subjects and scenes</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"summary "
      "overview\">\n"
      "<thead><tr><th class=\"text\">subject</th>";
  for (const MatrixStudy& study : matrix.studies)
    text += "<th>" + link("#study-" + study.result->name, spoken(study.result->name)) + "</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (const std::string& subject : matrix_subjects(matrix)) {
    text += "<tr><th scope=\"row\">" + html(subject) + "</th>";
    for (const MatrixStudy& study : matrix.studies) text += cell_html(study, subject);
    text += "</tr>\n";
  }
  return text +
         "</tbody></table></div>\n<p class=\"note soft\">✓ and ✗ count the verdicts of truths; "
         "a dash: none judges the subject there; a dot: it is not in that study. Skipped: the "
         "engine is not on "
         "this machine. Refused: the engine cannot run the scene; its row says why. A cell "
         "leads to its "
         "rows.</p>\n";
}

/// Choices of a filter: every value once, in the rows' order.
std::string choice(const char* label, const char* name, const std::vector<std::string>& values) {
  std::string text =
      fmt::format("<label>{} <select name=\"{}\"><option value=\"\">all</option>", label, name);
  std::set<std::string> seen;
  for (const std::string& value : values)
    if (seen.insert(value).second)
      text += "<option value=\"" + html(value) + "\">" + html(spoken(value)) + "</option>";
  return text + "</select></label>";
}

std::string filter(const MatrixResult& matrix) {
  std::vector<std::string> studies, metrics;
  for (const MatrixStudy& study : matrix.studies) {
    studies.push_back(study.result->name);
    for (const MetricColumn& metric : study.result->metrics) metrics.push_back(metric.name);
  }
  return "<div class=\"filter\" hidden><label>Filter <input type=\"search\" placeholder=\"words\" "
         "size=\"18\"></label>" +
         choice("Scene", "study", studies) + choice("Subject", "subject", matrix_subjects(matrix)) +
         choice("Metric", "metric", metrics) +
         choice("Show", "kind", {"holds", "fails", "stopped", "skipped", "refused"}) +
         "<output></output></div>\n";
}

std::string kinds(const MatrixRow& row) {
  std::string text = row.summary.failed > 0 ? "fails" : row.summary.passed > 0 ? "holds" : "";
  if (row.counts.stopped > 0) text += " stopped";
  if (row.counts.skipped > 0) text += " skipped";
  if (row.counts.refused > 0) text += " refused";
  return text;
}

std::string number_cell(bool there, double value, const char* style = "") {
  return tag("td", style, there ? text::rounded(value) : "<span class=\"soft\">–</span>");
}

/// Figures that draw the metric, then the file that makes them.
std::string links_cell(const MatrixStudy& study, const std::string& metric) {
  std::string links;
  for (const PlotSpec& plot : study.result->plots)
    if (plot.y == metric || plot.color == metric || plot.x == metric)
      links += link("#" + anchor(study.result->name, plot.name), plot.name) + " ";
  return tag("td", "text links", links + link("#hook-" + study.result->name, ".hook"));
}

std::string verdict_cell(const MetricSummary& summary) {
  if (summary.passed + summary.failed == 0) return "<td></td>";
  return fmt::format("<td class=\"{}\">{} {}/{}</td>", summary.failed > 0 ? "bad fails" : "good",
                     summary.failed > 0 ? "✗" : "✓", summary.passed,
                     summary.passed + summary.failed);
}

std::string row_html(const MatrixResult& matrix, const MatrixRow& row,
                     const std::vector<std::vector<int>>& styles) {
  const MatrixStudy& study = matrix.studies[row.study];
  const SubjectInfo& subject = study.result->subjects[row.subject];
  const std::string metric = row.metric ? study.result->metrics[*row.metric].name : "";
  const std::string unit = row.metric ? study.result->metrics[*row.metric].unit : "";
  const MetricSummary& summary = row.summary;
  const RunResult* run =
      summary.worst < 0 ? nullptr : &study.result->rows[static_cast<std::size_t>(summary.worst)];
  const MetricValue worst = run != nullptr ? run->metrics[*row.metric] : MetricValue{};
  std::string text =
      fmt::format("<tr data-study=\"{}\" data-subject=\"{}\" data-metric=\"{}\" data-kind=\"{}\">",
                  html(study.result->name), html(subject.name), html(metric), kinds(row));
  text += tag(
      "td", "text",
      link(study.result->name + "/report.html", spoken(study.result->name)) +
          (row.regime == Regime::none ? ""
                                      : "<small>" + std::string(word(row.regime)) + "</small>"));
  text += tag("td", "text",
              swatch(styles[row.study][row.subject]) + html(subject.name) + "<small>" +
                  html(composition(subject)) + "</small>");
  text += tag("td", "text", html(spoken(metric)));
  text += tag("td", "text soft", html(unit));
  const bool any = summary.values > 0;
  text += number_cell(any, summary.median, "first") + number_cell(any, summary.least) +
          number_cell(any, summary.largest);
  text += "<td class=\"first\" title=\"" +
          html(run != nullptr ? parameters_text(*study.result, *run) : "") + "\">" +
          text::rounded(worst.measured, "<span class=\"soft\">–</span>") + "</td>";
  text += number_cell(worst.predicted.has_value(), worst.predicted.value_or(0.)) +
          verdict_cell(summary);
  text += fmt::format("<td>{}/{}</td>", row.counts.finished, row.counts.rows());
  text += links_cell(study, metric);
  return text + tag("td", row.counts.stopped > 0 ? "status bad" : "status soft", html(row.status)) +
         "</tr>\n";
}

std::string rows_table(const MatrixResult& matrix) {
  std::vector<std::vector<int>> styles;
  for (const MatrixStudy& study : matrix.studies) styles.push_back(subject_styles(*study.result));
  std::string text =
      "<h2 id=\"rows\">Every scene, subject and metric</h2>\n" + filter(matrix) +
      "<div class=\"scroll tall\" tabindex=\"0\"><table class=\"runs\">\n<thead><tr>";
  for (const char* title : {"scene", "subject", "metric", "unit"})
    text += fmt::format("<th data-sorts=\"\" class=\"text\">{}</th>", title);
  for (const char* title : {"median", "least", "largest", "worst", "closed form", "truths", "runs"})
    text += fmt::format("<th data-sorts=\"\">{}</th>", title);
  text +=
      "<th class=\"text\">figures, file</th><th data-sorts=\"\" "
      "class=\"text\">status</th></tr></thead>\n<tbody>\n";
  for (const MatrixRow& row : matrix_rows(matrix)) text += row_html(matrix, row, styles);
  return text +
         "</tbody></table></div>\n<p class=\"note soft\">Median, least and largest over the runs "
         "that the study sweeps. Worst: the run whose truth fails, else the one farthest from its "
         "closed form, "
         "which stands beside it, else the largest; hover for where.</p>\n";
}

std::string study_section(const MatrixStudy& study) {
  const StudyResult& result = *study.result;
  const StudySummary summary = summarise(result);
  std::string text = fmt::format("<h2 id=\"study-{}\">{}</h2>\n", html(result.name),
                                 html(result.title.empty() ? spoken(result.name) : result.title));
  if (!result.question.empty()) text += tag("p", "", html(result.question)) + "\n";
  text += tag("p", "facts",
              fmt::format("{} · {} · {} · {}",
                          html(verdict_words(summary.passed, summary.failed, idle_blocks(result))),
                          link(result.name + "/report.html", "report"),
                          link(result.name + "/results.csv", "results.csv"), html(result.file))) +
          "\n";
  for (ReportFigure figure : study.figures) {
    const std::string name = anchor(result.name, figure.name);
    text += "<figure id=\"" + html(name) + "\">\n";
    const std::string file = result.name + "/" + figure.name;
    figure.name = name;
    text += figure.svg.empty() ? tag("p", "bad", html(figure.message)) : described_svg(figure);
    text += "<figcaption>" + html(figure.caption) + " " + link(file + ".svg", file + ".svg") +
            ", " + link(file + ".csv", file + ".csv") + "</figcaption>\n</figure>\n";
  }
  return text + "<details id=\"hook-" + html(result.name) + "\"><summary>" + html(result.file) +
         "</summary><pre>" + html(study.text) + "</pre></details>\n";
}

std::string verdict(const MatrixResult& matrix) {
  int passed = 0, failed = 0, stopped = 0, runs = 0, skipped = 0, refused = 0;
  std::vector<IdleBlock> idle;
  for (const MatrixStudy& study : matrix.studies) {
    const StudySummary summary = summarise(*study.result);
    passed += summary.passed;
    failed += summary.failed;
    stopped += summary.total.stopped;
    skipped += summary.total.skipped;
    refused += summary.total.refused;
    runs += summary.total.rows();
    for (IdleBlock& block : idle_blocks(*study.result)) idle.push_back(std::move(block));
  }
  const std::string facts = fmt::format(
      "{} runs of {} subjects in {} studies: {} finished, {} stopped on the way, {} skipped, {} "
      "refused.",
      runs, matrix_subjects(matrix).size(), matrix.studies.size(),
      runs - stopped - skipped - refused, stopped, skipped, refused);
  const bool bad = failed > 0 || has_fault(idle);
  const std::string verdicts =
      failed == 0 && idle.empty()
          ? fmt::format("✓ All {} verdicts hold.", passed)
          : fmt::format("{} {}.", bad ? "✗" : "✓", html(verdict_words(passed, failed, idle)));
  return tag("p", bad ? "verdict bad" : "verdict good", verdicts) + "\n" +
         tag("p", "facts", facts) + "\n";
}

}  // namespace

std::string matrix_html(const MatrixResult& matrix, const ReportContext& context) {
  const std::string title = matrix.title.empty() ? spoken(matrix.name) : matrix.title;
  std::string page = page_start(title, page_files::matrix_css);
  page += tag("p", "kicker", "Matrix · " + html(matrix.file)) + "\n<h1>" + html(title) + "</h1>\n";
  if (!matrix.question.empty()) page += tag("p", "question", html(matrix.question)) + "\n";
  page += verdict(matrix) + "<pre>" + html(context.command) + "</pre>\n" +
          tag("p", "facts", link("matrix.csv", "matrix.csv")) + "\n";
  for (const MatrixStudy& study : matrix.studies)
    page += claim_lines(study.result->seed_sweep ? over_seeds(*study.result) : *study.result);
  page += overview(matrix) + rows_table(matrix);
  for (const MatrixStudy& study : matrix.studies) page += study_section(study);
  return page + provenance_table(context.provenance) + page_end_with_script();
}

namespace {

/// What judges or shows nothing in each study, and the verdicts of all.
std::string terminal_verdicts(const MatrixResult& matrix, bool color) {
  std::string text;
  int passed = 0, failed = 0;
  std::vector<IdleBlock> idle;
  for (const MatrixStudy& study : matrix.studies) {
    const StudySummary summary = summarise(*study.result);
    passed += summary.passed;
    failed += summary.failed;
    for (IdleBlock& block : idle_blocks(*study.result)) {
      const Tone tone = block.idleness.idle == Idle::fault ? Tone::bad : Tone::faint;
      text += toned(study.result->name + ": " + line_of(block), tone, color) + "\n";
      idle.push_back(std::move(block));
    }
  }
  const Tone tone = failed > 0 || has_fault(idle) ? Tone::bad : Tone::good;
  return text + toned(verdict_words(passed, failed, idle), tone, color) + "\n";
}

}  // namespace

std::string matrix_terminal_table(const MatrixResult& matrix, bool color) {
  ColumnGroup group;
  group.rows.push_back({{"subject", Tone::faint, false}});
  for (const MatrixStudy& study : matrix.studies)
    group.rows.front().push_back({study.result->name, Tone::faint, true});
  for (const std::string& subject : matrix_subjects(matrix)) {
    CellRow row{{subject, Tone::plain, false}};
    for (const MatrixStudy& study : matrix.studies) {
      const MatrixCell cell = matrix_cell(study, subject);
      const bool ran = cell.counts.finished + cell.counts.stopped > 0;
      const int judged = cell.passed + cell.failed;
      if (!cell.there)
        row.push_back({".", Tone::faint});
      else if (!ran)
        row.push_back({cell.status.substr(0, cell.status.find(':')), Tone::faint});
      else if (cell.counts.stopped > 0)
        row.push_back({fmt::format("{} stopped", cell.counts.stopped), Tone::bad});
      else
        row.push_back({judged == 0 ? "ran" : fmt::format("{}/{}", cell.passed, judged),
                       cell.failed > 0 ? Tone::bad
                       : judged > 0    ? Tone::good
                                       : Tone::plain});
    }
    group.rows.push_back(std::move(row));
  }
  group.measure();
  return print_groups({&group}, color) + terminal_verdicts(matrix, color);
}

}  // namespace hookpoint::studies
