// The records of an MCAP file as bytes (MCAP format specification, version 0): opcode, length of
// the content, content; all integers little-endian.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hookpoint::output::mcap {

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0b,
  metadata = 0x0c,
  metadata_index = 0x0d,
  summary_offset = 0x0e,
  data_end = 0x0f,
};

inline constexpr std::string_view magic = "\x89MCAP0\r\n";
/// Opcode and length in front of a content.
inline constexpr std::size_t prefix_bytes = 9;

using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// Opens a record at the end of `bytes`; returns where it begins, for `end_record`.
std::size_t begin_record(std::string& bytes, Opcode opcode);
/// Writes the length of the record that began at `start` and now ends.
void end_record(std::string& bytes, std::size_t start);

void append_header(std::string& bytes, std::string_view library);
void append_schema(std::string& bytes, std::uint16_t id, std::string_view name,
                   std::string_view json_schema);
/// Messages of the channel are JSON.
void append_channel(std::string& bytes, std::uint16_t id, std::uint16_t schema,
                    std::string_view topic, const TextPairs& metadata);
void append_metadata(std::string& bytes, std::string_view name, const TextPairs& metadata);

/// Where a chunk stands in the file. Its channels have consecutive ids, and each has one message a
/// row, so that all message indexes of a chunk have one length and follow from this.
struct ChunkPlace {
  std::uint64_t start_time = 0, end_time = 0;  ///< [ns]
  std::uint64_t offset = 0, length = 0;        ///< of the chunk record
  std::uint64_t records_bytes = 0;             ///< of the messages inside
  std::uint64_t rows = 0;
  std::uint16_t first_channel = 1, channels = 0;

  /// Of one message index record.
  std::uint64_t index_bytes() const { return prefix_bytes + 2 + 4 + 16 * rows; }
};
void append_chunk_index(std::string& bytes, const ChunkPlace& place);

struct MetadataPlace {
  std::string name;
  std::uint64_t offset = 0, length = 0;
};
void append_metadata_index(std::string& bytes, const MetadataPlace& place);

/// What is said of the whole file; schemas and channels are as many.
struct Totals {
  std::span<const std::uint64_t> messages;  ///< of each channel
  std::uint32_t metadata = 0;
  std::span<const ChunkPlace> chunks;
};
void append_statistics(std::string& bytes, const Totals& totals);

/// From the end of the data section to the end of the file: data end, summary, summary offsets,
/// footer, magic. `start`: offset at which this will stand; `data_crc`: CRC-32 of all bytes before.
/// `definitions`: the schema records, then the channel records.
std::string ending(std::uint64_t start, std::uint32_t data_crc,
                   const std::pair<std::string, std::string>& definitions, const Totals& totals,
                   std::span<const MetadataPlace> metadata);

/// CRC-32 (ISO 3309), going on from `crc`, 0 at the start.
std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace hookpoint::output::mcap
