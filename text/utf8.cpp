// The one file that sees utf8proc.
#include "text/utf8.h"

#include <utf8proc.h>

#include <algorithm>

namespace hookpoint::text {
namespace {

/// Takes the first character off `text`, or the bytes that stand where one should be.
Character take_character(std::string_view& text) {
  const Character character = first_character(text);
  std::size_t length = std::max<std::size_t>(character.length, 1);
  if (character.length == 0)
    while (length < text.size() && continues_character(text[length])) ++length;
  text.remove_prefix(length);
  return character;
}

}  // namespace

Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {1, lead, 1, lead < 0x20 || lead == 0x7f};
  constexpr std::size_t longest_character = 4;
  utf8proc_int32_t point = 0;
  const utf8proc_ssize_t length = utf8proc_iterate(
      reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
      static_cast<utf8proc_ssize_t>(std::min(text.size(), longest_character)), &point);
  if (length <= 0) return {};
  return {static_cast<std::size_t>(length), static_cast<char32_t>(point),
          static_cast<std::size_t>(utf8proc_charwidth(point)),
          utf8proc_category(point) == UTF8PROC_CATEGORY_CC};
}

std::u32string code_points(std::string_view utf8) {
  std::u32string points;
  while (!utf8.empty()) points += take_character(utf8).point;
  return points;
}

std::string repaired(std::string_view utf8) {
  constexpr std::string_view replacement = "\xef\xbf\xbd";
  std::string text;
  while (!utf8.empty()) {
    const std::string_view rest = utf8;
    const Character character = take_character(utf8);
    text += character.length > 0 ? rest.substr(0, character.length) : replacement;
  }
  return text;
}

std::u16string utf16(std::string_view utf8) {
  std::u16string units;
  for (const char32_t point : code_points(utf8)) {
    if (point < 0x10000) {
      units += static_cast<char16_t>(point);
      continue;
    }
    units += static_cast<char16_t>(0xd800 + ((point - 0x10000) >> 10U));
    units += static_cast<char16_t>(0xdc00 + ((point - 0x10000) & 0x3ffU));
  }
  return units;
}

}  // namespace hookpoint::text
