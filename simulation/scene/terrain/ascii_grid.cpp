#include "simulation/scene/terrain/ascii_grid.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <string_view>

namespace hookpoint::simulation {
namespace {

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\v\f";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

std::string lower_case(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// A word of the file as it may be shown: short and printable.
std::string quoted(std::string_view word) {
  std::string result = "'";
  for (const char c : word.substr(0, 20)) {
    result += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  }
  return result + (word.size() > 20 ? "...'" : "'");
}

class Reader {
 public:
  AsciiGridResult read(std::istream& stream) {
    std::string line;
    while (message_.empty() && std::getline(stream, line)) {
      ++line_;
      const std::vector<std::string_view> words = split(line);
      if (words.empty()) continue;
      const bool keyword = std::isalpha(static_cast<unsigned char>(words[0][0])) != 0 &&
                           rows_.empty() && !parse_number(words[0]);
      keyword ? read_header(words) : read_row(words);
    }
    if (message_.empty()) finish();
    if (!message_.empty()) return {std::nullopt, message_, message_line_};
    return {std::move(grid_), "", 0};
  }

 private:
  void fail(int line, std::string message) {
    message_line_ = line;
    message_ = (line > 0 ? "line " + std::to_string(line) + ": " : "") + std::move(message);
  }

  void read_header(const std::vector<std::string_view>& words) {
    std::string key = lower_case(words[0]);
    if (key == "xllcenter") key = "xllcorner";
    if (key == "yllcenter") key = "yllcorner";
    const bool known = key == "ncols" || key == "nrows" || key == "xllcorner" ||
                       key == "yllcorner" || key == "cellsize" || key == "nodata_value";
    if (!known) {
      return fail(line_,
                  "expected a height or one of ncols, nrows, xllcorner, yllcorner, cellsize, "
                  "NODATA_value, got " +
                      quoted(words[0]));
    }
    const std::optional<double> value = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
    if (!value) return fail(line_, "expected one number after " + quoted(words[0]));
    if (!header_.emplace(key, *value).second)
      return fail(line_, quoted(words[0]) + " a second time");
    const bool count = key == "ncols" || key == "nrows";
    if (count && !(*value >= 2. && *value <= 1e6 && std::floor(*value) == *value)) {
      return fail(line_, quoted(words[0]) + " must be a whole number of at least 2");
    }
    if (key == "cellsize" && !(*value > 0.)) return fail(line_, "cellsize must be positive");
  }

  void read_row(const std::vector<std::string_view>& words) {
    for (const std::string_view word : words) {
      const std::optional<double> height = parse_number(word);
      if (!height || !std::isfinite(*height)) {
        return fail(line_, "expected a height, got " + quoted(word));
      }
      const auto missing = header_.find("nodata_value");
      if (missing != header_.end() && *height == missing->second) {
        return fail(line_, "NODATA height: the ground must not have holes");
      }
      grid_.heights.push_back(*height);
    }
    const int width = header_.contains("ncols") ? static_cast<int>(header_["ncols"])
                      : rows_.empty()           ? static_cast<int>(words.size())
                                                : rows_.front();
    if (static_cast<int>(words.size()) != width) {
      return fail(line_, "expected " + std::to_string(width) + " heights, got " +
                             std::to_string(words.size()));
    }
    rows_.push_back(width);
  }

  void finish() {
    grid_.rows = static_cast<int>(rows_.size());
    if (!header_.empty() && !(header_.contains("ncols") && header_.contains("nrows"))) {
      return fail(0, "a header needs both ncols and nrows");
    }
    if (rows_.empty()) return fail(0, "no heights");
    grid_.columns = rows_.front();
    if (header_.contains("nrows") && header_["nrows"] != grid_.rows) {
      return fail(line_, "expected " + std::to_string(static_cast<int>(header_["nrows"])) +
                             " rows, got " + std::to_string(grid_.rows));
    }
    if (grid_.rows < 2 || grid_.columns < 2)
      return fail(line_, "a grid needs at least 2 x 2 heights");
    if (header_.empty()) return;
    if (header_.contains("cellsize")) grid_.spacing = header_["cellsize"];
    if (header_.contains("xllcorner")) grid_.origin_x = header_["xllcorner"];
    if (header_.contains("yllcorner")) grid_.origin_y = header_["yllcorner"];
    for (int row = 0; row < grid_.rows / 2; ++row) {  // northernmost first -> least y first
      const std::ptrdiff_t columns = grid_.columns;
      const auto southern = grid_.heights.begin() + row * columns;
      const auto northern = grid_.heights.begin() + (grid_.rows - 1 - row) * columns;
      std::swap_ranges(southern, southern + grid_.columns, northern);
    }
  }

  AsciiGrid grid_;
  std::map<std::string, double> header_;
  std::vector<int> rows_;  // length of each row so far
  int line_ = 0;
  std::string message_;
  int message_line_ = 0;
};

}  // namespace

AsciiGridResult read_ascii_grid(std::istream& stream) { return Reader{}.read(stream); }

AsciiGridResult read_ascii_grid(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path)) {
    return {std::nullopt, "cannot open " + path.string(), 0};
  }
  return read_ascii_grid(stream);
}

}  // namespace hookpoint::simulation
