// Source text and places in it. A SourceFile never moves once loaded, so a Position may point to
// it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::language {

struct SourceFile {
  std::string path;  ///< as shown to the user
  std::string text;
  std::vector<std::size_t> line_starts;  ///< offset of each line's first byte
};

/// A stretch of a file. `file` is null for what no file says (a command-line override).
struct Position {
  const SourceFile* file = nullptr;
  std::size_t offset = 0;  ///< byte offset of the first character
  std::size_t length = 1;  ///< bytes underlined by the caret
};

/// Line and column of a position, both from 1; the column counts characters (UTF-8 code points).
struct LineColumn {
  std::size_t line = 0, column = 0;
};
LineColumn line_and_column(const Position& position);

/// `text` under the name `path`, with its lines found.
SourceFile source_file(std::string path, std::string text);
/// Line number `line`, from 1, without its end.
std::string_view line_text(const SourceFile& file, std::size_t line);

}  // namespace hookpoint::language
