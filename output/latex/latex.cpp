#include "output/latex/latex.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <utility>

#include "text/number.h"
#include "text/utf8.h"

namespace hookpoint::output {
namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

constexpr auto characters = std::to_array<Replacement>({
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"$", "\\$"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"~", "\\textasciitilde{}"},
    {"`", "\\textasciigrave{}"},
    {"<", "$<$"},
    {">", "$>$"},
    {"|", "$|$"},
    {"\"", "\\textquotedbl{}"},
    {"\n", " "},
    {"µ", "\\textmu{}"},
    {"²", "$^2$"},
    {"³", "$^3$"},
    {"−", "$-$"},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\ldots{}"},
    {"‘", "'"},
    {"’", "'"},
    {"“", "\\textquotedbl{}"},
    {"”", "\\textquotedbl{}"},
    {"α", "$\\alpha$"},
    {"β", "$\\beta$"},
    {"γ", "$\\gamma$"},
    {"δ", "$\\delta$"},
    {"ε", "$\\varepsilon$"},
    {"ζ", "$\\zeta$"},
    {"η", "$\\eta$"},
    {"θ", "$\\theta$"},
    {"κ", "$\\kappa$"},
    {"λ", "$\\lambda$"},
    {"μ", "$\\mu$"},
    {"ν", "$\\nu$"},
    {"ξ", "$\\xi$"},
    {"π", "$\\pi$"},
    {"ρ", "$\\rho$"},
    {"σ", "$\\sigma$"},
    {"τ", "$\\tau$"},
    {"φ", "$\\varphi$"},
    {"χ", "$\\chi$"},
    {"ψ", "$\\psi$"},
    {"ω", "$\\omega$"},
    {"Γ", "$\\Gamma$"},
    {"Δ", "$\\Delta$"},
    {"Θ", "$\\Theta$"},
    {"Λ", "$\\Lambda$"},
    {"Ξ", "$\\Xi$"},
    {"Π", "$\\Pi$"},
    {"Σ", "$\\Sigma$"},
    {"Φ", "$\\Phi$"},
    {"Ψ", "$\\Psi$"},
    {"Ω", "$\\Omega$"},
    {"±", "$\\pm$"},
    {"×", "$\\times$"},
    {"·", "$\\cdot$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"≠", "$\\neq$"},
    {"≈", "$\\approx$"},
    {"∞", "$\\infty$"},
    {"→", "$\\rightarrow$"},
    {"√", "$\\surd$"},
    {"°", "$^\\circ$"},
});

/// "[U+4E2D]".
std::string code_of(char32_t point) {
  std::array<char, 8> digits{};
  constexpr int hexadecimal = 16;
  const auto end =
      std::to_chars(digits.begin(), digits.end(), static_cast<std::uint32_t>(point), hexadecimal);
  std::string code = "[U+" + std::string(digits.begin(), end.ptr) + "]";
  for (char& c : code)
    if (c >= 'a' && c <= 'f') c = static_cast<char>(c - 'a' + 'A');
  return code;
}

/// The beginning of `text` as LaTeX, and how many bytes that is.
std::pair<std::string, std::size_t> first_piece(std::string_view text) {
  for (const auto& [from, to] : characters)
    if (text.starts_with(from)) return {std::string(to), from.size()};
  // Two of these in a row would be one sign.
  for (const std::string_view pair : {"--", "''", ",,"})
    if (text.starts_with(pair)) return {std::string(1, pair[0]) + "{}", 1};
  const text::Character character = text::first_character(text);
  if (character.length == 0) return {"?", 1};
  if (character.control) return {" ", character.length};
  constexpr char32_t latin_end = 0x180;  // of what pdfTeX has letters for
  if (character.point >= latin_end) return {code_of(character.point), character.length};
  return {std::string(text.substr(0, character.length)), character.length};
}

/// "2" of "s^2 x", "-1" of "s^-1"; "" where no power begins.
std::string_view power_at(std::string_view text) {
  std::size_t end = !text.empty() && text[0] == '-' ? 1 : 0;
  const std::size_t first = end;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  return end > first ? text.substr(0, end) : std::string_view();
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? " & " : "") + cells[i];
  return line + " \\\\\n";
}

