// MCAP: a topic a channel, messages {"value": number} as JSON with a schema that has the unit and
// the range, in chunks with their indexes. Of a scene, beside them, /tf with the poses of each row,
// and /scene, once, in a chunk of its own ahead of the rows. A file that was cut off misses its
// summary; readers then go through the chunks.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "output/files/bytes.h"
#include "output/records/formats.h"
#include "output/records/foxglove.h"
#include "output/records/mcap_records.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

using mcap::Opcode;

std::string_view json_type(const Channel& channel) {
  if (channel.type == "bool") return "boolean";
  return channel.type == "int" ? "integer" : "number";
}

std::string json_schema(const Channel& channel) {
  const std::string described = channel.doc + (channel.doc.empty() ? "[" : " [") +
                                (channel.unit.empty() ? "1" : channel.unit) + "]";
  text::JsonWriter json;
  json.begin_object().member("title", channel.path).member("type", "object");
  json.member("description", described);
  json.key("properties").begin_object().key("value").begin_object();
  json.member("type", json_type(channel));
  json.member("description", described + "; null when not finite").member("unit", channel.unit);
  if (std::isfinite(channel.minimum)) json.member("minimum", channel.minimum);
  if (std::isfinite(channel.maximum)) json.member("maximum", channel.maximum);
  json.end_object().end_object().end_object();
  return json.text();
}

void append_value(std::string& bytes, std::string_view type, double value) {
  bytes += "{\"value\":";
  if (!std::isfinite(value)) {
    bytes += "null";
  } else if (type == "boolean" && (value == 0. || value == 1.)) {
    bytes += value == 1. ? "true" : "false";
  } else {
    text::append_shortest(bytes, value);
  }
  bytes += '}';
}

/// The nearest nanosecond; whole seconds apart, so that hours lose no digits. Throws FileError
/// where 64 bits do not hold it.
std::uint64_t nanoseconds(double time) {
  constexpr double latest = 1.8e10;  // [s]: 2^64 ns are 1.84e10 s
  if (!(time <= latest))
    throw FileError("MCAP counts time in nanoseconds, up to " + text::rounded(latest) +
                    " s: choose another format");
  const double whole = std::floor(time);
  return static_cast<std::uint64_t>(whole) * 1'000'000'000U +
         static_cast<std::uint64_t>(std::llround((time - whole) * 1e9));
}

/// Bytes of a message record ahead of its JSON: prefix, channel, sequence, two times.
constexpr std::size_t message_head = mcap::prefix_bytes + 2 + 4 + 8 + 8;
/// Of a channel's: {"value":...} of 24 digits.
constexpr std::size_t longest_message = message_head + 34;
constexpr std::size_t chunk_bytes = 1U << 20U;  ///< about; a run that is killed loses no more
constexpr std::size_t most_rows = 512;          ///< of a chunk

class McapRecord final : public RecordWriter {
 public:
  McapRecord(const std::filesystem::path& path, const RecordHeader& header)
      : RecordWriter(header.channels.size() + header.scene.bodies.size() * numbers_of_pose),
        file_(path),
        values_(header.channels.size()),
        topics_(static_cast<std::uint16_t>(values_)) {
    if (values_ >= 0xfffdU)
      throw FileError("cannot write " + path.string() + ": MCAP has at most 65532 channels");
    for (const Channel& channel : header.channels) types_.push_back(json_type(channel));
    std::size_t longest_row = values_ * longest_message;
    if (!header.scene.bodies.empty()) {
      transforms_.emplace(header.scene.bodies);
      scene_.emplace(header.scene);
      scene_waits_ = true;
      longest_row += message_head + transforms_->longest();
      ++topics_;
    }
    write_start(header);
    chunk_rows_ =
        std::clamp<std::size_t>(chunk_bytes / (longest_row + longest_message), 1, most_rows);
    records_.reserve(std::max(chunk_rows_ * longest_row, scene_bytes()));
    block_.reserve(records_.capacity() + 64 + topics_ * (16 + 16 * chunk_rows_));
    places_.resize(chunk_rows_ * (topics_ + 1U));
    times_.resize(chunk_rows_);
    messages_.resize(topics_ + (scene_ ? 1U : 0U));
    chunks_.reserve(4096);
  }

