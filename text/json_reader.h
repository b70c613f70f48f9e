// A JSON document as a tree of values, read within bounds: hostile text costs no more than its
// size.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hookpoint::text {

/// A value of a JSON document: a leaf, an object's members or a list's items, in the document's
/// order.
class JsonValue {
 public:
  using Member = std::pair<std::string, JsonValue>;

  bool is_leaf() const { return kind_ == Kind::leaf; }
  bool is_object() const { return kind_ == Kind::object; }
  bool is_list() const { return kind_ == Kind::list; }

  /// Text of a leaf without its quotes and escapes; numbers, true, false and null as written. ""
  /// of an object or a list.
  const std::string& text() const { return text_; }
  /// The number that the whole text is; nothing if it is none, or not finite.
  std::optional<double> number() const;
  /// Items of a list; none of anything else.
  std::span<const JsonValue> items() const;
  /// Members of an object; none of anything else.
  std::span<const Member> members() const;
  /// First member of that name; null where there is none.
  const JsonValue* member(std::string_view name) const;

 private:
  friend class JsonTreeBuilder;
  enum class Kind { leaf, list, object };

  Kind kind_ = Kind::leaf;
  std::string text_;
  std::vector<JsonValue> items_;
  std::vector<Member> members_;
};

/// Nothing when `text` is not JSON, or has objects and lists more than 64 within one another or
/// with a path of more than 512 bytes.
std::optional<JsonValue> read_json(std::string_view text);

/// Every leaf with its path, in the document's order: {"engines.ode.version", "0.16.2"},
/// {"seeds[0]", "1"}. An empty object or list has no leaf. Nothing where read_json gives nothing.
std::optional<std::vector<std::pair<std::string, std::string>>> json_leaves(std::string_view text);

}  // namespace hookpoint::text
