// CSV: the trace itself, `<stem>.channels.csv` (a line a column) and `<stem>.record.csv` (what
// belongs to the whole record), so that the trace stays a plain table.
#include "output/files/csv.h"

#include "output/records/files.h"
#include "output/records/formats.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

void write_channels(const std::filesystem::path& path, const RecordHeader& header) {
  CsvTable table{{"path", "unit", "type", "minimum", "maximum", "doc"}, {}};
  table.rows.push_back({"time", "s", "double", "0", "inf", "simulated time"});
  for (const Channel& channel : header.channels)
    table.rows.push_back({channel.path, channel.unit, channel.type, text::shortest(channel.minimum),
                          text::shortest(channel.maximum), channel.doc});
  write_csv(csv_channels_file(path), table);
}

void write_about(const std::filesystem::path& path, const RecordHeader& header) {
  CsvTable table{{"key", "value"},
                 {{"name", header.name}, {"period", text::shortest(header.period)}}};
  for (const auto& [key, value] : header.annotations) table.rows.push_back({key, value});
  table.rows.push_back({"experiment", header.experiment});
  write_csv(csv_about_file(path), table);
}

std::vector<TraceColumn> columns(const RecordHeader& header) {
  std::vector<TraceColumn> result;
  for (const Channel& channel : header.channels) result.push_back({channel.path, channel.unit});
  return result;
}

class CsvRecord final : public RecordWriter {
 public:
  CsvRecord(const std::filesystem::path& path, const RecordHeader& header)
      : RecordWriter(header.channels.size()), trace_(path, columns(header)) {
    write_channels(path, header);
    write_about(path, header);
  }

 private:
  void append(double time, std::span<const double> values) override { trace_.row(time, values); }
  void finish() override { trace_.close(); }
  Kept keep() override { return {trace_.partial(), trace_.written()}; }

  TraceWriter trace_;
};

}  // namespace

std::vector<std::string> record_files(std::string_view format, const std::string& file) {
  if (format != "csv") return {file};
  return {file, csv_channels_file(file), csv_about_file(file)};
}

std::filesystem::path csv_channels_file(std::filesystem::path record) {
  return record.replace_extension(".channels.csv");
}

std::filesystem::path csv_about_file(std::filesystem::path record) {
  return record.replace_extension(".record.csv");
}

std::unique_ptr<RecordWriter> make_csv_record(const std::filesystem::path& path,
                                              const RecordHeader& header) {
  return std::make_unique<CsvRecord>(path, header);
}

}  // namespace hookpoint::output
