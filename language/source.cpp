#include "language/source.h"

#include <algorithm>
#include <utility>

#include "text/utf8.h"

namespace hookpoint::language {

SourceFile source_file(std::string path, std::string text) {
  SourceFile file{std::move(path), std::move(text), {0}};
  for (std::size_t i = 0; i < file.text.size(); ++i) {
    if (file.text[i] == '\n') file.line_starts.push_back(i + 1);
  }
  return file;
}

std::string_view line_text(const SourceFile& file, std::size_t line) {
  const std::size_t begin = file.line_starts[line - 1];
  std::size_t end = line < file.line_starts.size() ? file.line_starts[line] - 1 : file.text.size();
  if (end > begin && file.text[end - 1] == '\r') --end;
  return std::string_view(file.text).substr(begin, end - begin);
}

LineColumn line_and_column(const Position& position) {
  if (position.file == nullptr) return {};
  const std::vector<std::size_t>& starts = position.file->line_starts;
  const std::size_t offset = std::min(position.offset, position.file->text.size());
  const auto after = std::upper_bound(starts.begin(), starts.end(), offset);
  const auto line = static_cast<std::size_t>(after - starts.begin());
  const std::string_view before =
      std::string_view(position.file->text).substr(starts[line - 1], offset - starts[line - 1]);
  return {line, text::code_points(before).size() + 1};
}

}  // namespace hookpoint::language
