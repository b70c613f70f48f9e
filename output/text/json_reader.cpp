// The one file that sees nlohmann's JSON.
#include "output/text/json_reader.h"

#include <nlohmann/json.hpp>

namespace hookpoint::output {
namespace {

using Json = nlohmann::json;

/// Takes a document's events and keeps its leaves.
class Leaves final : public nlohmann::json_sax<Json> {
 public:
  std::vector<std::pair<std::string, std::string>> leaves;

  bool null() override { return leaf("null"); }
  bool boolean(bool truth) override { return leaf(truth ? "true" : "false"); }
  bool number_integer(number_integer_t number) override { return leaf(std::to_string(number)); }
  bool number_unsigned(number_unsigned_t number) override { return leaf(std::to_string(number)); }
  bool number_float(number_float_t, const string_t& written) override { return leaf(written); }
  bool string(string_t& text) override { return leaf(std::move(text)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(false); }
  bool key(string_t& name) override {
    levels_.back().key = std::move(name);
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

 private:
  /// Each leaf has the path of what it lies in before its own name: a document made to be deep, or
  /// of long names within one another, would fill the memory.
  static constexpr std::size_t deepest = 64, longest_path = 512;
  struct Level {
    std::size_t path_length = 0;  ///< of the object or list itself
    bool list = false;
    std::size_t index = 0;
    std::string key;
  };

  /// `path_` becomes that of the value that comes.
  void begin_value() {
    if (levels_.empty()) return;
    Level& level = levels_.back();
    path_.resize(level.path_length);
    if (level.list)
      path_ += "[" + std::to_string(level.index++) + "]";
    else
      path_ += (path_.empty() ? "" : ".") + level.key;
  }
  bool leaf(std::string text) {
    begin_value();
    leaves.emplace_back(path_, std::move(text));
    return true;
  }
  bool open(bool list) {
    begin_value();
    levels_.push_back({path_.size(), list, 0, {}});
    return levels_.size() <= deepest && path_.size() <= longest_path;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string path_;
  std::vector<Level> levels_;
};

}  // namespace

std::optional<std::vector<std::pair<std::string, std::string>>> json_leaves(std::string_view text) {
  Leaves reader;
  if (!Json::sax_parse(text, &reader)) return std::nullopt;
  return std::move(reader.leaves);
}

}  // namespace hookpoint::output
