#include "text/json.h"

#include <cassert>
#include <cmath>

#include "text/number.h"
#include "text/utf8.h"

namespace hookpoint::text {
namespace {

std::string json_number(double number) {
  return std::isfinite(number) ? seventeen_digits(number) : "null";
}

}  // namespace

std::string json_string(std::string_view text) {
  constexpr std::string_view hex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text::repaired(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted.append(1, '\\').append(1, c);
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\t') {
      quoted += "\\t";
    } else if (code < 0x20) {
      quoted.append("\\u00").append(1, hex[code >> 4]).append(1, hex[code & 15]);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

JsonWriter& JsonWriter::begin_object() { return open('{', true); }
JsonWriter& JsonWriter::end_object() { return close('}', true); }
JsonWriter& JsonWriter::begin_array() { return open('[', false); }
JsonWriter& JsonWriter::end_array() { return close(']', false); }

JsonWriter& JsonWriter::key(std::string_view name) {
  assert(!levels_.empty() && levels_.back().object && !after_key_);
  if (!levels_.back().empty) text_ += ',';
  levels_.back().empty = false;
  new_line();
  text_.append(json_string(name)).append(": ");
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(double number) { return raw(json_number(number)); }
JsonWriter& JsonWriter::value(std::string_view text) { return raw(json_string(text)); }

JsonWriter& JsonWriter::numbers(std::span<const double> values) {
  std::string list = "[";
  for (const double value : values) {
    if (list.size() > 1) list += ", ";
    list += json_number(value);
  }
  return raw(list + "]");
}

std::string JsonWriter::text() const { return levels_.empty() ? text_ + '\n' : text_; }

JsonWriter& JsonWriter::raw(std::string_view token) {
  start_item();
  text_ += token;
  return *this;
}

JsonWriter& JsonWriter::open(char bracket, bool object) {
  start_item();
  text_ += bracket;
  levels_.push_back({.object = object});
  return *this;
}

JsonWriter& JsonWriter::close(char bracket, [[maybe_unused]] bool object) {
  assert(!levels_.empty() && levels_.back().object == object && !after_key_);
  const bool empty = levels_.back().empty;
  levels_.pop_back();
  if (!empty) new_line();
  text_ += bracket;
  return *this;
}

/// A value stands after its key, or as the next item of an array, or is the document.
void JsonWriter::start_item() {
  if (levels_.empty() || after_key_) {
    assert(after_key_ || text_.empty());
    after_key_ = false;
    return;
  }
  assert(!levels_.back().object);
  if (!levels_.back().empty) text_ += ',';
  levels_.back().empty = false;
  new_line();
}

void JsonWriter::new_line() { text_.append(1, '\n').append(2 * levels_.size(), ' '); }

}  // namespace hookpoint::text