 private:
  void define(const std::string& topic, const std::string& schema_name, const std::string& schema,
              const mcap::TextPairs& metadata) {
    mcap::append_schema(definitions_.first, ++defined_, schema_name, schema);
    mcap::append_channel(definitions_.second, defined_, defined_, topic, metadata);
  }

  void write_start(const RecordHeader& header) {
    for (const Channel& channel : header.channels)
      define(channel.path, channel.path, json_schema(channel),
             {{"unit", channel.unit},
              {"type", channel.type},
              {"minimum", text::shortest(channel.minimum)},
              {"maximum", text::shortest(channel.maximum)},
              {"doc", channel.doc}});
    if (scene_) {
      define("/tf", "foxglove.FrameTransforms", foxglove::frame_transforms_schema(), {});
      define("/scene", "foxglove.SceneUpdate", foxglove::scene_update_schema(), {});
    }
    std::string bytes(mcap::magic);
    mcap::append_header(bytes, "hookpoint");
    mcap::TextPairs about{{"name", header.name},
                          {"period", text::shortest(header.period)},
                          {"experiment", header.experiment}};
    about.insert(about.end(), header.annotations.begin(), header.annotations.end());
    const std::uint64_t place = bytes.size();
    mcap::append_metadata(bytes, "record", about);
    metadata_.push_back({"record", place, bytes.size() - place});
    write_data(bytes + definitions_.first + definitions_.second);
  }

  /// Into the data section, over which the CRC runs.
  void write_data(std::string_view bytes) {
    file_.write(bytes);
    data_crc_ = mcap::crc32(bytes, data_crc_);
  }

  void append(double time, std::span<const double> row) override {
    const std::uint64_t now = nanoseconds(time);
    if (scene_waits_) write_scene(now);
    times_[waiting_] = now;
    for (std::size_t i = 0; i < values_; ++i) {
      const std::size_t record = begin_message(i, now);
      append_value(records_, types_[i], row[i]);
      mcap::end_record(records_, record);
    }
    if (transforms_) {
      const std::size_t record = begin_message(values_, now);
      transforms_->append(records_, now, row.subspan(values_));
      mcap::end_record(records_, record);
    }
    if (++waiting_ == chunk_rows_) write_rows();
  }

  /// The message of a topic in the row that waits last; its JSON follows.
  std::size_t begin_message(std::size_t topic, std::uint64_t time) {
    places_[topic * chunk_rows_ + waiting_] = records_.size();
    const std::size_t record = mcap::begin_record(records_, Opcode::message);
    append_integer(records_, static_cast<std::uint16_t>(topic + 1));
    append_integer(records_, static_cast<std::uint32_t>(messages_[topic] + waiting_));
    append_integer(records_, time);
    append_integer(records_, time);
    return record;
  }

  std::size_t scene_bytes() const { return scene_ ? message_head + scene_->longest() : 0; }

  /// With the time of the first row, that players who begin there have it.
  void write_scene(std::uint64_t time) {
    times_[0] = time;
    const std::size_t record = begin_message(topics_, time);
    scene_->append(records_, time);
    mcap::end_record(records_, record);
    waiting_ = 1;
    write_chunk(static_cast<std::uint16_t>(topics_), 1);
    scene_waits_ = false;
  }

  void write_rows() {
    if (waiting_ == 0) return;
    const std::uint64_t rows = waiting_;
    write_chunk(0, topics_);
    rows_ += rows;
  }

