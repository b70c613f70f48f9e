#include "language/wording.h"

#include <charconv>

namespace hookpoint::language {

std::string with_article(std::string_view noun) {
  constexpr std::string_view vowels = "AEIOaeio";
  const bool vowel = !noun.empty() && vowels.find(noun.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(noun);
}

std::string rounded_text(double value) {
  constexpr int digits = 6;
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return {buffer, end};
}

}  // namespace hookpoint::language
