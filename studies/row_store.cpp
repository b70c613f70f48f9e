#include "studies/row_store.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>
#include <string>

#include "output/file.h"
#include "output/number.h"

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

}  // namespace

RowStore::RowStore(std::filesystem::path folder, std::string hash, bool keep)
    : folder_(std::move(folder)), hash_(std::move(hash)) {
  std::filesystem::create_directories(folder_);
  if (keep) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    if (entry.path().extension() == ".row") std::filesystem::remove(entry.path());
}

std::filesystem::path RowStore::path(std::size_t row) const {
  return folder_ / fmt::format("{:05}.row", row);
}

void RowStore::save(std::size_t row, const RowOutcome& outcome) const {
  std::string text = "plan " + hash_ + "\nstatus " + outcome.status + "\n";
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
  output::write_file(path(row), text + "\nend\n");
}

std::optional<RowOutcome> RowStore::load(std::size_t row, std::size_t metrics,
                                         std::size_t plots) const {
  std::ifstream in(path(row));
  std::string word, hash;
  RowOutcome outcome;
  if (!(in >> word >> hash) || word != "plan" || hash != hash_) return std::nullopt;
  if (!(in >> word) || word != "status" || in.get() != ' ' || !std::getline(in, outcome.status))
    return std::nullopt;
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
  if (!(in >> word) || word != "end") return std::nullopt;
  return outcome;
}

}  // namespace hookpoint::studies
