#include "simulation/run/changes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>

#include "output/files/csv.h"
#include "output/files/file.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

const std::vector<std::string> columns{"step", "time [s]", "trail", "value"};

std::string line_of(const Change& change) {
  return fmt::format("{},{},{},{}\n", change.step, text::shortest(change.time),
                     output::csv_field(change.trail), output::csv_field(change.value));
}

std::string header() { return fmt::format("{}\n", fmt::join(columns, ",")); }

/// The whole of `text` as a number.
template <class Number>
bool parse(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stopped == end;
}

/// What is wrong with a row, "" if nothing is.
std::string read_row(const std::vector<std::string>& fields, std::int64_t least, Change& change) {
  if (fields.size() != columns.size())
    return fmt::format("has {} fields instead of {}", fields.size(), columns.size());
  if (!parse(fields[0], change.step) || change.step < 0)
    return fmt::format("`{}` is no step: a whole number from 0 on", fields[0]);
  if (change.step < least)
    return fmt::format("step {} stands after step {}: steps stand in order", change.step, least);
  if (!parse(fields[1], change.time) || !std::isfinite(change.time))
    return fmt::format("`{}` is no time [s]", fields[1]);
  if (fields[2].empty()) return "the trail is missing";
  if (fields[3].empty()) return "the value is missing";
  change.trail = fields[2];
  change.value = fields[3];
  return "";
}

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t line,
                       const std::string& problem) {
  throw ChangesError(fmt::format("{}, line {}: {}", path.string(), line, problem));
}

}  // namespace

std::optional<double> plain_number(const std::string& text) {
  double number = 0.;
  if (parse(text, number) && std::isfinite(number)) return number;
  return std::nullopt;
}

std::vector<Change> read_changes(const std::filesystem::path& path) {
  const std::optional<std::string> text = output::read_file(path);
  if (!text) throw ChangesError(fmt::format("cannot read the changes in {}", path.string()));
  std::vector<Change> changes;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text->size(); ++line) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    // A line of its own is a table of its own: what is wrong is then known by its line.
    const auto table = output::parse_csv(text->substr(begin, end - begin) + '\n');
    begin = end + 1;
    if (!table) fail(path, line + 1, "a quote is left open");
    if (line == 0) {
      if (table->header != columns)
        fail(path, 1, fmt::format("the header is not `{}`", fmt::join(columns, ",")));
      continue;
    }
    Change change;
    const std::int64_t least = changes.empty() ? 0 : changes.back().step;
    if (const std::string problem = read_row(table->header, least, change); !problem.empty())
      fail(path, line + 1, problem);
    changes.push_back(std::move(change));
  }
  if (line == 0) fail(path, 1, fmt::format("the header `{}` is missing", fmt::join(columns, ",")));
  return changes;
}

std::size_t line_of_change(std::size_t index) { return index + 2; }

void ChangeLog::add(std::span<const Change> changes) {
  if (changes.empty()) return;
  std::string text = written_ ? "" : header();
  for (const Change& change : changes) text += line_of(change);
  changes_.insert(changes_.end(), changes.begin(), changes.end());
  if (file_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | (written_ ? O_APPEND : O_TRUNC);
  const int descriptor = ::open(file_.c_str(), flags, 0666);
  if (descriptor < 0) output::fail_file("write", file_);
  written_ = true;
  const auto size = static_cast<ssize_t>(text.size());
  const bool whole = ::write(descriptor, text.data(), text.size()) == size;
  const int reason = errno;
  if (::close(descriptor) == 0 && whole) return;
  errno = whole ? errno : reason;
  output::fail_file("write", file_);
}

void ChangeLog::truncate(std::size_t count) {
  changes_.resize(std::min(count, changes_.size()));
  rewrite();
}

void ChangeLog::rewrite() {
  if (file_.empty()) return;
  written_ = !changes_.empty();
  if (!written_) {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    return;
  }
  std::string text = header();
  for (const Change& change : changes_) text += line_of(change);
  output::write_file(file_, text);
}

}  // namespace hookpoint::simulation
