#include "studies/report/report.h"

#include "output/figures/inline_svg.h"
#include "output/figures/plot.h"
#include "output/files/file.h"
#include "studies/report/figures.h"
#include "studies/report/report_claims.h"
#include "studies/report/report_distances.h"
#include "studies/report/report_page.h"
#include "studies/report/report_pivots.h"
#include "studies/report/report_tables.h"
#include "studies/results/idleness.h"
#include "studies/results/matched_grounds.h"
#include "studies/results/seed_means.h"
#include "studies/results/selection.h"
#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// Swept values that a reader still looks at one by one.
constexpr std::size_t most_told = 40;

std::string paragraph(const std::string& style, const std::string& content) {
  return "<p class=\"" + style + "\">" + content + "</p>\n";
}

std::string heading(const std::string& text) { return "<h2>" + text + "</h2>\n"; }

std::string verdict_line(const StudySummary& summary, const std::vector<IdleBlock>& blocks) {
  const int all = summary.passed + summary.failed;
  const bool fault = has_fault(blocks);
  std::string idle = idle_words(blocks);
  if (!idle.empty()) idle = "; <a href=\"#idle\">" + html(idle) + "</a>";
  if (summary.failed > 0)
    return paragraph("verdict bad",
                     "✗ " + std::to_string(summary.failed) + " of " + std::to_string(all) +
                         " verdicts <a href=\"#truths\">do not hold</a>" + idle + ".");
  if (all == 0)
    return paragraph(fault ? "verdict bad" : "verdict",
                     idle.empty() ? "No truth is claimed."
                                  : (fault ? "✗ No verdict" : "No verdict") + idle + ".");
  return paragraph(fault ? "verdict bad" : "verdict good",
                   (fault ? "✗ " : "✓ All ") + std::to_string(all) + " verdicts hold" + idle + ".");
}

std::string stopped_line(const SubjectSummary& total) {
  if (total.stopped == 0) return "";
  const std::string runs = total.stopped == 1 ? "1 run" : std::to_string(total.stopped) + " runs";
  return paragraph("verdict bad", "✗ " + runs + " <a href=\"#stopped\">stopped on the way</a>.");
}

std::string facts_line(const StudySummary& summary) {
  const SubjectSummary& total = summary.total;
  std::string text = std::to_string(total.rows()) + " runs of " +
                     std::to_string(summary.subjects.size()) +
                     " subjects: " + std::to_string(total.finished) + " finished";
  if (total.expected > 0) text += ", " + std::to_string(total.expected) + " broke off as expected";
  if (total.stopped > 0) text += ", " + std::to_string(total.stopped) + " stopped on the way";
  if (total.skipped > 0) text += ", " + std::to_string(total.skipped) + " skipped";
  if (total.refused > 0) text += ", " + std::to_string(total.refused) + " refused";
  return paragraph("facts", text + ".");
}

std::string varied_line(const StudyResult& study) {
  std::string text;
  for (const SweepColumn& sweep : study.sweeps) {
    text += text.empty() ? "Varied: " : "; ";
    text += html(spoken(sweep.name)) + " ";
    if (sweep.values.size() > most_told)
      text += std::to_string(sweep.values.size()) + " values from " +
              label_of(sweep, sweep.values.front()) + " to " + label_of(sweep, sweep.values.back());
    for (std::size_t i = 0; i < sweep.values.size() && sweep.values.size() <= most_told; ++i)
      text += (i > 0 ? ", " : "") + html(label_of(sweep, sweep.values[i]));
    if (!sweep.unit.empty()) text += " " + html(sweep.unit);
  }
  if (study.runs != nullptr) text += (text.empty() ? "" : "; ") + seeds_words(study);
  return text.empty() ? "" : paragraph("facts", text + ".");
}

std::string title_of(const StudyResult& study) {
  return study.title.empty() ? spoken(study.name) : study.title;
}

std::string opening(const StudyResult& study, const ReportContext& context,
                    const StudySummary& summary, const std::vector<IdleBlock>& idle) {
  std::string text = paragraph("kicker", "Study · " + html(study.file));
  text += "<h1>" + html(title_of(study)) + "</h1>\n";
  if (!study.question.empty()) text += paragraph("question", html(study.question));
  text += claim_lines(study);
  text += verdict_line(summary, idle) + stopped_line(summary.total) + facts_line(summary) +
          varied_line(study);
  text += "<pre>" + html(context.command) + "</pre>\n";
  if (context.files.empty()) return text;
  std::string links;
  for (const std::string& file : context.files)
    links +=
        (links.empty() ? "" : " · ") + ("<a href=\"" + html(file) + "\">" + html(file) + "</a>");
  return text + paragraph("facts", links);
}

std::string figure_list(const std::vector<ReportFigure>& figures) {
  if (figures.empty()) return "";
  std::string text = heading("Figures");
  int number = 0;
  for (const ReportFigure& figure : figures) {
    const std::string name = html(figure.name);
    text += "<figure id=\"figure-" + name + "\">\n";
    text += figure.svg.empty() ? paragraph("bad", html(figure.message)) : described_svg(figure);
    text += "<figcaption><b>Figure " + std::to_string(++number) + ".</b> " + html(figure.caption);
    if (!figure.svg.empty()) text += " <a href=\"" + name + ".svg\">" + name + ".svg</a>,";
    text += " <a href=\"" + name + ".csv\">" + name + ".csv</a></figcaption>\n</figure>\n";
  }
  return text;
}

