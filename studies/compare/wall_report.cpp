#include "studies/compare/wall_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/names.h"
#include "studies/compare/score_card.h"
#include "studies/report/page_files.h"
#include "studies/report/report_page.h"
#include "studies/report/report_tables.h"
#include "studies/report/terminal_blocks.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

bool judged(const WallCell& cell) {
  return !cell.status.empty() && !cell.status.starts_with("skipped");
}

std::string error_text(const WallLine& line, double error) {
  if (line.relative) return text::rounded(100. * error, 2) + " %";
  return text::rounded(error, 2) + (line.unit.empty() ? "" : " " + line.unit);
}

/// The closed form's value where all subjects have the same, else nothing.
std::optional<double> common_expected(const WallLine& line) {
  std::optional<double> common;
  for (const WallCell& cell : line.cells) {
    if (cell.status.empty()) continue;
    if (common && *common != cell.expected) return std::nullopt;
    common = cell.expected;
  }
  return common;
}

std::string expected_text(const WallLine& line) {
  const auto common = common_expected(line);
  const std::string value = common ? text::rounded(*common, 5) : "by law";
  return value + (line.unit.empty() ? "" : " " + line.unit);
}

std::string cell_html(const WallLine& line, const WallCell& cell) {
  if (cell.status.empty()) return "<td class=\"soft\">·</td>";
  if (!judged(cell)) return "<td class=\"soft\">" + html(cell.status) + "</td>";
  if (!cell.measured)
    return "<td class=\"fails status\"><span class=\"bad\">✗</span> " +
           html(cell.status == "ok" ? "never reached" : cell.status) + "</td>";
  const char* mark = cell.ok ? "<span class=\"good\">✓</span> " : "<span class=\"bad\">✗</span> ";
  const std::string wanted = common_expected(line) ? "" : " of " + text::rounded(cell.expected, 4);
  return std::string(cell.ok ? "<td>" : "<td class=\"fails\">") + mark +
         html(text::rounded(*cell.measured, 4)) + html(wanted) + "<small>" +
         html(error_text(line, *cell.error)) + "</small></td>";
}

/// A name that may go on in the next line after each of its words: ten laws fit beside each other.
std::string breakable(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '_' ? "_<wbr>" : html(std::string(1, c));
  return text;
}

std::string table_head(const WallResult& wall) {
  std::string head =
      "<thead><tr><th class=\"text\">truth</th><th class=\"text\">closed form</th><th>allowed</th>";
  for (const SubjectInfo& subject : wall.subjects)
    head += "<th>" + breakable(subject.name) + "</th>";
  return head + "</tr></thead>\n";
}

std::string scene_row(const WallResult& wall, std::size_t scene) {
  const WallScene& shown = wall.scenes[scene];
  return fmt::format(
      "<tr id=\"{0}\"><th class=\"text scene\" colspan=\"{1}\">{0}<small>{2} · "
      "{3}</small></th></tr>\n",
      html(shown.name), wall.subjects.size() + 3, html(shown.title), html(shown.file));
}

std::string line_row(const WallLine& line) {
  std::string row = "<tr><td class=\"text first\">" + html(line.name) + "</td><td class=\"form\">" +
                    html(expected_text(line)) + "<small>" + html(line.formula);
  if (!line.source.empty()) row += " · " + html(line.source);
  row += "</small></td><td>" + html(line.allowed) + "</td>";
  for (const WallCell& cell : line.cells) row += cell_html(line, cell);
  return row + "</tr>\n";
}

std::string wall_table(const WallResult& wall) {
  std::string table =
      "<div class=\"scroll tall\"><table class=\"summary\">" + table_head(wall) + "<tbody>\n";
  for (std::size_t scene = 0; scene < wall.scenes.size(); ++scene) {
    table += scene_row(wall, scene);
    for (const WallLine& line : wall.lines) {
      if (line.scene == scene) table += line_row(line);
    }
  }
  return table + "</tbody></table></div>\n";
}

/// ", 2 of them left out for want of an engine".
std::string left_out_words(const WallResult& wall) {
  const int left_out = wall.left_out();
  return left_out == 0 ? "" : fmt::format(", {} of them left out for want of an engine", left_out);
}

/// ", 1 Expect judges nothing"; "" where all judge.
std::string idle_words_after(const WallResult& wall) {
  const std::string words = idle_words(wall.idle);
  return words.empty() ? "" : ", " + words;
}

