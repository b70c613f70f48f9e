#include "output/records/spool.h"

#include "output/files/bytes.h"

namespace hookpoint::output {
namespace {

constexpr std::string_view magic = "hookpoint spool 1\n";

std::string encode(std::string_view format, const RecordHeader& header) {
  std::string bytes;
  append_string(bytes, format);
  append_string(bytes, header.name);
  append_double(bytes, header.period);
  append_string(bytes, header.experiment);
  append_integer(bytes, static_cast<std::uint32_t>(header.annotations.size()));
  for (const auto& [key, value] : header.annotations) {
    append_string(bytes, key);
    append_string(bytes, value);
  }
  append_integer(bytes, static_cast<std::uint32_t>(header.channels.size()));
  for (const Channel& channel : header.channels) {
    append_string(bytes, channel.path);
    append_string(bytes, channel.unit);
    append_string(bytes, channel.type);
    append_double(bytes, channel.minimum);
    append_double(bytes, channel.maximum);
    append_string(bytes, channel.doc);
  }
  return bytes;
}

RecordHeader decode(ByteReader& bytes) {
  RecordHeader header;
  header.name = bytes.string();
  header.period = bytes.real();
  header.experiment = bytes.string();
  for (auto left = bytes.integer<std::uint32_t>(); left > 0 && bytes.good(); --left) {
    std::string key(bytes.string());
    header.annotations.emplace_back(std::move(key), bytes.string());
  }
  for (auto left = bytes.integer<std::uint32_t>(); left > 0 && bytes.good(); --left) {
    Channel& channel = header.channels.emplace_back();
    channel.path = bytes.string();
    channel.unit = bytes.string();
    channel.type = bytes.string();
    channel.minimum = bytes.real();
    channel.maximum = bytes.real();
    channel.doc = bytes.string();
  }
  return header;
}

}  // namespace

SpoolWriter::SpoolWriter(const std::filesystem::path& path, std::string_view format,
                         const RecordHeader& header)
    : file_(path, spool_suffix) {
  const std::string encoded = encode(format, header);
  std::string start(magic);
  append_string(start, encoded);
  file_.write(start);
  line_.reserve((header.channels.size() + 1) * sizeof(double));
}

void SpoolWriter::row(double time, std::span<const double> values) {
  line_.clear();
  append_double(line_, time);
  for (const double value : values) append_double(line_, value);
  file_.write(line_);
  ++rows_;
}

SpoolReader::SpoolReader(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary) {
  std::string start(magic.size() + sizeof(std::uint32_t), '\0');
  if (!file_.read(start.data(), static_cast<std::streamsize>(start.size())) ||
      !start.starts_with(magic))
    throw FileError("cannot recover " + path.string() + ": it is no spool of a record");
  const auto length =
      ByteReader(std::string_view(start).substr(magic.size())).integer<std::uint32_t>();
  begin_ = start.size() + length;
  const std::uint64_t size = std::filesystem::file_size(path);
  std::string encoded(size < begin_ ? 0 : length, '\0');
  file_.read(encoded.data(), static_cast<std::streamsize>(encoded.size()));
  ByteReader bytes(encoded);
  format_ = bytes.string();
  header_ = decode(bytes);
  if (!bytes.good() || !file_)
    throw FileError("cannot recover " + path.string() + ": its header is not whole");
  const std::uint64_t row_bytes = (header_.channels.size() + 1) * sizeof(double);
  rows_ = static_cast<std::int64_t>((size - begin_) / row_bytes);
}

void SpoolReader::read(std::size_t first, std::span<std::vector<double>> columns) {
  const std::size_t width = header_.channels.size() + 1;
  std::string line(width * sizeof(double), '\0');
  for (std::vector<double>& column : columns) {
    column.clear();
    column.reserve(static_cast<std::size_t>(rows_));
  }
  file_.seekg(static_cast<std::streamoff>(begin_));
  for (std::int64_t row = 0; row < rows_; ++row) {
    if (!file_.read(line.data(), static_cast<std::streamsize>(line.size())))
      throw FileError("cannot read " + path_.string());
    ByteReader bytes(line);
    bytes.take(first * sizeof(double));
    for (std::vector<double>& column : columns) column.push_back(bytes.real());
  }
}

}  // namespace hookpoint::output
