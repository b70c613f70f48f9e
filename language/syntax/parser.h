// Recursive descent with recovery at `;` and `}`; expressions become postfix code.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "language/syntax/syntax.h"
#include "language/syntax/token.h"

namespace hookpoint::language {

class Parser {
 public:
  explicit Parser(ParsedFile& file);

  void parse_file();
  void parse_override();

 private:
  /// Nesting of braces, parentheses and brackets together: deeper than any experiment, shallow
  /// enough for the stack.
  static constexpr int deepest = 200;

  // parser_items.cpp
  /// Items up to `}` or the end of the file.
  void parse_items(std::vector<Item>& items);
  /// One item; false after a syntax error, from which the caller recovers.
  bool parse_item(std::vector<Item>& items);
  bool parse_assignment(Item& item);
  bool parse_object(Item& item);
  bool parse_wire(Item& item);
  bool parse_end(Detail& detail);
  bool parse_param(Item& item);
  bool parse_let(Item& item);
  bool parse_include(Item& item);
  /// The path in quotes, the name of what holds it, or an expression in parentheses.
  bool parse_path(Item& item, Detail& detail);
  bool parse_plugin(Item& item);
  bool parse_arguments(Detail& detail);
  bool parse_loop(Item& item);
  bool parse_loop_values(Item& item);
  /// `{ items }`, or one item, or `;`.
  bool parse_body(Item& item);
  bool parse_block(Item& item);
  bool parse_name(Item& item, Detail& detail);
  Range store(std::vector<Item>& items);
  void recover();
  void skip_group();

  // parser_expressions.cpp
  bool parse_value(Range& value);
  bool parse_expression(Expression& expression);
  bool parse_conditional();
  bool parse_or();
  bool parse_and();
  bool parse_comparison();
  bool parse_sum();
  bool parse_product();
  bool parse_unary();
  bool parse_power();
  bool parse_primary();
  bool parse_call();
  bool parse_number();
  /// The error that the unit which comes now does not belong to the number before it.
  bool fail_unit(const Token& number, bool has_unit);
  bool parse_trail(Trail& trail);
  /// The same as a value.
  bool parse_trail_value();
  bool parse_index(Expression& index);

  // parser.cpp
  const Token& token(std::size_t ahead = 0) const;
  bool at(TokenKind kind, std::size_t ahead = 0) const { return token(ahead).kind == kind; }
  bool at_word(std::string_view word, std::size_t ahead = 0) const;
  bool at_keyword(std::size_t ahead = 0) const;
  bool accept(TokenKind kind);
  bool expect(TokenKind kind, std::string_view what);
  /// After an item: where the line ends without `;` the error is at its end and the next line is an
  /// item of its own.
  bool expect_semicolon(std::string_view after);
  /// One level of nesting deeper while it lives; false when that is too deep.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser), good_(parser.enter()) {}
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    explicit operator bool() const { return good_; }

   private:
    Parser& parser_;
    bool good_;
  };
  bool enter();
  bool fail(const Token& where, std::string message);
  bool fail_here(std::string_view expected);
  std::string shown(const Token& token) const;
  std::string_view text(const Token& token) const { return text_of(file_.source, token); }
  Position position(const Token& token) const;
  Position position(const Span& span) const { return {&file_.source, span.offset, span.length}; }
  static Span span(const Token& token) { return {token.offset, token.length}; }
  Span span_from(const Token& first) const;
  void emit(Operation operation, const Token& token, std::uint32_t operand = 0);
  void apply(Operator sign, const Token& token) {
    emit(Operation::apply, token, static_cast<std::uint32_t>(sign));
  }
  Detail& detail_of(Item& item);

  ParsedFile& file_;
  Syntax& syntax_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool swallowed_ = false;  ///< a string or comment without an end has taken `;` and `}` with it
  bool stopped_ = false;    ///< nothing sensible can follow: nested too deeply, or too many errors
  std::vector<Token> open_braces_;
};

}  // namespace hookpoint::language
