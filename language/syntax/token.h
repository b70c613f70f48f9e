// The words of the language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "language/report.h"
#include "language/source.h"

namespace hookpoint::language {

enum class TokenKind : std::uint8_t {
  identifier,
  number,  ///< with its unit: "30 kN/m"
  text,    ///< with its quotes
  comment,
  open_brace,
  close_brace,
  open_parenthesis,
  close_parenthesis,
  open_bracket,
  close_bracket,
  semicolon,
  comma,
  dot,
  range,
  assign,
  plus,
  minus,
  star,
  slash,
  caret,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  and_operator,
  or_operator,
  not_operator,
  question,
  colon,
  unknown,
  end,
};

/// The words that begin an item and are no names.
inline constexpr std::string_view reserved_words[] = {"Wire",    "Param",  "Let",
                                                      "Include", "Plugin", "For"};

/// Whether the word may name an object: letters, digits and _, the first no digit, none of these.
bool is_object_name(std::string_view word);

struct Token {
  TokenKind kind = TokenKind::end;
  bool begins_line = false;  ///< the first of its line
  std::uint32_t offset = 0, length = 0;
};

inline std::string_view text_of(const SourceFile& file, const Token& token) {
  return std::string_view(file.text).substr(token.offset, token.length);
}

/// All tokens of a file that `check_text` accepts, the last one `end`. Comments only on request
/// for. Cost: linear.
std::vector<Token> tokenize(const SourceFile& file, bool comments, Report& report);

/// How many bytes the digits take with which `text` begins, without a unit: 12, .5 or 1e-3. The
/// first dot of `0..5` is not the number's.
std::size_t digits_length(std::string_view text);

/// False, with an error in `report`, when the file is no text: NUL and control bytes, broken UTF-8,
/// too large.
bool check_text(const SourceFile& file, Report& report);

}  // namespace hookpoint::language
