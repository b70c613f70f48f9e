// Tables and figures as LaTeX, for papers: text in which nothing of others is a command.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::output {

/// Text in which TeX's own characters stand for themselves, "m/s^2" is typeset, and Greek letters
/// and other signs are commands that pdfTeX knows. A character that it has not is "[U+4E2D]".
std::string latex_text(std::string_view text);

/// A number for a cell, of three significant digits: "$-1.2 \times 10^{-7}$"; "--" without a value.
std::string latex_number(const std::optional<double>& value);

/// A table; its cells and titles are LaTeX.
struct LatexTable {
  std::string name;     ///< of its file, NAME.tex
  std::string label;    ///< tab:LABEL
  std::string caption;  ///< plain text
  std::string across;   ///< what stands over all columns but the first; "" for nothing
  std::vector<std::string> head;
  std::size_t text_columns = 1;  ///< the first ones, aligned left; the others are numbers
  std::vector<std::vector<std::string>> rows;
};

/// A `table` environment, with the rules of the package booktabs, no wider than the line; ""
/// of a table without rows or numbers. Where it has more than eight columns their titles stand
/// upright; where it has more than 45 rows it is in several parts, tab:LABEL-1 and so on.
std::string latex_table(const LatexTable& table);

/// A `figure` environment with NAME.pdf. `caption` is plain text.
std::string latex_figure(const std::string& name, const std::string& caption);

/// Types of the files that a table of results may leave: NAME.csv ...
inline constexpr const char* table_types[] = {".csv", ".tex"};

/// Behind a number for which a truth does not hold.
inline constexpr const char* latex_star = "$^{\\ast}$";

/// Names, without types, of the LaTeX that a study leaves beside that of its own tables and figures.
inline constexpr const char* latex_summary = "summary";
inline constexpr const char* latex_document_name = "tables_and_figures";
inline constexpr std::array<std::string_view, 2> latex_names{latex_summary, latex_document_name};

/// A document that inputs these files, to compile as it is.
std::string latex_document(const std::string& title, const std::vector<std::string>& names);

}  // namespace hookpoint::output
