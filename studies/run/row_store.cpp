#include "studies/run/row_store.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <string>
#include <string_view>

#include "output/file.h"
#include "output/text/hash.h"
#include "output/text/number.h"

namespace hookpoint::studies {
namespace {

std::optional<double> read_number(std::istream& in) {
  std::string word;
  double value = 0.;
  if (!(in >> word)) return std::nullopt;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

void append_list(std::string& text, const std::vector<double>& values) {
  for (const double value : values) {
    text += ' ';
    output::append_shortest(text, value);
  }
}

bool read_list(std::istream& in, std::size_t count, std::vector<double>& values) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = read_number(in);
    if (!value) return false;
    values.push_back(*value);
  }
  return true;
}

/// A row's file, complete or not.
bool is_row(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (name.extension() == ".partial") name = name.stem();
  const std::string number = name.stem();
  return name.extension() == ".row" && !number.empty() &&
         number.find_first_not_of("0123456789") == std::string::npos;
}

constexpr std::string_view end_mark = "\nend ";

/// The text before the end mark; nothing unless the hash behind it is that text's.
std::optional<std::string> whole_text(const std::filesystem::path& path) {
  std::string text = output::read_file(path).value_or("");
  const std::size_t end = text.rfind(end_mark);
  if (end == std::string::npos) return std::nullopt;
  const std::string hash = text.substr(end + end_mark.size());
  text.resize(end);
  if (hash != output::Hash().add(text).text() + "\n") return std::nullopt;
  return text;
}

}  // namespace

RowStore::RowStore(std::filesystem::path folder, bool keep) : folder_(std::move(folder)) {
  std::error_code error, ignored;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_, ignored))
    throw output::FileError("cannot make the folder " + folder_.string() + ": " + error.message());
  if (keep) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    if (is_row(entry.path())) std::filesystem::remove(entry.path(), error);
}

std::filesystem::path RowStore::path(std::size_t row) const {
  return folder_ / fmt::format("{:05}.row", row);
}

bool RowStore::has(std::size_t row) const {
  std::error_code ignored;
  return std::filesystem::exists(path(row), ignored);
}

void RowStore::save(std::size_t row, const std::string& identity, const RowOutcome& outcome) const {
  std::string text = "run " + identity + "\nstatus " + outcome.status + "\n";
  for (const std::string& notice : outcome.notices) text += "notice " + notice + "\n";
  text += "values\n";
  for (const auto& value : outcome.measured)
    text += value ? "value " + output::shortest(*value) + "\n" : "none\n";
  for (const Trace& trace : outcome.traces) {
    text += fmt::format("trace {}", trace.time.size());
    append_list(text, trace.time);
    append_list(text, trace.value);
    text += '\n';
  }
  text += fmt::format("path {}", outcome.path.size());
  for (const Vector3d& p : outcome.path) append_list(text, {p.x, p.y, p.z});
  const std::string hash = output::Hash().add(text).text();
  output::write_file(path(row), text.append(end_mark).append(hash) + "\n");
}

std::optional<RowOutcome> RowStore::load(std::size_t row, const std::string& identity,
                                         std::size_t metrics, std::size_t plots) const {
  const auto text = whole_text(path(row));
  if (!text) return std::nullopt;
  std::istringstream in(*text);
  std::string word, run;
  RowOutcome outcome;
  if (!(in >> word >> run) || word != "run" || run != identity) return std::nullopt;
  if (!(in >> word) || word != "status" || in.get() != ' ' || !std::getline(in, outcome.status))
    return std::nullopt;
  while (in >> word && word == "notice")
    if (in.get() != ' ' || !std::getline(in, outcome.notices.emplace_back())) return std::nullopt;
  if (word != "values") return std::nullopt;
  for (std::size_t i = 0; i < metrics; ++i) {
    if (!(in >> word) || (word != "value" && word != "none")) return std::nullopt;
    outcome.measured.emplace_back();
    if (word == "none") continue;
    outcome.measured.back() = read_number(in);
    if (!outcome.measured.back()) return std::nullopt;
  }
  for (std::size_t i = 0; i < plots; ++i) {
    std::size_t count = 0;
    Trace trace;
    if (!(in >> word >> count) || word != "trace" || count > trace_samples + 1 ||
        !read_list(in, count, trace.time) || !read_list(in, count, trace.value))
      return std::nullopt;
    outcome.traces.push_back(std::move(trace));
  }
  std::size_t points = 0;
  std::vector<double> path;
  if (!(in >> word >> points) || word != "path" || points > path_samples + 1 ||
      !read_list(in, 3 * points, path))
    return std::nullopt;
  for (std::size_t i = 0; i < points; ++i)
    outcome.path.push_back({path[3 * i], path[3 * i + 1], path[3 * i + 2]});
  return outcome;
}

}  // namespace hookpoint::studies