  /// The messages that wait, of `topics` topics from `first` on, then an index a topic, in one
  /// piece.
  void write_chunk(std::uint16_t first, std::uint16_t topics) {
    mcap::ChunkPlace place{.start_time = times_[0],
                           .end_time = times_[waiting_ - 1],
                           .offset = file_.size(),
                           .records_bytes = records_.size(),
                           .rows = waiting_,
                           .first_channel = static_cast<std::uint16_t>(first + 1),
                           .channels = topics};
    block_.clear();
    const std::size_t chunk = mcap::begin_record(block_, Opcode::chunk);
    append_integer(block_, place.start_time);
    append_integer(block_, place.end_time);
    append_integer(block_, std::uint64_t{records_.size()});
    append_integer(block_, mcap::crc32(records_));
    append_string(block_, "");  // no compression
    append_integer(block_, std::uint64_t{records_.size()});
    block_ += records_;
    mcap::end_record(block_, chunk);
    place.length = block_.size();
    for (std::size_t topic = first; topic < std::size_t{first} + topics; ++topic) {
      const std::size_t index = mcap::begin_record(block_, Opcode::message_index);
      append_integer(block_, static_cast<std::uint16_t>(topic + 1));
      append_integer(block_, static_cast<std::uint32_t>(16 * waiting_));
      for (std::size_t row = 0; row < waiting_; ++row) {
        append_integer(block_, times_[row]);
        append_integer(block_, places_[topic * chunk_rows_ + row]);
      }
      mcap::end_record(block_, index);
    }
    write_data(block_);
    chunks_.push_back(place);
    for (std::size_t topic = first; topic < std::size_t{first} + topics; ++topic)
      messages_[topic] += waiting_;
    waiting_ = 0;
    records_.clear();
  }

  void write_ending(bool complete) {
    std::string closing;
    mcap::append_metadata(
        closing, "end",
        {{"complete", complete ? "true" : "false"}, {"rows", std::to_string(rows_)}});
    std::vector<mcap::MetadataPlace> metadata = metadata_;
    metadata.push_back({"end", file_.size(), closing.size()});
    const mcap::Totals totals{messages_, static_cast<std::uint32_t>(metadata.size()), chunks_};
    file_.write(closing + mcap::ending(file_.size() + closing.size(),
                                       mcap::crc32(closing, data_crc_), definitions_, totals,
                                       metadata));
  }
  void finish() override {
    write_rows();
    write_ending(true);
    file_.complete();
  }
  Kept keep() override {
    const Kept kept{file_.partial(), static_cast<std::int64_t>(rows_)};
    // The chunk that did not fit often leaves room for a summary; readers can do without it.
    try {
      write_ending(false);
    } catch (const FileError&) {
      return kept;
    }
    return kept;
  }

  PartialFile file_;
  std::size_t values_;    ///< of a row, ahead of the poses
  std::uint16_t topics_;  ///< with a message a row
  std::vector<std::string_view> types_;
  std::optional<foxglove::FrameTransforms> transforms_;
  std::optional<foxglove::SceneUpdate> scene_;
  bool scene_waits_ = false;  ///< for the first row
  std::uint16_t defined_ = 0;
  std::pair<std::string, std::string> definitions_;  ///< schemas, channels
  std::vector<mcap::MetadataPlace> metadata_;
  std::uint32_t data_crc_ = 0;
  std::size_t chunk_rows_ = 1;
  std::string records_;                ///< messages that wait for their chunk
  std::string block_;                  ///< a chunk and its indexes on the way to the disk
  std::vector<std::uint64_t> places_;  ///< of the messages in `records_`, topic by topic
  std::vector<std::uint64_t> times_;   ///< of the waiting rows [ns]
  std::vector<mcap::ChunkPlace> chunks_;
  std::vector<std::uint64_t> messages_;  ///< in the file, of each topic
  std::uint64_t rows_ = 0;               ///< in the file
  std::size_t waiting_ = 0;
};

}  // namespace

std::unique_ptr<RecordWriter> make_mcap_record(const std::filesystem::path& path,
                                               const RecordHeader& header) {
  return std::make_unique<McapRecord>(path, header);
}

}  // namespace hookpoint::output
