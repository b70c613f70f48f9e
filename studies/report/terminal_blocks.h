// Text in columns: the cells, groups of columns and rows that the terminal's tables are made of.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hookpoint::studies {

enum class Tone { plain, good, bad, faint };

struct Cell {
  std::string text;
  Tone tone = Tone::plain;
  bool right = true;  ///< alignment
};

using CellRow = std::vector<Cell>;

/// Columns side by side under one title; the first row is their header.
struct ColumnGroup {
  std::string title;
  std::vector<CellRow> rows;
  std::vector<std::size_t> widths;

  /// Call when all rows are there.
  void measure();
  std::size_t width() const;
};

/// `text` between the escapes of its tone, where the terminal shows colours.
std::string toned(const std::string& text, Tone tone, bool color);

/// The groups side by side under their titles, if any has one; each line ended by a line feed; all
/// must have the same number of rows.
std::string print_groups(const std::vector<const ColumnGroup*>& groups, bool color);

/// Columns that `print_groups` needs for them.
std::size_t printed_width(const std::vector<const ColumnGroup*>& groups);

/// Words in lines of at most `width` characters; lines after the first begin with `indent` spaces,
/// which count, as does the text that stands already on the first.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

}  // namespace hookpoint::studies
