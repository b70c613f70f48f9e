// A small writer of JSON: two-space indentation, lists of numbers on one line, 17 significant
// digits.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::text {

/// Calls follow the nesting of the document: `begin_object().key("time").value(0.).end_object()`.
/// Misuse (a value in an object without a key, an end that does not match) is an assertion.
class JsonWriter {
 public:
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);

  /// 17 significant digits; what is not finite is null, since JSON has no word for it.
  JsonWriter& value(double number);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(std::same_as<bool> auto flag) { return raw(flag ? "true" : "false"); }
  JsonWriter& value(std::integral auto number) requires(!std::same_as<decltype(number), bool>) {
    return raw(std::to_string(number));
  }
  JsonWriter& null() { return raw("null"); }

  /// [x, y, z] on one line.
  JsonWriter& numbers(std::span<const double> values);
  JsonWriter& numbers(std::initializer_list<double> values) {
    return numbers(std::span<const double>(values.begin(), values.size()));
  }

  template <class Value>
  JsonWriter& member(std::string_view name, const Value& content) {
    return key(name).value(content);
  }

  /// The document so far, with a line end once every object and array is closed.
  std::string text() const;

 private:
  struct Level {
    bool object = false;
    bool empty = true;
  };
  JsonWriter& raw(std::string_view token);
  JsonWriter& open(char bracket, bool object);
  JsonWriter& close(char bracket, bool object);
  void start_item();
  void new_line();

  std::string text_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

/// `text` in quotes, with the escapes that JSON requires. Bytes that are no UTF-8 become U+FFFD:
/// there is no JSON with them.
std::string json_string(std::string_view text);

}  // namespace hookpoint::text
