#include "language/document/textmate.h"

#include <algorithm>
#include <set>

#include "language/syntax/token.h"
#include "language/units.h"
#include "language/values/expression.h"

namespace hookpoint::language {
namespace {

/// A text as JSON.
std::string json(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// "a|b|c", longer words first, so that none hides one that begins with it; dots taken literally.
std::string alternatives(std::vector<std::string> words) {
  std::ranges::sort(words, [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  });
  std::string text;
  for (const std::string& word : words) {
    text += text.empty() ? "" : "|";
    for (const char c : word) text += c == '.' ? std::string("\\.") : std::string(1, c);
  }
  return text;
}

std::string match(std::string_view scope, const std::string& expression) {
  return "{ \"name\": " + json(std::string(scope) + ".hook") + ", \"match\": " + json(expression) +
         " }";
}

/// Number, then its unit on the same line, as the lexer joins them.
std::string number_rule() {
  const std::string number = R"((?:(?<![\w])\d+(?:\.(?!\.)\d*)?|(?<!\.)\.\d+)(?:[eE][+-]?\d+)?)";
  const std::string factor = "(?:%|(?:" + alternatives([] {
                               std::vector<std::string> names;
                               for (const std::string& name : unit_names())
                                 if (name != "%") names.push_back(name);
                               return names;
                             }()) +
                             R"()(?!\w)))" + R"((?:[ \t]*\^[ \t]*-?\d(?![\w.]))?)";
  const std::string unit = factor + R"((?:[ \t]*[./][ \t]*)" + factor + ")*";
  return R"({ "match": )" + json("(" + number + R"()(?:[ \t]*()" + unit + "))?") + ",\n" +
         R"(      "captures": { "1": { "name": "constant.numeric.hook" }, "2": { "name": "keyword.other.unit.hook" } } })";
}

/// A class, and the name that it may give to its object.
std::string object_rule(const Schema& schema) {
  const std::vector<std::string> reserved(std::begin(reserved_words), std::end(reserved_words));
  // Two classes may have one name, in different places.
  std::set<std::string> names;
  for (const auto& [key, entry] : schema.classes()) names.insert(entry.name);
  for (const std::string& word : reserved) names.erase(word);
  const std::vector<std::string> classes(names.begin(), names.end());
  const std::string type = R"((?<![\w.])()" + alternatives(classes) + R"()(?![\w.]|\s*=[^=]))";
  const std::string name =
      R"((?:\s+(?!(?:)" + alternatives(reserved) + R"()\b)([A-Za-z_]\w*)(?![\w.]|\s*=[^=]))?)";
  return R"({ "match": )" + json(type + name) + ",\n" +
         R"(      "captures": { "1": { "name": "entity.name.type.hook" }, "2": { "name": "entity.name.tag.hook" } } })";
}

std::string word_rule(std::string_view scope, std::vector<std::string> words,
                      std::string_view after = R"((?![\w]))") {
  return match(scope,
               R"((?<![\w.])(?:)" + alternatives(std::move(words)) + ")" + std::string(after));
}

}  // namespace

std::string describe_textmate(const Schema& schema) {
  std::vector<std::string> reserved(std::begin(reserved_words), std::end(reserved_words));
  const std::vector<std::string> rules{
      match("comment.line.double-slash", "//.*$"),
      R"({ "name": "comment.block.hook", "begin": "/\\*", "end": "\\*/" })",
      R"({ "name": "string.quoted.double.hook", "begin": "\"", "end": "\"|$",
      "patterns": [{ "name": "constant.character.escape.hook", "match": "\\\\." }] })",
      number_rule(),
      word_rule("keyword.control", std::move(reserved)),
      word_rule("keyword.control", {"FROM", "TO", "in"}),
      word_rule("constant.language", {"true", "false", "pi"}, R"((?![\w.]|\s*=[^=]))"),
      word_rule("support.function", function_names(), R"((?=\s*\())"),
      object_rule(schema),
      match("variable.other.property", R"((?<![\w.])[A-Za-z_]\w*(?=\s*=(?!=)))"),
      match("variable.other", R"([A-Za-z_]\w*)"),
      match("keyword.operator", R"(\.\.|&&|\|\||[<>=!]=|[-+*/^<>!?:=])"),
  };
  std::string text =
      "{\n  \"name\": \"hookpoint\",\n  \"scopeName\": \"source.hook\",\n"
      "  \"fileTypes\": [\"hook\"],\n  \"patterns\": [\n";
  for (const std::string& rule : rules)
    text += "    " + rule + (&rule == &rules.back() ? "\n" : ",\n");
  return text + "  ]\n}\n";
}

}  // namespace hookpoint::language
