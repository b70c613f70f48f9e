#include "studies/report/page_parts.h"

#include <fmt/format.h>

#include "studies/report/report_page.h"

namespace hookpoint::studies {
namespace {

/// Cells of a table's row; the first `words` are text.
std::string row_of(const std::vector<std::string>& cells, std::size_t words, const char* tag) {
  std::string row = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    row += fmt::format("<{0}{1}>{2}</{0}>", tag, i < words ? " class=\"text\"" : "", cells[i]);
  return row + "</tr>\n";
}

}  // namespace

std::string text_block(const std::string& style, const std::string& content) {
  return "<p class=\"" + style + "\">" + content + "</p>\n";
}

std::string section(const std::string& title) { return "<h2>" + html(title) + "</h2>\n"; }

HtmlTable::HtmlTable(const std::vector<std::string>& head, std::size_t words) : words_(words) {
  text_ = "<div class=\"scroll\"><table><thead>" + row_of(head, words, "th") + "</thead><tbody>";
}

void HtmlTable::row(const std::vector<std::string>& cells) { text_ += row_of(cells, words_, "td"); }

std::vector<std::string> undrawn(const std::vector<ReportFigure>& figures) {
  std::vector<std::string> messages;
  for (const ReportFigure& figure : figures)
    if (figure.svg.empty()) messages.push_back(figure.message);
  return messages;
}

std::string figures_of(const std::vector<ReportFigure>& figures) {
  std::string text = figures.empty() ? "" : section("Figures");
  int number = 0;
  for (const ReportFigure& figure : figures) {
    const std::string name = html(figure.name);
    text += "<figure id=\"figure-" + name + "\">\n";
    text += figure.svg.empty() ? text_block("bad", html(figure.message)) : described_svg(figure);
    text += fmt::format(
        "<figcaption><b>Figure {}.</b> {} <a href=\"{}.csv\">{}.csv</a>"
        "</figcaption>\n</figure>\n",
        ++number, html(figure.caption), name, name);
  }
  return text;
}

}  // namespace hookpoint::studies
