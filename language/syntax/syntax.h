// A file as parsed: items, expressions and references in flat tables, so that a large file costs
// little and no depth of nesting is met again after the parser.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "language/dimension.h"
#include "language/report.h"
#include "language/schema/schema.h"
#include "language/source.h"

namespace hookpoint::language {

/// Bytes of the file.
struct Span {
  std::uint32_t offset = 0, length = 0;
};

/// Elements begin <= i < end of one of the tables below.
struct Range {
  std::uint32_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
  std::uint32_t size() const { return end - begin; }
};

/// The operators of expressions and of formulas.
enum class Operator : std::uint8_t {
  negate,
  logical_not,
  add,
  subtract,
  multiply,
  divide,
  raise,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  both,    ///< &&
  either,  ///< ||
};

/// Expressions are postfix code: an operand is pushed, an operator takes its operands from the
/// stack.
enum class Operation : std::uint8_t {
  push_number,  ///< operand: index of Syntax::quantities
  push_true,
  push_false,
  push_text,        ///< span: the string with its quotes
  push_trail,       ///< operand: index of Syntax::trails
  call,             ///< operand: number of arguments; span: the function's name
  apply,            ///< operand: an Operator, with one or two operands on the stack
  skip_if_false,    ///< (&&) a false on top stays and the code continues at `operand`, a true is
                    ///< taken away
  skip_if_true,     ///< the mirror image (||)
  check_boolean,    ///< the top must be true or false
  branch_if_false,  ///< takes the top; when false continues at `operand`
  jump,             ///< continues at `operand`
};

struct Instruction {
  Operation operation;
  Span span;
  std::uint32_t operand = 0;
};

/// A value with its dimension.
struct Quantity {
  double value = 0.;
  Dimension dimension;
};

struct Expression {
  Range code;
  Span span;
};

struct TrailPart {
  Span name;
  bool indexed = false;
  Expression index;
};

struct Trail {
  Range parts;
  Span span;
};

enum class ItemKind : std::uint8_t {
  object,
  assignment,
  wire,
  param,
  let,
  include,
  plugin,
  for_loop
};

struct Item {
  ItemKind kind = ItemKind::object;
  bool indexed = false;      ///< the name has an [index]
  Span place;                ///< type, field name or keyword
  Span name;                 ///< object, variable, include; length 0 without
  Range value;               ///< of Syntax::expressions; of a loop over a list its values; of an
                             ///< Include its path, where that is not just written in quotes
  Range items;               ///< of Syntax::items: what stands inside
  std::uint32_t detail = 0;  ///< of Syntax::details, where there is more to say
};

/// An argument of an Include.
struct Argument {
  Span name;
  Range value;
};

/// What few items have.
struct Detail {
  Expression index;  ///< of an indexed name
  bool has_from = false, has_to = false;
  Trail from, to;          ///< a wire's ends
  Expression first, last;  ///< a loop's range
  Span path;               ///< an include's or a plugin's, with its quotes where it has any
  Range arguments;         ///< of Syntax::arguments
};

struct Syntax {
  std::vector<Item> items;
  std::vector<Expression> expressions;
  std::vector<Instruction> code;
  std::vector<Quantity> quantities;
  std::vector<Span> units;  ///< of each of the quantities as it is written; length 0 without
  std::vector<Trail> trails;
  std::vector<TrailPart> parts;
  std::vector<Argument> arguments;
  std::vector<Detail> details;
  Range top;  ///< the file's own items
};

/// A file as parsed. Positions point into its source, which outlives what was made of it.
struct ParsedFile {
  const SourceFile& source;
  Syntax syntax = {};
  Report report = {};                     ///< its syntax errors
  const ForeignReader* reader = nullptr;  ///< of a file in another format, which has no syntax
};

/// Parses `file.source` into `file.syntax`, all errors into `file.report`. Cost: linear.
void parse(ParsedFile& file);
/// Parses `trail = value` (an override) or, as a Param's, `name = value`: one item of kind
/// assignment whose place is the name, and the trail in its detail's `to`.
void parse_override(ParsedFile& file);

/// A string token's characters, escapes resolved.
std::string unquote(std::string_view token);

}  // namespace hookpoint::language
