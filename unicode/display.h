// Characters of UTF-8 text, as strict as the standard: no overlong forms, no surrogates, nothing
// above U+10FFFF.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hookpoint::language {

/// A character at the begin of a text.
struct Character {
  std::size_t length = 0;   ///< bytes; 0 if the text does not begin with a character
  std::size_t columns = 0;  ///< that it takes on a terminal: 0, 1 or 2
  bool control = false;     ///< it does something instead of being seen: tab, line end, escape
};
Character first_character(std::string_view text);

/// Where the first control character of `text` stands, npos without any.
std::size_t find_control(std::string_view text);

/// The text fit for a terminal: what cannot be shown or would command it becomes one '?' a byte. A
/// tab stays where `tabs`.
std::string printable(std::string_view text, bool tabs = false);

/// The first characters of `text`, whole, in at most `most` bytes.
std::string_view first_characters(std::string_view text, std::size_t most);

/// The columns that `printable` text takes, a tab as one.
std::size_t display_width(std::string_view text);

}  // namespace hookpoint::language
