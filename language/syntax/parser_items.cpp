// Items: objects, assignments, wires, Param, Let, Include, Plugin, For.
#include "language/syntax/parser.h"

namespace hookpoint::language {

void Parser::parse_items(std::vector<Item>& items) {
  while (!stopped_ && !at(TokenKind::end) && !at(TokenKind::close_brace)) {
    if (accept(TokenKind::semicolon)) continue;
    if (!parse_item(items) && !stopped_) recover();
  }
}

bool Parser::parse_item(std::vector<Item>& items) {
  if (!at(TokenKind::identifier))
    return fail_here("an object, a field, Wire, Param, Let, Include, Plugin or For");
  Item item;
  bool good = false;
  if (at(TokenKind::assign, 1) && !at_keyword()) {
    good = parse_assignment(item);
  } else if (at_word("Wire")) {
    good = parse_wire(item);
  } else if (at_word("Param")) {
    good = parse_param(item);
  } else if (at_word("Let")) {
    good = parse_let(item);
  } else if (at_word("Include")) {
    good = parse_include(item);
  } else if (at_word("Plugin")) {
    good = parse_plugin(item);
  } else if (at_word("For")) {
    good = parse_loop(item);
  } else {
    good = parse_object(item);
  }
  if (good) items.push_back(item);
  return good;
}

bool Parser::parse_assignment(Item& item) {
  item.kind = ItemKind::assignment;
  item.place = span(token());
  at_ += 2;
  return parse_value(item.value) && expect_semicolon("the value");
}

bool Parser::parse_object(Item& item) {
  item.kind = ItemKind::object;
  const Token first = token();
  ++at_;
  while (at(TokenKind::dot) && at(TokenKind::identifier, 1)) at_ += 2;
  item.place = span_from(first);
  // The token after the type tells whether a name or the one nested item comes.
  const bool item_follows = at_keyword() || (at(TokenKind::identifier) &&
                                             (at(TokenKind::assign, 1) || at(TokenKind::dot, 1)));
  if (at(TokenKind::identifier) && !item_follows) {
    Detail detail;
    if (!parse_name(item, detail)) return false;
    if (item.indexed) detail_of(item) = detail;
  }
  return parse_body(item);
}

bool Parser::parse_name(Item& item, Detail& detail) {
  item.name = span(token());
  ++at_;
  item.indexed = at(TokenKind::open_bracket);
  return !item.indexed || parse_index(detail.index);
}

bool Parser::parse_body(Item& item) {
  if (accept(TokenKind::semicolon)) return true;
  if (at(TokenKind::open_brace)) return parse_block(item);
  if (!at(TokenKind::identifier)) {
    const std::string after =
        " after `" + std::string(file_.source.text, item.place.offset, item.place.length) + "`";
    return fail_here(item.name.length == 0 ? "a name, `{`, `=` or `;`" + after
                                           : "`{`, a field or `;`");
  }
  const Level level(*this);
  if (!level) return false;
  std::vector<Item> items;
  const bool good = parse_item(items);
  item.items = store(items);
  return good;
}

bool Parser::parse_block(Item& item) {
  const Level level(*this);
  if (!level) return false;
  open_braces_.push_back(token());
  ++at_;
  std::vector<Item> items;
  parse_items(items);
  item.items = store(items);
  if (stopped_) return false;
  if (!at(TokenKind::close_brace)) {
    if (!open_braces_.empty()) fail_here("`}`");
    return true;
  }
  ++at_;
  if (!open_braces_.empty()) open_braces_.pop_back();
  return true;
}

bool Parser::parse_wire(Item& item) {
  item.kind = ItemKind::wire;
  item.place = span(token());
  ++at_;
  Detail detail;
  if (!at_word("FROM") && !at_word("TO")) return fail_here("FROM or TO and a port");
  while (at_word("FROM") || at_word("TO")) {
    if (!parse_end(detail)) return false;
  }
  detail_of(item) = detail;
  if (at(TokenKind::open_brace)) return parse_block(item);
  return expect_semicolon("the wire");
}

bool Parser::parse_end(Detail& detail) {
  const bool from = at_word("FROM");
  bool& given = from ? detail.has_from : detail.has_to;
  if (given) return fail(token(), "the wire has two " + std::string(text(token())) + " ends");
  given = true;
  ++at_;
  return parse_trail(from ? detail.from : detail.to);
}

bool Parser::parse_param(Item& item) {
  item.kind = ItemKind::param;
  ++at_;
  if (!at(TokenKind::identifier)) return fail_here("the name of the Param");
  item.place = item.name = span(token());
  ++at_;
  if (accept(TokenKind::assign) && !parse_value(item.value)) return false;
  return expect_semicolon("the Param");
}

bool Parser::parse_let(Item& item) {
  item.kind = ItemKind::let;
  ++at_;
  if (!at(TokenKind::identifier)) return fail_here("the name of the variable");
  item.place = item.name = span(token());
  ++at_;
  return expect(TokenKind::assign, "`=` and the variable's value") && parse_value(item.value) &&
         expect_semicolon("the value");
}

bool Parser::parse_include(Item& item) {
  item.kind = ItemKind::include;
  item.place = span(token());
  ++at_;
  Detail detail;
  if (!parse_path(item, detail)) return false;
  if (at(TokenKind::open_parenthesis) && !parse_arguments(detail)) return false;
  if (at(TokenKind::identifier) && !at_keyword() && !parse_name(item, detail)) return false;
  detail_of(item) = detail;
  return expect_semicolon("the Include");
}

bool Parser::parse_path(Item& item, Detail& detail) {
  const Token first = token();
  if (accept(TokenKind::text)) {
    detail.path = span(first);
    return true;
  }
  const bool name = at(TokenKind::identifier) && !at_keyword();
  if (!name && !at(TokenKind::open_parenthesis)) return fail_here("the path of a file in quotes");
  Expression expression;
  expression.code.begin = static_cast<std::uint32_t>(syntax_.code.size());
  // Arguments may follow a name: it is no function.
  if (name ? !parse_trail_value() : !parse_primary()) return false;
  expression.code.end = static_cast<std::uint32_t>(syntax_.code.size());
  detail.path = expression.span = span_from(first);
  item.value.begin = static_cast<std::uint32_t>(syntax_.expressions.size());
  syntax_.expressions.push_back(expression);
  item.value.end = static_cast<std::uint32_t>(syntax_.expressions.size());
  return true;
}

bool Parser::parse_plugin(Item& item) {
  item.kind = ItemKind::plugin;
  item.place = span(token());
  ++at_;
  if (!at(TokenKind::text)) return fail_here("the path of a shared library in quotes");
  Detail detail;
  detail.path = span(token());
  ++at_;
  detail_of(item) = detail;
  return expect_semicolon("the Plugin");
}

bool Parser::parse_arguments(Detail& detail) {
  std::vector<Argument> arguments;
  ++at_;
  while (!at(TokenKind::close_parenthesis)) {
    if (!at(TokenKind::identifier) || !at(TokenKind::assign, 1))
      return fail_here("an argument, NAME = VALUE");
    Argument argument;
    argument.name = span(token());
    at_ += 2;
    if (!parse_value(argument.value)) return false;
    arguments.push_back(argument);
    if (!accept(TokenKind::comma) && !at(TokenKind::close_parenthesis))
      return fail_here("`,` or `)`");
  }
  ++at_;
  detail.arguments.begin = static_cast<std::uint32_t>(syntax_.arguments.size());
  syntax_.arguments.insert(syntax_.arguments.end(), arguments.begin(), arguments.end());
  detail.arguments.end = static_cast<std::uint32_t>(syntax_.arguments.size());
  return true;
}

bool Parser::parse_loop(Item& item) {
  item.kind = ItemKind::for_loop;
  item.place = span(token());
  ++at_;
  if (!at(TokenKind::identifier)) return fail_here("the name of the loop's variable");
  item.name = span(token());
  ++at_;
  if (!at_word("in")) return fail_here("`in` and a range or a list");
  ++at_;
  if (!parse_loop_values(item)) return false;
  if (!at(TokenKind::open_brace)) return fail_here("`{`");
  return parse_block(item);
}

/// `first .. last`, or a list.
bool Parser::parse_loop_values(Item& item) {
  std::size_t ahead = 0;
  while (!at(TokenKind::range, ahead) && !at(TokenKind::open_brace, ahead) &&
         !at(TokenKind::semicolon, ahead) && !at(TokenKind::end, ahead))
    ++ahead;
  if (!at(TokenKind::range, ahead)) return parse_value(item.value);
  Detail detail;
  if (!parse_expression(detail.first) || !expect(TokenKind::range, "`..`") ||
      !parse_expression(detail.last))
    return false;
  detail_of(item) = detail;
  return true;
}

Range Parser::store(std::vector<Item>& items) {
  Range range;
  range.begin = static_cast<std::uint32_t>(syntax_.items.size());
  syntax_.items.insert(syntax_.items.end(), items.begin(), items.end());
  range.end = static_cast<std::uint32_t>(syntax_.items.size());
  return range;
}

void Parser::recover() {
  while (!at(TokenKind::end) && !at(TokenKind::close_brace)) {
    if (accept(TokenKind::semicolon)) return;
    if (at(TokenKind::open_brace)) return skip_group();
    ++at_;
  }
}

void Parser::skip_group() {
  std::size_t open = 0;
  for (; !at(TokenKind::end); ++at_) {
    if (at(TokenKind::open_brace)) ++open;
    if (!at(TokenKind::close_brace)) continue;
    if (--open == 0) {
      ++at_;
      return;
    }
  }
}

}  // namespace hookpoint::language
