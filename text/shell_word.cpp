#include "text/shell_word.h"

#include <algorithm>
#include <string_view>

namespace hookpoint::text {

std::string quoted_shell_word(const std::string& text) {
  std::string word = "'";
  // A quote is closed, written by itself, and opened again.
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string shell_word(const std::string& text) {
  const bool plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:+@%").find(c) != std::string_view::npos;
  });
  return plain ? text : quoted_shell_word(text);
}

}  // namespace hookpoint::text
