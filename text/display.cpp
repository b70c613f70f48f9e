#include "text/display.h"

#include <algorithm>

#include "text/utf8.h"

namespace hookpoint::text {

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
  while (end > 0 && most - end < longest_character && continues_character(text[end])) --end;
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

}  // namespace hookpoint::text
