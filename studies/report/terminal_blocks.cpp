#include "studies/report/terminal_blocks.h"

#include <algorithm>
#include <sstream>

#include "text/display.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t between_columns = 2;
constexpr std::size_t between_groups = 3;

std::string padded(const Cell& cell, std::size_t width, bool color) {
  const std::string shown = text::printable(cell.text);
  const std::string space(width - std::min(width, text::display_width(shown)), ' ');
  const std::string text = toned(shown, cell.tone, color);
  return cell.right ? space + text : text + space;
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

void ColumnGroup::measure() {
  widths.assign(rows.front().size(), 0);
  for (const CellRow& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], text::display_width(row[i].text));
}

std::size_t ColumnGroup::width() const {
  std::size_t sum = between_columns * (widths.size() - 1);
  for (const std::size_t one : widths) sum += one;
  return std::max(sum, text::display_width(title));
}

std::string toned(const std::string& text, Tone tone, bool color) {
  if (!color || tone == Tone::plain) return text;
  const char* code = tone == Tone::good ? "\033[32m" : tone == Tone::bad ? "\033[1;31m" : "\033[2m";
  return code + text + "\033[0m";
}

std::string print_groups(const std::vector<const ColumnGroup*>& groups, bool color) {
  const std::string gap(between_groups, ' ');
  std::string titles, text;
  for (const ColumnGroup* group : groups)
    titles += padded({group->title, Tone::plain, false}, group->width(), color) + gap;
  if (titles.find_first_not_of(' ') != std::string::npos) text += without_trailing_spaces(titles);
  for (std::size_t row = 0; row < groups.front()->rows.size(); ++row) {
    std::string line;
    for (const ColumnGroup* group : groups) {
      std::string part;
      std::size_t used = 0;
      for (std::size_t i = 0; i < group->widths.size(); ++i) {
        const std::string space(i > 0 ? between_columns : 0, ' ');
        part += space + padded(group->rows[row][i], group->widths[i], color);
        used += space.size() + group->widths[i];
      }
      line += part + std::string(group->width() - used, ' ') + gap;
    }
    text += without_trailing_spaces(line);
  }
  return text;
}

std::size_t printed_width(const std::vector<const ColumnGroup*>& groups) {
  std::size_t width = between_groups * (groups.size() - 1);
  for (const ColumnGroup* group : groups) width += group->width();
  return width;
}

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
      lines += line + "\n" + std::string(indent, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line + "\n";
}

}  // namespace hookpoint::studies
