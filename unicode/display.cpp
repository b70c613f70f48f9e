// The one file of this folder that sees utf8proc.
#include "unicode/display.h"

#include <utf8proc.h>

#include <algorithm>

namespace hookpoint::language {

Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {1, 1, lead < 0x20 || lead == 0x7F};
  utf8proc_int32_t point = 0;
  const utf8proc_ssize_t length = utf8proc_iterate(
      reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
      static_cast<utf8proc_ssize_t>(std::min<std::size_t>(text.size(), 4)), &point);
  if (length <= 0) return {};
  return {static_cast<std::size_t>(length), static_cast<std::size_t>(utf8proc_charwidth(point)),
          utf8proc_category(point) == UTF8PROC_CATEGORY_CC};
}

std::size_t find_control(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character character = first_character(text.substr(at));
    if (character.control) return at;
    at += std::max<std::size_t>(character.length, 1);
  }
  return std::string_view::npos;
}

std::string printable(std::string_view text, bool tabs) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    const bool tab = tabs && text[0] == '\t';
    if (character.length == 0 || (character.control && !tab)) {
      result.append(length, '?');
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return result;
}

std::string_view first_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  constexpr std::size_t longest_character = 4;
  std::size_t end = most;
  while (end > 0 && most - end < longest_character &&
         (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;
  return text.substr(0, end);
}

std::size_t display_width(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    columns += character.length == 0 || character.control ? length : character.columns;
    text.remove_prefix(length);
  }
  return columns;
}

}  // namespace hookpoint::language
