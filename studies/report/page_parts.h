// Parts that pages about constants are made of: paragraphs, tables, figures.
#pragma once

#include <string>
#include <vector>

#include "studies/report/report.h"

namespace hookpoint::studies {

/// A paragraph of a class of the style sheet; `content` is HTML.
std::string text_block(const std::string& style, const std::string& content);
/// A heading; plain text.
std::string section(const std::string& title);

/// A table, row by row; cells are HTML.
class HtmlTable {
 public:
  /// The first `words` columns are text.
  HtmlTable(const std::vector<std::string>& head, std::size_t words);
  void row(const std::vector<std::string>& cells);
  std::string text() const { return text_ + "</tbody></table></div>\n"; }

 private:
  std::size_t words_;
  std::string text_;
};

/// Why figures could not be drawn, of each that was not.
std::vector<std::string> undrawn(const std::vector<ReportFigure>& figures);

/// Under their heading, numbered, with captions that link to their data; "" of none.
std::string figures_of(const std::vector<ReportFigure>& figures);

}  // namespace hookpoint::studies
