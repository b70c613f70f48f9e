// Tables and figures as LaTeX: no text of others is a command.
#include "output/latex/latex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/support/text.h"

namespace hookpoint::output {
namespace {

TEST(Latex, TextStandsForItself) {
  EXPECT_EQ(latex_text("creep_speed"), "creep\\_speed");
  EXPECT_EQ(latex_text("50 % & #1 {x} $y$ ~"),
            "50 \\% \\& \\#1 \\{x\\} \\$y\\$ \\textasciitilde{}");
  EXPECT_EQ(latex_text("\\input{/etc/passwd}"), "\\textbackslash{}input\\{/etc/passwd\\}");
  EXPECT_EQ(latex_text("acceleration [m/s^2]"), "acceleration [m/s$^{2}$]");
  EXPECT_EQ(latex_text("s^-1"), "s$^{-1}$");
  EXPECT_EQ(latex_text("a^b^"), "a\\textasciicircum{}b\\textasciicircum{}");
  EXPECT_EQ(latex_text("15° ± 2 µm"), "15$^\\circ$ $\\pm$ 2 \\textmu{}m");
  EXPECT_EQ(latex_text("Größe Ω → ∞"), "Größe $\\Omega$ $\\rightarrow$ $\\infty$");
  EXPECT_EQ(latex_text("中 \xff"), "[U+4E2D] ?");
  EXPECT_EQ(latex_text("a--b ''c''"), "a-{}-b '{}'c'{}'");
}

TEST(Latex, NumbersAreTypeset) {
  EXPECT_EQ(latex_number(0.5), "$0.5$");
  EXPECT_EQ(latex_number(-1.2345678e-7), "$-1.23 \\times 10^{-7}$");
  EXPECT_EQ(latex_number(6.02e23), "$6.02 \\times 10^{23}$");
  EXPECT_EQ(latex_number(std::nullopt), "--");
}

/// Where TeX would see `c` as its own: not behind a backslash that escapes it.
std::size_t bare(const std::string& text, char c) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\')
      ++i;  // a control symbol, or the first letter of a control word
    else if (text[i] == c)
      ++count;
  }
  return count;
}

TEST(Latex, AnyTextLeavesGroupsAndFormulasClosed) {
  std::mt19937 random(1);
  const std::string letters = "ab1 \\{}$&%#_~^<>|\"-\n";
  std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1), length(0, 30);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t n = length(random); n > 0; --n) text += letters[letter(random)];
    const std::string latex = latex_text(text);
    SCOPED_TRACE(text);
    EXPECT_EQ(bare(latex, '{'), bare(latex, '}'));
    EXPECT_EQ(bare(latex, '$') % 2, 0u);
    for (const char c : std::string("&%#_~\n")) EXPECT_EQ(bare(latex, c), 0u) << latex;
  }
}

TEST(Latex, ATableWithoutRowsOrNumbersIsNone) {
  const LatexTable full{.name = "t",
                        .label = "t",
                        .caption = "",
                        .across = "x",
                        .head = {"a", "b"},
                        .text_columns = 1,
                        .rows = {{"c", "$1$"}}};
  EXPECT_NE(latex_table(full), "");
  LatexTable table = full;
  table.rows.clear();
  EXPECT_EQ(latex_table(table), "");
  table = full;
  table.head = {"a"};
  EXPECT_EQ(latex_table(table), "");
}

TEST(Latex, ALongTableIsInPartsThatHaveEveryRowOnce) {
  LatexTable table{.name = "t",
                   .label = "t",
                   .caption = "c.",
                   .across = "",
                   .head = {"a", "b"},
                   .text_columns = 1,
                   .rows = {}};
  for (int i = 0; i < 100; ++i) table.rows.push_back({"row" + std::to_string(i) + "x", "$1$"});
  const std::string text = latex_table(table);
  EXPECT_EQ(testing::count(text, "\\begin{table}"), 3u);
  EXPECT_EQ(testing::count(text, "\\label{tab:t-3}"), 1u);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(testing::count(text, "row" + std::to_string(i) + "x"), 1u) << i;
}

TEST(Latex, ATableHasItsRulesAndEveryCell) {
  const LatexTable table{.name = "t",
                         .label = "t",
                         .caption = "50 %",
                         .across = "slope",
                         .head = {"subject", "5 deg", "10 deg"},
                         .text_columns = 1,
                         .rows = {{"a", "$1$", "$2$"}, {"b", "$3$", "--"}}};
  EXPECT_EQ(latex_table(table),
            "\\begin{table}[htbp]\n\\centering\n\\caption{50 \\%}\n\\label{tab:t}\n\\vspace{1ex}\n"
            "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{%\n"
            "\\begin{tabular}{lrr}\n\\toprule\n & \\multicolumn{2}{c}{slope} \\\\\n"
            "\\cmidrule(lr){2-3}\nsubject & 5 deg & 10 deg \\\\\n\\midrule\na & $1$ & $2$ \\\\\n"
            "b & $3$ & -- \\\\\n\\bottomrule\n\\end{tabular}}\n\\end{table}\n");
}

}  // namespace
}  // namespace hookpoint::output
