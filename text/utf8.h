// The decoder of UTF-8, as strict as the standard: no overlong forms, no surrogates, nothing above
// U+10FFFF.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hookpoint::text {

/// A character at the begin of a text.
struct Character {
  std::size_t length = 0;   ///< bytes; 0 if the text does not begin with a character
  char32_t point = 0xfffd;  ///< its code point; U+FFFD stands for what is no character
  std::size_t columns = 0;  ///< that it takes on a terminal: 0, 1 or 2
  bool control = false;     ///< it does something instead of being seen: tab, line end, escape
};

/// The character with which `text` begins.
Character first_character(std::string_view text);

/// Whether a byte of UTF-8 is one behind a character's first.
inline bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U;
}

/// The code points of `utf8`. A byte that begins no character makes one U+FFFD together with the
/// bytes behind it that continue a character. Cost: linear.
std::u32string code_points(std::string_view utf8);

/// `utf8` with each part that makes no character as U+FFFD; `utf8` itself where it is good.
std::string repaired(std::string_view utf8);

/// UTF-16 of the same code points, with surrogate pairs above U+FFFF.
std::u16string utf16(std::string_view utf8);

}  // namespace hookpoint::text
