#include "output/latex/latex.h"

#include <array>
#include <cctype>
#include <utility>

#include "text/number.h"

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
    {"<", "$<$"},
    {">", "$>$"},
    {"|", "$|$"},
    {"\"", "\\textquotedbl{}"},
    {"\n", " "},
    {"°", "$^\\circ$"},
    {"µ", "\\textmu{}"},
    {"μ", "\\textmu{}"},
    {"²", "$^2$"},
    {"³", "$^3$"},
    {"±", "$\\pm$"},
    {"×", "$\\times$"},
    {"·", "$\\cdot$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"−", "$-$"},
    {"–", "--"},
    {"…", "\\ldots{}"},
    {"é", "\\'e"},
});

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
    bool replaced = false;
    for (const auto& [from, to] : characters) {
      if (!text.starts_with(from)) continue;
      out += to;
      text.remove_prefix(from.size());
      replaced = true;
      break;
    }
    if (replaced) continue;
    out += text[0];
    text.remove_prefix(1);
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
  constexpr std::size_t most_level = 8;  // columns whose titles lie
  const std::size_t columns = table.head.size();
  std::string text = "\\begin{table}\n\\centering\n\\caption{" + latex_text(table.caption) +
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
  return "\\begin{figure}\n\\centering\n\\includegraphics[width=\\linewidth]{" + name +
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
