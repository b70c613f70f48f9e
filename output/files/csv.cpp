#include "output/files/csv.h"

#include <utility>

#include "text/csv_reader.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

/// Bytes of a number with its comma: "-1.2345678901234567e-308,".
constexpr std::size_t longest_number = 25;

void append_row(std::string& text, const std::vector<std::string>& fields) {
  bool first = true;
  for (const std::string& field : fields) {
    if (!first) text += ',';
    text += csv_field(field);
    first = false;
  }
  text += '\n';
}

}  // namespace

std::string column_title(std::string_view name, std::string_view unit) {
  std::string title(name);
  if (!unit.empty()) title.append(" [").append(unit).append("]");
  return title;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string CsvTable::text() const {
  std::string result;
  append_row(result, header);
  for (const auto& row : rows) append_row(result, row);
  return result;
}

std::optional<CsvTable> parse_csv(std::string_view text) {
  text::Fault fault;
  auto table = text::read(text, {}, fault);
  if (!table) return std::nullopt;
  return CsvTable{std::move(table->header), std::move(table->rows)};
}

void write_csv(const std::filesystem::path& path, const CsvTable& table) {
  write_file(path, table.text());
}

TraceWriter::TraceWriter(const std::filesystem::path& path, const std::vector<TraceColumn>& columns)
    : file_(path) {
  std::string header = "time [s]";
  for (const TraceColumn& column : columns)
    header.append(",").append(csv_field(column_title(column.trail, column.unit)));
  file_.write(header += '\n');
  block_.reserve(block_bytes + (columns.size() + 1) * longest_number + 1);
}

TraceWriter::~TraceWriter() {
  try {
    write_block();
  } catch (const FileError&) {
    // The rows that fitted are there; nobody is left to be told of the others.
  }
}

void TraceWriter::row(double time, std::span<const double> values) {
  if (waiting_ == 0) block_.clear();
  text::append_shortest(block_, time);
  for (const double value : values) {
    block_ += ',';
    text::append_shortest(block_, value);
  }
  block_ += '\n';
  ++waiting_;
  if (block_.size() < block_bytes && time - last_block_ < block_time) return;
  last_block_ = time;
  write_block();
}

void TraceWriter::write_block() {
  const std::int64_t rows = std::exchange(waiting_, 0);
  if (rows == 0) return;
  try {
    file_.write(block_);
    written_ += rows;
  } catch (const FileError&) {
    write_lines(block_);
  }
}

void TraceWriter::write_lines(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t line = lines.find('\n') + 1;
    file_.write(lines.substr(0, line));
    lines.remove_prefix(line);
    ++written_;
  }
}

void TraceWriter::close() {
  write_block();
  file_.complete();
}

}  // namespace hookpoint::output
