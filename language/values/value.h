// What an expression yields while a file is evaluated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/syntax/syntax.h"

namespace hookpoint::language {

enum class ValueKind : std::uint8_t { number, boolean, text, word };

struct Value {
  ValueKind kind = ValueKind::number;
  Quantity quantity;  ///< number (SI); boolean: value 0 or 1
  std::string text;   ///< text; word: a name or trail that is no variable, to be understood by the
                      ///< field that takes it
  Position position;  ///< where it was written: of a word, where it stands in the text
  bool from_outside =
      false;  ///< set from outside the file (EvaluateOptions), or worked out of what was
};

/// "a number in m", "a string", "true or false", "the word `x`".
std::string describe_value(const Value& value);

}  // namespace hookpoint::language