/// So many rows fit a page.
constexpr std::size_t most_rows = 45;

/// The tables "tab:LABEL-1", "tab:LABEL-2", a page each.
std::string in_parts(const LatexTable& table) {
  const std::size_t parts = (table.rows.size() + most_rows - 1) / most_rows;
  std::string text;
  for (std::size_t i = 0; i < parts; ++i) {
    const auto begin = table.rows.begin() + static_cast<std::ptrdiff_t>(i * most_rows);
    const auto left = static_cast<std::size_t>(table.rows.end() - begin);
    LatexTable part = table;
    part.rows = {begin, begin + static_cast<std::ptrdiff_t>(std::min(left, most_rows))};
    part.label += "-" + std::to_string(i + 1);
    part.caption += " Part " + std::to_string(i + 1) + " of " + std::to_string(parts) + ".";
    text += latex_table(part);
  }
  return text;
}

}  // namespace

std::string latex_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    if (text[0] == '^') {
      const std::string_view power = power_at(text.substr(1));
      out += power.empty() ? "\\textasciicircum{}" : "$^{" + std::string(power) + "}$";
      text.remove_prefix(1 + power.size());
      continue;
    }
    const auto [piece, length] = first_piece(text);
    out += piece;
    text.remove_prefix(length);
  }
  return out;
}

std::string latex_number(const std::optional<double>& value) {
  if (!value) return "--";
  constexpr int digits = 3;
  const std::string text = text::rounded(*value, digits);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return "$" + text + "$";
  const int power = std::stoi(text.substr(exponent + 1));
  return "$" + text.substr(0, exponent) + " \\times 10^{" + std::to_string(power) + "}$";
}

std::string latex_table(const LatexTable& table) {
  if (table.rows.empty() || table.head.size() <= table.text_columns) return "";
  if (table.rows.size() > most_rows) return in_parts(table);
  constexpr std::size_t most_level = 8;  // columns whose titles lie
  const std::size_t columns = table.head.size();
  std::string text = "\\begin{table}[htbp]\n\\centering\n\\caption{" + latex_text(table.caption) +
                     "}\n\\label{tab:" + table.label + "}\n\\vspace{1ex}\n";
  // No wider than the line.
  text += "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{%\n";
  text += "\\begin{tabular}{" + std::string(table.text_columns, 'l') +
          std::string(columns - table.text_columns, 'r') + "}\n\\toprule\n";
  if (!table.across.empty()) {
    const std::string others = std::to_string(columns - 1), last = std::to_string(columns);
    text += " & \\multicolumn{" + others + "}{c}{" + table.across + "} \\\\\n\\cmidrule(lr){2-" +
            last + "}\n";
  }
  std::vector<std::string> head = table.head;
  for (std::size_t i = table.text_columns; columns > most_level && i < columns; ++i)
    head[i] = "\\rotatebox{90}{" + head[i] + "}";
  text += joined(head) + "\\midrule\n";
  for (const std::vector<std::string>& row : table.rows) text += joined(row);
  return text + "\\bottomrule\n\\end{tabular}}\n\\end{table}\n";
}

std::string latex_figure(const std::string& name, const std::string& caption) {
  return "\\begin{figure}[htbp]\n\\centering\n\\includegraphics[width=\\linewidth]{" + name +
         ".pdf}\n\\caption{" + latex_text(caption) + "}\n\\label{fig:" + name +
         "}\n\\end{figure}\n";
}

std::string latex_document(const std::string& title, const std::vector<std::string>& names) {
  std::string text =
      "\\documentclass{article}\n\\usepackage[margin=25mm]{geometry}\n\\usepackage{booktabs}\n"
      "\\usepackage{graphicx}\n\\usepackage[T1]{fontenc}\n\\usepackage{textcomp}\n\\title{" +
      latex_text(title) + "}\n\\date{}\n\\begin{document}\n\\maketitle\n";
  for (const std::string& name : names) text += "\\input{" + name + "}\n";
  return text + "\\end{document}\n";
}

}  // namespace hookpoint::output
