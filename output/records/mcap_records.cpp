#include "output/records/mcap_records.h"

#include <zlib.h>

#include <numeric>

#include "output/files/bytes.h"

namespace hookpoint::output::mcap {
namespace {

/// Overwrites the 8 bytes at `place`, which hold a length that was not known yet.
void set_length(std::string& bytes, std::size_t place, std::uint64_t length) {
  for (std::size_t i = 0; i < sizeof length; ++i)
    bytes[place + i] = static_cast<char>(length >> (8 * i) & 0xffU);
}

void append_pairs(std::string& bytes, const TextPairs& pairs) {
  std::uint32_t length = 0;
  for (const auto& [key, value] : pairs)
    length += static_cast<std::uint32_t>(8 + key.size() + value.size());
  append_integer(bytes, length);
  for (const auto& [key, value] : pairs) {
    append_string(bytes, key);
    append_string(bytes, value);
  }
}

/// The summary, its records grouped by opcode, and the group offsets that tell where each begins.
class Summary {
 public:
  explicit Summary(std::uint64_t start) : start_(start) {}
  void begin_group() { group_ = bytes.size(); }
  void end_group(Opcode opcode) {
    if (bytes.size() == group_) return;
    const std::size_t record = begin_record(offsets, Opcode::summary_offset);
    append_integer(offsets, static_cast<std::uint8_t>(opcode));
    append_integer(offsets, std::uint64_t{start_ + group_});
    append_integer(offsets, std::uint64_t{bytes.size() - group_});
    end_record(offsets, record);
  }
  std::string bytes, offsets;

 private:
  std::uint64_t start_;
  std::size_t group_ = 0;
};

}  // namespace

std::size_t begin_record(std::string& bytes, Opcode opcode) {
  const std::size_t start = bytes.size();
  append_integer(bytes, static_cast<std::uint8_t>(opcode));
  append_integer(bytes, std::uint64_t{0});
  return start;
}

void end_record(std::string& bytes, std::size_t start) {
  set_length(bytes, start + 1, bytes.size() - start - prefix_bytes);
}

void append_header(std::string& bytes, std::string_view library) {
  const std::size_t record = begin_record(bytes, Opcode::header);
  append_string(bytes, "");  // no profile
  append_string(bytes, library);
  end_record(bytes, record);
}

void append_schema(std::string& bytes, std::uint16_t id, std::string_view name,
                   std::string_view json_schema) {
  const std::size_t record = begin_record(bytes, Opcode::schema);
  append_integer(bytes, id);
  append_string(bytes, name);
  append_string(bytes, "jsonschema");
  append_string(bytes, json_schema);
  end_record(bytes, record);
}

void append_channel(std::string& bytes, std::uint16_t id, std::uint16_t schema,
                    std::string_view topic, const TextPairs& metadata) {
  const std::size_t record = begin_record(bytes, Opcode::channel);
  append_integer(bytes, id);
  append_integer(bytes, schema);
  append_string(bytes, topic);
  append_string(bytes, "json");
  append_pairs(bytes, metadata);
  end_record(bytes, record);
}

void append_metadata(std::string& bytes, std::string_view name, const TextPairs& metadata) {
  const std::size_t record = begin_record(bytes, Opcode::metadata);
  append_string(bytes, name);
  append_pairs(bytes, metadata);
  end_record(bytes, record);
}

void append_chunk_index(std::string& bytes, const ChunkPlace& place) {
  const std::size_t record = begin_record(bytes, Opcode::chunk_index);
  append_integer(bytes, place.start_time);
  append_integer(bytes, place.end_time);
  append_integer(bytes, place.offset);
  append_integer(bytes, place.length);
  append_integer(bytes, static_cast<std::uint32_t>(place.channels * 10U));
  for (std::uint16_t i = 0; i < place.channels; ++i) {
    append_integer(bytes, static_cast<std::uint16_t>(place.first_channel + i));
    append_integer(bytes, place.offset + place.length + i * place.index_bytes());
  }
  append_integer(bytes, place.channels * place.index_bytes());
  append_string(bytes, "");  // no compression
  append_integer(bytes, place.records_bytes);
  append_integer(bytes, place.records_bytes);
  end_record(bytes, record);
}

void append_metadata_index(std::string& bytes, const MetadataPlace& place) {
  const std::size_t record = begin_record(bytes, Opcode::metadata_index);
  append_integer(bytes, place.offset);
  append_integer(bytes, place.length);
  append_string(bytes, place.name);
  end_record(bytes, record);
}

void append_statistics(std::string& bytes, const Totals& totals) {
  const std::size_t record = begin_record(bytes, Opcode::statistics);
  const auto channels = static_cast<std::uint16_t>(totals.messages.size());
  append_integer(bytes,
                 std::accumulate(totals.messages.begin(), totals.messages.end(), std::uint64_t{0}));
  append_integer(bytes, channels);  // schemas
  append_integer(bytes, std::uint32_t{channels});
  append_integer(bytes, std::uint32_t{0});  // attachments
  append_integer(bytes, totals.metadata);
  append_integer(bytes, static_cast<std::uint32_t>(totals.chunks.size()));
  append_integer(bytes, totals.chunks.empty() ? 0 : totals.chunks.front().start_time);
  append_integer(bytes, totals.chunks.empty() ? 0 : totals.chunks.back().end_time);
  append_integer(bytes, static_cast<std::uint32_t>(channels * 10U));
  for (std::uint16_t i = 0; i < channels; ++i) {
    append_integer(bytes, static_cast<std::uint16_t>(i + 1));
    append_integer(bytes, totals.messages[i]);
  }
  end_record(bytes, record);
}

std::string ending(std::uint64_t start, std::uint32_t data_crc,
                   const std::pair<std::string, std::string>& definitions, const Totals& totals,
                   std::span<const MetadataPlace> metadata) {
  std::string bytes;
  const std::size_t data_end = begin_record(bytes, Opcode::data_end);
  append_integer(bytes, data_crc);
  end_record(bytes, data_end);

  const std::uint64_t summary_start = start + bytes.size();
  Summary summary(summary_start);
  summary.begin_group();
  summary.bytes += definitions.first;
  summary.end_group(Opcode::schema);
  summary.begin_group();
  summary.bytes += definitions.second;
  summary.end_group(Opcode::channel);
  summary.begin_group();
  append_statistics(summary.bytes, totals);
  summary.end_group(Opcode::statistics);
  summary.begin_group();
  for (const ChunkPlace& chunk : totals.chunks) append_chunk_index(summary.bytes, chunk);
  summary.end_group(Opcode::chunk_index);
  summary.begin_group();
  for (const MetadataPlace& place : metadata) append_metadata_index(summary.bytes, place);
  summary.end_group(Opcode::metadata_index);
  const std::uint64_t offsets_start = summary_start + summary.bytes.size();

  // The CRC of the summary covers the footer up to the CRC itself.
  std::string section = summary.bytes + summary.offsets;
  const std::size_t footer = begin_record(section, Opcode::footer);
  append_integer(section, summary_start);
  append_integer(section, offsets_start);
  constexpr std::uint64_t footer_bytes = 8 + 8 + 4;
  set_length(section, footer + 1, footer_bytes);
  append_integer(section, crc32(section));
  return bytes.append(section).append(magic);
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace hookpoint::output::mcap
