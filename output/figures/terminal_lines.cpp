#include "output/figures/terminal_lines.h"

#include <cctype>

#include "output/figures/plot.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

const std::string svg_begin = "set terminal svg size ";

/// `name` with _ for each character that gnuplot takes in no name of an SVG: "p[1]" as "p_1_".
std::string svg_name(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

}  // namespace

std::string svg_terminal(const std::string& name, double width, double height) {
  constexpr int digits = 6;
  return svg_begin + text::rounded(width, digits) + "," + text::rounded(height, digits) +
         " enhanced font 'Helvetica,13' background '#ffffff' name " +
         gnuplot_quoted(svg_name(name)) + "\nset output " + gnuplot_quoted(name + ".svg") + "\n";
}

std::string with_pdf_terminal(const std::string& script, const std::string& name) {
  const std::size_t begin = script.find(svg_begin);
  if (begin == std::string::npos) return "";
  const std::size_t width = begin + svg_begin.size(), comma = script.find(',', width);
  const std::size_t height = comma + 1, height_end = script.find(' ', height);
  const std::size_t lines_end = script.find('\n', script.find("set output ", height_end));
  return script.substr(0, begin) + "set terminal pdfcairo size " +
         script.substr(width, comma - width) + "/96.," +
         script.substr(height, height_end - height) +
         "/96. enhanced font 'Helvetica,13' fontscale 0.7 linewidth 2\nset output " +
         gnuplot_quoted(name + ".pdf") + script.substr(lines_end);
}

}  // namespace hookpoint::output