std::string regime_heading(const RegimeTable& table) {
  std::string text = table.heading.empty() ? "Subjects and metrics" : table.heading;
  const auto at_most = text.find("<=");
  if (at_most != std::string::npos) text.replace(at_most, 2, "≤");
  return html(text);
}

/// What answers the question, the figures, then the other metrics and regimes.
std::string results(const StudyResult& study, const std::vector<ReportFigure>& figures) {
  std::string answer, others;
  for (const RegimeTable& table : regime_tables(study)) {
    const auto portions = page_portions(study, table);
    for (std::size_t i = 0; i < portions.size(); ++i) {
      std::string& text = answer.empty() ? answer : others;
      if (i < 2) text += heading(regime_heading(table) + (i > 0 ? ": other metrics" : ""));
      text += summary_table(study, table, portions[i]);
    }
  }
  return answer +
         paragraph("note soft",
                   "Worst: the run whose truth fails, else the one farthest from its closed form, "
                   "which stands beside it; it leads to its row. Small figures: median or range "
                   "over the sweep. ✓ and ✗ count the runs that a truth judges; the worst may be "
                   "one that none judges.") +
         figure_list(figures) + others;
}

/// A table of words, whose cells go on in the next line.
std::string wide_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<div class=\"scroll\"><table class=\"wide\"><thead><tr>";
  for (const std::string& title : head) text += "<th class=\"text\">" + html(title) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + html(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

/// What `match` chose, and what of hookpoint's ground that gives.
std::string matched_grounds(const StudyResult& study) {
  std::vector<std::vector<std::string>> rows;
  for (const MatchedLine& line : matched_lines(study))
    rows.push_back({line.subject, line.material, line.under, constants_text(line), line.matched});
  if (rows.empty()) return "";
  return heading("Ground matched to hookpoint's") +
         wide_table({"subject", "material", "under", "constants", "as hookpoint's"}, rows) +
         paragraph("facts", "<a href=\"matched.csv\">matched.csv</a>");
}

std::string peer_table(const ReportContext& context) {
  if (context.peers.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const PeerSetting& peer : context.peers)
    rows.push_back({peer.engine, peer.settings, peer.name, peer.value, peer.source});
  return heading("Settings of the reference engines") +
         wide_table({"engine", "settings", "what", "value", "source"}, rows);
}

bool has_point(const output::Plot& plot) {
  return std::ranges::any_of(plot.series, [](const output::Series& series) {
    return !series.measured.x.empty() || !series.predicted.x.empty() || !series.unfinished.empty();
  });
}

/// Whether some run has a value to draw.
bool has_point(const Figure& figure) {
  return figure.map ||
         (figure.panels
              ? std::ranges::any_of(figure.panels->panels,
                                    [](const output::Plot& panel) { return has_point(panel); })
              : has_point(figure.plot));
}

/// The figure's empty table, without a drawing: that is no fault of gnuplot.
ReportFigure without_points(const Figure& figure, const std::filesystem::path& folder) {
  const std::filesystem::path base = folder / figure.plot.name;
  std::error_code ignored;
  for (const char* type : {".svg", ".gp"}) std::filesystem::remove(base.string() + type, ignored);
  output::write_file(base.string() + ".csv", figure.panels ? output::panel_data(*figure.panels)
                                                           : output::plot_data(figure.plot));
  return {figure.plot.name, figure.caption, "", "No run has a value to draw."};
}

}  // namespace

std::string described_svg(const ReportFigure& figure) {
  return output::inline_svg(figure.svg, figure.name, figure.caption)
      .value_or(paragraph("bad", "The drawing is no SVG."));
}

std::string report_html(const StudyResult& study, const ReportContext& context,
                        const std::vector<ReportFigure>& figures) {
  if (study.seed_sweep) return report_html(over_seeds(study), context, figures);
  const StudySummary summary = summarise(study);
  std::string page = page_start(title_of(study));
  const std::vector<IdleBlock> idle = idle_blocks(study);
  page += opening(study, context, summary, idle);
  page += matched_grounds(study) + pivot_tables(study) + results(study, figures);
  page += truths_table(study) + failure_table(study) + idle_table(idle) +
          missing_forms_table(study) + stopped_table(study);
  page += warning_list(study.warnings) + distance_table(study);
  page += heading("Every run") + runs_table(study);
  page += peer_table(context) + provenance_table(context.provenance);
  return page + page_end_with_script();
}

ReportOutcome write_report(const StudyResult& study, const ReportContext& context,
                           const std::filesystem::path& folder) {
  ReportOutcome outcome;
  for (std::size_t i = 0; i < study.plots.size(); ++i) {
    const Figure figure = make_figure(study, i);
    if (!has_point(figure)) {
      outcome.figures.push_back(without_points(figure, folder));
      continue;
    }
    const output::PlotOutcome drawn = figure.map      ? output::draw(*figure.map, folder)
                                      : figure.panels ? output::draw(*figure.panels, folder)
                                                      : output::draw(figure.plot, folder);
    if (!drawn.drawn) outcome.messages.push_back(drawn.message);
    outcome.figures.push_back({figure.plot.name, figure.caption, drawn.svg, drawn.message});
  }
  output::write_file(folder / "report.html", report_html(study, context, outcome.figures));
  return outcome;
}

}  // namespace hookpoint::studies
