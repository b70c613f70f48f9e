#include "output/json_reader.h"

#include <charconv>

namespace hookpoint::output {
namespace {

constexpr int deepest = 64;  // no stack of ours overflows on a document made to do so

class JsonReader {
 public:
  explicit JsonReader(std::string_view text) : rest_(text) {}

  bool read() {
    if (!value("", 0)) return false;
    skip_blanks();
    return rest_.empty();
  }
  std::vector<std::pair<std::string, std::string>> leaves;

 private:
  void skip_blanks() {
    const auto start = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(start == std::string_view::npos ? rest_.size() : start);
  }
  bool take(char wanted) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool value(const std::string& path, int depth) {
    skip_blanks();
    if (rest_.empty() || depth > deepest) return false;
    if (rest_.front() == '{') return object(path, depth);
    if (rest_.front() == '[') return list(path, depth);
    std::string text;
    const bool good = rest_.front() == '"' ? quoted(text) : bare(text);
    leaves.emplace_back(path, std::move(text));
    return good;
  }

  bool object(const std::string& path, int depth) {
    take('{');
    if (take('}')) return true;
    do {
      std::string name;
      skip_blanks();
      if (!quoted(name) || !take(':')) return false;
      if (!value(path.empty() ? name : path + "." + name, depth + 1)) return false;
    } while (take(','));
    return take('}');
  }

  bool list(const std::string& path, int depth) {
    take('[');
    if (take(']')) return true;
    int index = 0;
    do {
      if (!value(path + "[" + std::to_string(index++) + "]", depth + 1)) return false;
    } while (take(','));
    return take(']');
  }

  bool bare(std::string& text) {
    const auto end = rest_.find_first_of(",]} \t\r\n");
    text = rest_.substr(0, end);
    rest_.remove_prefix(text.size());
    if (text == "true" || text == "false" || text == "null") return true;
    const bool begins = !text.empty() && (text[0] == '-' || (text[0] >= '0' && text[0] <= '9'));
    if (!begins) return false;  // from_chars would take "inf" too
    double number = 0.;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && stop == text.data() + text.size();
  }

  bool quoted(std::string& text) {
    if (rest_.empty() || rest_.front() != '"') return false;
    for (rest_.remove_prefix(1); !rest_.empty(); rest_.remove_prefix(1)) {
      const char c = rest_.front();
      if (c == '"') {
        rest_.remove_prefix(1);
        return true;
      }
      if (c != '\\')
        text += c;
      else if (!escape(text))
        return false;
    }
    return false;
  }

  /// At a backslash; leaves the last character of the escape in front.
  bool escape(std::string& text) {
    constexpr std::string_view letters = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
    rest_.remove_prefix(1);
    if (rest_.empty()) return false;
    const auto plain = letters.find(rest_.front());
    if (plain != std::string_view::npos) {
      text += meanings[plain];
      return true;
    }
    if (rest_.front() != 'u' || rest_.size() < 5) return false;
    unsigned code = 0;
    const auto [stop, error] = std::from_chars(rest_.data() + 1, rest_.data() + 5, code, 16);
    if (error != std::errc{} || stop != rest_.data() + 5 || code > 0x7f) return false;
    text += static_cast<char>(code);  // JsonWriter escapes control characters only
    rest_.remove_prefix(4);
    return true;
  }

  std::string_view rest_;
};

}  // namespace

std::optional<std::vector<std::pair<std::string, std::string>>> json_leaves(std::string_view text) {
  JsonReader reader(text);
  if (!reader.read()) return std::nullopt;
  return std::move(reader.leaves);
}

}  // namespace hookpoint::output
