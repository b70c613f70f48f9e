// The one file that sees nlohmann's JSON.
#include "text/json_reader.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace hookpoint::text {

/// Builds a tree from a document's events.
class JsonTreeBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonValue root;

  bool null() override { return leaf("null"); }
  bool boolean(bool truth) override { return leaf(truth ? "true" : "false"); }
  bool number_integer(number_integer_t number) override { return leaf(std::to_string(number)); }
  bool number_unsigned(number_unsigned_t number) override { return leaf(std::to_string(number)); }
  bool number_float(number_float_t, const string_t& written) override { return leaf(written); }
  bool string(string_t& text) override { return leaf(std::move(text)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonValue::Kind::object); }
  bool key(string_t& name) override {
    key_ = std::move(name);
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::list); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  /// Each leaf has the path of what it lies in before its own name: a document made to be deep, or
  /// of long names within one another, would fill the memory.
  static constexpr std::size_t deepest = 64, longest_path = 512;
  /// An object or list that is open. Its address stays: what it lies in grows only after it closes.
  struct Level {
    JsonValue* value = nullptr;
    std::size_t path_length = 0;
  };

  /// Adds an empty value to the innermost level; `path` becomes the length of its path.
  JsonValue& add(std::size_t& path) {
    path = 0;
    if (levels_.empty()) return root;
    const Level& level = levels_.back();
    if (level.value->is_list()) {
      path = level.path_length + std::to_string(level.value->items_.size()).size() + 2;
      return level.value->items_.emplace_back();
    }
    path = level.path_length + (level.path_length > 0 ? 1 : 0) + key_.size();
    return level.value->members_.emplace_back(std::move(key_), JsonValue()).second;
  }
  bool leaf(std::string text) {
    std::size_t path = 0;
    add(path).text_ = std::move(text);
    return true;
  }
  bool open(JsonValue::Kind kind) {
    std::size_t path = 0;
    JsonValue& value = add(path);
    value.kind_ = kind;
    levels_.push_back({&value, path});
    return levels_.size() <= deepest && path <= longest_path;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string key_;
  std::vector<Level> levels_;
};

namespace {

using Leaves = std::vector<std::pair<std::string, std::string>>;

void add_leaves(const JsonValue& value, const std::string& path, Leaves& leaves) {
  if (value.is_leaf()) leaves.emplace_back(path, value.text());
  std::size_t index = 0;
  for (const JsonValue& item : value.items())
    add_leaves(item, path + "[" + std::to_string(index++) + "]", leaves);
  for (const auto& [name, member] : value.members())
    add_leaves(member, path.empty() ? name : path + "." + name, leaves);
}

}  // namespace

std::optional<double> JsonValue::number() const {
  double value = 0.;
  const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
  if (error != std::errc{} || end != text_.data() + text_.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::span<const JsonValue> JsonValue::items() const { return items_; }

std::span<const JsonValue::Member> JsonValue::members() const { return members_; }

const JsonValue* JsonValue::member(std::string_view name) const {
  for (const Member& member : members_)
    if (member.first == name) return &member.second;
  return nullptr;
}

std::optional<JsonValue> read_json(std::string_view text) {
  JsonTreeBuilder builder;
  if (!nlohmann::json::sax_parse(text, &builder)) return std::nullopt;
  return std::move(builder.root);
}

std::optional<Leaves> json_leaves(std::string_view text) {
  const auto root = read_json(text);
  if (!root) return std::nullopt;
  Leaves leaves;
  add_leaves(*root, "", leaves);
  return leaves;
}

}  // namespace hookpoint::text
