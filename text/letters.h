// Letters of ASCII, whatever the locale.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hookpoint::text {

/// The text with A ... Z as a ... z.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// The text without blanks, tabs and carriage returns around it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A field of a file as a message may show it: its first 30 bytes, without what a terminal obeys.
inline std::string shown(std::string_view text) {
  constexpr std::size_t most = 30;
  std::string printable(text.substr(0, most));
  for (char& c : printable)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text.size() > most ? printable + "..." : printable;
}

}  // namespace hookpoint::text