std::string verdict(const WallResult& wall) {
  const int passed = wall.passed(), failed = wall.failed();
  const std::string counted =
      fmt::format("{} ({} scenes, {} truths{})", idle_words_after(wall), wall.scenes.size(),
                  wall.lines.size(), left_out_words(wall));
  const bool fault = has_fault(wall.idle);
  std::string text;
  if (passed + failed == 0)
    text = fmt::format("<p class=\"verdict{}No verdict{}.</p>\n", fault ? " bad\">✗ " : "\">",
                       counted);
  else if (wall.score_card)
    text = fmt::format(
        "<p class=\"verdict\">{} of {} results lie as near to the closed form as the scene "
        "allows{}.</p>\n",
        passed, passed + failed, counted);
  else if (failed == 0)
    text = fmt::format("<p class=\"verdict {}All {} verdicts hold{}.</p>\n",
                       fault ? "bad\">✗ " : "good\">✓ ", passed, counted);
  else
    text = fmt::format("<p class=\"verdict bad\">✗ {} of {} verdicts do not hold{}.</p>\n", failed,
                       passed + failed, counted);
  for (const std::string& line : fault_lines(wall.idle))
    text += "<p class=\"note bad\">Not judged: " + html(line) + ".</p>\n";
  return text;
}

/// The largest error of a line as a part of what is allowed decides which subject is named.
const WallCell* worst_cell(const WallLine& line) {
  const WallCell* worst = nullptr;
  for (const WallCell& cell : line.cells) {
    if (!judged(cell)) continue;
    if (worst == nullptr || (worst->measured && !cell.measured) ||
        (worst->error && cell.error && *cell.error > *worst->error))
      worst = &cell;
  }
  return worst;
}

std::string decades_text(const std::optional<double>& decades) {
  return decades ? fmt::format("{:.1f}", *decades) : "no result";
}

/// "nominal -0.7, lugre -0.7".
std::string laws_text(const Loss& loss) {
  std::vector<std::string> laws;
  for (const auto& [law, decades] : loss.ours) laws.push_back(law + " " + decades_text(decades));
  return language::join(laws, ", ");
}

std::string card_section(const ReportFigure& card) {
  if (card.svg.empty()) return "<p class=\"note bad\">" + html(card.message) + "</p>\n";
  return "<figure class=\"scroll\">" + described_svg(card) + "<figcaption>" + html(card.caption) +
         " Data: <a href=\"score_card.csv\">score_card.csv</a>, <a "
         "href=\"scores.csv\">scores.csv</a>.</figcaption></figure>\n";
}

std::string losses_table(const WallResult& wall) {
  const std::vector<Loss> found = losses(wall);
  std::string text = "<h2>Where our laws lose</h2>\n";
  if (found.empty())
    return text +
           "<p>Nowhere: no other engine is more than a decade nearer to a closed form that a law of "
           "ours does not meet.</p>\n";
  text +=
      "<p>Closed forms that laws of ours do not meet, and that another engine is more than a decade "
      "nearer to.</p>\n<div class=\"scroll\"><table class=\"summary\"><thead><tr><th "
      "class=\"text\">truth</th><th class=\"text\">nearest of the others</th><th "
      "class=\"text\">laws of ours, decades of error</th></tr></thead><tbody>\n";
  for (const Loss& loss : found)
    text += fmt::format(
        "<tr><td class=\"text\">{}</td><td class=\"text\">{} {}</td><td class=\"form\">{}</td></tr>\n",
        html(wall.scenes[loss.line->scene].name), html(loss.other), decades_text(loss.theirs),
        html(laws_text(loss)));
  return text + "</tbody></table></div>\n";
}

std::string card_lines(const WallResult& wall, const TableStyle& style) {
  std::string text;
  for (const Loss& loss : losses(wall))
    text += toned("  ✗ ", Tone::bad, style.color) +
            fmt::format("{}: {} comes nearer ({}) than {}\n", wall.scenes[loss.line->scene].name,
                        loss.other, decades_text(loss.theirs), laws_text(loss));
  return text;
}

std::string failures(const WallResult& wall, const TableStyle& style) {
  if (wall.score_card) return card_lines(wall, style);
  std::string text;
  for (const WallLine& line : wall.lines) {
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const WallCell& cell = line.cells[i];
      if (!judged(cell) || cell.ok) continue;
      const std::string found =
          cell.measured ? fmt::format("{} instead of {} {}", text::rounded(*cell.measured),
                                      text::rounded(cell.expected), line.unit)
                        : cell.status;
      text += toned("  ✗ ", Tone::bad, style.color) +
              fmt::format("{}.{} under {}: {}\n", wall.scenes[line.scene].name, line.name,
                          wall.subjects[i].name, found);
    }
  }
  return text;
}

