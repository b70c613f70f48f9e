// Rules that every message of the program keeps, whatever it is about.
#pragma once

#include <array>
#include <regex>
#include <string>

namespace hookpoint::testing {

/// A rule as the pattern that breaks it.
struct MessageRule {
  const char* name;
  const char* broken_by;
};

inline constexpr std::array message_rules{
    MessageRule{"a number has at most nine digits behind its point", R"(\d\.\d{10,})"},
    MessageRule{"`an` before a vowel", R"((^|[ "(])[Aa] `?([AEIOaei]|o(?!ne))\w)"},
    MessageRule{"`a` before a consonant", R"((^|[ "(])[Aa]n `?[bcdgjkpqtvwyz])"},
    MessageRule{"a name is said once", R"((--?\w[\w-]*): \1 )"},
    MessageRule{"no caret under an empty line", R"(\n *\d+ \|\s*\n)"},
    MessageRule{"nobody means the name that is not there", R"(`([^`]+)`[^`\n]*did you mean `\1`)"},
};

/// The first rule that `text` breaks and where; "" if it keeps them all.
inline std::string broken_rule(const std::string& text) {
  for (const MessageRule& rule : message_rules) {
    std::smatch found;
    if (std::regex_search(text, found, std::regex(rule.broken_by)))
      return std::string(rule.name) + ": ..." + found.str() + "...";
  }
  return "";
}

}  // namespace hookpoint::testing
