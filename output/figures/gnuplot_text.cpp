#include <utility>

#include "output/figures/plot.h"
#include "output/files/csv.h"

namespace hookpoint::output {

std::string one_line(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return result;
}

std::string gnuplot_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) result.append(c == '\'' ? 2 : 1, c);
  return result + "'";
}

std::string gnuplot_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string typeset(std::string text) {
  for (const auto& [plain, set] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}})
    for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain, at))
      text.replace(at, 2, set);
  return text;
}

std::string axis_title(const Axis& axis) { return typeset(column_title(axis.label, axis.unit)); }

}  // namespace hookpoint::output