/// A truth over all subjects.
struct LineSummary {
  std::string scene, truth, expected, allowed;
  std::string error;  ///< the largest; "none" where no run is judged
  std::ptrdiff_t good = 0, judged = 0;
  std::string verdicts() const { return fmt::format("{} of {}", good, judged); }
};

constexpr std::array line_titles{"scene",   "truth",         "closed form",
                                 "allowed", "largest error", "hold"};

std::vector<LineSummary> line_summaries(const WallResult& wall) {
  std::vector<LineSummary> summaries;
  for (const WallLine& line : wall.lines) {
    const WallCell* worst = worst_cell(line);
    summaries.push_back(
        {wall.scenes[line.scene].name, line.name, expected_text(line), line.allowed,
         worst != nullptr && worst->error ? error_text(line, *worst->error) : "none",
         std::ranges::count_if(line.cells,
                               [](const WallCell& cell) { return judged(cell) && cell.ok; }),
         std::ranges::count_if(line.cells, judged)});
  }
  return summaries;
}

}  // namespace

std::string wall_html(const WallResult& wall, const ReportContext& context,
                      const std::optional<ReportFigure>& card) {
  const std::string title = wall.title.empty() ? wall.name : wall.title;
  std::string page = page_start(title, page_files::wall_css);
  page += "<p class=\"kicker\">Wall · " + html(wall.file) + "</p>\n<h1>" + html(title) + "</h1>\n";
  if (!wall.question.empty()) page += "<p class=\"question\">" + html(wall.question) + "</p>\n";
  page += verdict(wall) + "<pre>" + html(context.command) + "</pre>\n";
  if (card) page += card_section(*card) + losses_table(wall);
  page +=
      "<p class=\"note soft\">Each cell: what was measured and, small, how far it is from the "
      "closed form. A dot: the truth says nothing of that law; where a law fails by its own "
      "equation, its predicted failure is a truth of its own.</p>\n";
  page += wall_table(wall) + warning_list(wall.warnings) + provenance_table(context.provenance);
  return page + "</main>\n</body>\n</html>\n";
}

std::string wall_terminal_table(const WallResult& wall, const TableStyle& style) {
  ColumnGroup group;
  group.rows.emplace_back();
  for (std::size_t i = 0; i < line_titles.size(); ++i)
    group.rows.back().push_back({line_titles[i], Tone::plain, i > 1});
  std::string last;
  for (const LineSummary& line : line_summaries(wall)) {
    const bool holds = line.good == line.judged;
    group.rows.push_back({{line.scene == last ? "" : line.scene, Tone::plain, false},
                          {line.truth, Tone::plain, false},
                          {line.expected, Tone::plain, true},
                          {line.allowed, Tone::plain, true},
                          {line.error, Tone::plain, true},
                          {line.verdicts(), holds ? Tone::good : Tone::bad, true}});
    last = line.scene;
  }
  group.measure();
  std::string text = print_groups({&group}, style.color) + "\n" + failures(wall, style);
  for (const std::string& line : fault_lines(wall.idle))
    text += toned("  ✗ not judged: ", Tone::bad, style.color) + line + "\n";
  return text + fmt::format("{} of {} verdicts hold{}: {} of {} under {}{}\n", wall.passed(),
                            wall.passed() + wall.failed(), idle_words_after(wall),
                            language::count_of(wall.lines.size(), "truth"),
                            language::count_of(wall.scenes.size(), "scene"),
                            language::count_of(wall.subjects.size(), "subject"),
                            left_out_words(wall));
}

output::LatexTable latex_wall_table(const WallResult& wall) {
  output::LatexTable table{.name = output::latex_summary,
                           .label = output::latex_summary,
                           .caption =
                               "Every truth: its closed form, the error that it allows, the "
                               "largest one, and for how many subjects it holds.",
                           .across = "",
                           .head = {line_titles.begin(), line_titles.end()},
                           .text_columns = 2,
                           .rows = {}};
  for (const LineSummary& line : line_summaries(wall)) {
    table.rows.emplace_back();
    for (const std::string& cell :
         {line.scene, line.truth, line.expected, line.allowed, line.error, line.verdicts()})
      table.rows.back().push_back(output::latex_text(cell));
  }
  return table;
}

}  // namespace hookpoint::studies
