// Words and numbers of the text formats among meshes.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace hookpoint::simulation {

inline constexpr std::string_view mesh_blanks = " \t\r\n";

/// Takes the next word off `text`; "" at its end.
inline std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(mesh_blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(mesh_blanks));
  text.remove_prefix(word.size());
  return word;
}

/// A finite number, the whole word; nothing else.
inline std::optional<double> mesh_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace hookpoint::simulation
