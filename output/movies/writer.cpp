// Movies, written. The state is one dataset, a row a number and a column an instant, in chunks of
// some numbers by a block of instants. Most numbers of a run stay as they are (parameters, points
// in the air): their chunks are compressed once.
#include <algorithm>
#include <bit>
#include <cstring>

#include "output/movies/format.h"
#include "output/movies/movie.h"
#include "output/records/hdf5_file.h"
#include "output/records/shuffled_chunk.h"

namespace hookpoint::output {
namespace {

constexpr hsize_t block_instants = 512;    ///< of a chunk, and between two flushes
constexpr hsize_t group_numbers = 8;       ///< of a chunk
constexpr std::size_t still_bytes = 1024;  ///< what a chunk in which nothing changes takes at most

Hdf5Handle chunked(int rank, const hsize_t* chunk) {
  Hdf5Handle properties = clockless_dataset();
  require_hdf5(H5Pset_chunk(properties, rank, chunk));
  require_hdf5(H5Pset_shuffle(properties));
  require_hdf5(H5Pset_deflate(properties, deflate_level));
  return properties;
}

/// A run of numbers that stays as it is, compressed.
struct Still {
  std::vector<std::uint64_t> values;
  std::vector<unsigned char> encoded;
};

class MovieWriter final : public RecordWriter {
 public:
  MovieWriter(const std::filesystem::path& path, const MovieHeader& header)
      : RecordWriter(header.size),
        path_(path),
        partial_(partial_name(path)),
        size_(header.size),
        group_(std::min<hsize_t>(group_numbers, size_)),
        encoder_(group_ * block_instants, deflate_level),
        chunk_(group_ * block_instants),
        still_((size_ + group_ - 1) / group_),
        rows_(size_ * block_instants),
        times_(block_instants) {
    for (Still& still : still_) {
      still.values.reserve(group_);
      still.encoded.reserve(still_bytes);
    }
    make_folder_of(path_);
    { PartialFile place(path_); }  // whether the file can be made at all, and why not
    reserve_room(partial_, header_room(header));
    file_ = create_hdf5(partial_);
    write_header(header);
    flush_hdf5(file_, partial_);
  }
  ~MovieWriter() override {
    state_.reset();
    time_.reset();
    file_.reset();
  }

 private:
  void write_header(const MovieHeader& header) {
    hdf5_annotate(file_, movie_mark, movie_version);
    hdf5_annotate(file_, "name", header.name);
    hdf5_annotate(file_, "period", header.period);
    hdf5_annotate(file_, "complete", 0.);
    hdf5_write_text(file_, "experiment", header.experiment);
    hdf5_write_text(file_, "layout", header.layout);
    const Hdf5Handle notes(H5Gcreate2(file_, "annotations", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Gclose);
    for (const auto& [key, value] : header.annotations) hdf5_write_text(notes, key.c_str(), value);
    const Hdf5Handle files(H5Gcreate2(file_, "files", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Gclose);
    for (std::size_t i = 0; i < header.files.size(); ++i) write_file(files, i, header.files[i]);
    create_datasets();
  }

  void write_file(hid_t group, std::size_t i, const MovieFile& file) {
    const hsize_t size = file.content.size();
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hdf5Handle dataset(H5Dcreate2(group, std::to_string(i).c_str(), H5T_STD_U8LE, space,
                                        H5P_DEFAULT, clockless_dataset(), H5P_DEFAULT),
                             H5Dclose);
    hdf5_annotate(dataset, "name", file.name);
    hdf5_annotate(dataset, "path", file.path);
    if (size == 0) return;
    check_hdf5(
        H5Dwrite(dataset, H5T_NATIVE_UCHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT, file.content.data()),
        partial_);
  }

  void create_datasets() {
    const hsize_t none = 0, unlimited = H5S_UNLIMITED;
    const Hdf5Handle line(H5Screate_simple(1, &none, &unlimited), H5Sclose);
    time_ = {H5Dcreate2(file_, "time", H5T_IEEE_F64LE, line, H5P_DEFAULT,
                        chunked(1, &block_instants), H5P_DEFAULT),
             H5Dclose};
    hdf5_annotate(time_, "unit", std::string("s"));
    const hsize_t empty[2] = {size_, 0}, full[2] = {size_, H5S_UNLIMITED};
    const hsize_t chunk[2] = {group_, block_instants};
    const Hdf5Handle table(H5Screate_simple(2, empty, full), H5Sclose);
    state_ = {H5Dcreate2(file_, "state", H5T_IEEE_F64LE, table, H5P_DEFAULT, chunked(2, chunk),
                         H5P_DEFAULT),
              H5Dclose};
  }

  void append(double time, std::span<const double> state) override {
    times_[waiting_] = time;
    std::memcpy(rows_.data() + waiting_ * size_, state.data(), state.size_bytes());
    if (++waiting_ == block_instants) flush();
  }

  /// The block that waits, to the disk.
  void flush() {
    if (waiting_ == 0) return;
    reserve_room(partial_, block_room());
    const hsize_t end = written_ + waiting_;
    check_hdf5(H5Dset_extent(time_, &end), partial_);
    const Hdf5Handle memory(H5Screate_simple(1, &waiting_, nullptr), H5Sclose);
    const Hdf5Handle target(H5Dget_space(time_), H5Sclose);
    require_hdf5(
        H5Sselect_hyperslab(target, H5S_SELECT_SET, &written_, nullptr, &waiting_, nullptr));
    check_hdf5(H5Dwrite(time_, H5T_NATIVE_DOUBLE, memory, target, H5P_DEFAULT, times_.data()),
               partial_);
    const hsize_t extent[2] = {size_, end};
    check_hdf5(H5Dset_extent(state_, extent), partial_);
    for (std::size_t group = 0; group < still_.size(); ++group) {
      const std::span<const unsigned char> bytes = encode(group);
      const hsize_t offset[2] = {group * group_, written_};
      check_hdf5(H5Dwrite_chunk(state_, H5P_DEFAULT, 0, offset, bytes.size(), bytes.data()),
                 partial_);
    }
    flush_hdf5(file_, partial_);
    written_ = end;
    waiting_ = 0;
  }

  /// The chunk of a group's numbers over the block, each number's instants beside one another.
  std::span<const unsigned char> encode(std::size_t group) {
    const std::size_t first = group * group_, count = std::min<std::size_t>(group_, size_ - first);
    bool same = true;
    for (std::size_t k = 0; k < waiting_; ++k) {
      const std::uint64_t* row = rows_.data() + k * size_ + first;
      for (std::size_t n = 0; n < count; ++n) {
        chunk_[n * block_instants + k] = row[n];
        same = same && row[n] == rows_[first + n];
      }
    }
    if (!same || waiting_ != block_instants) return encoder_.encode(chunk_);
    Still& still = still_[group];
    const std::span<const std::uint64_t> values(rows_.data() + first, count);
    if (!std::ranges::equal(values, still.values)) {
      const std::span<const unsigned char> bytes = encoder_.encode(chunk_);
      if (bytes.size() > still_bytes) return bytes;
      still.values.assign(values.begin(), values.end());
      still.encoded.assign(bytes.begin(), bytes.end());
    }
    return still.encoded;
  }

  /// Upper bounds: what is written uncompressed, and for each dataset and chunk the nodes of the
  /// tree in which they are found.
  static constexpr std::uint64_t tree = 16384;
  std::uint64_t block_room() const {
    return still_.size() * (encoder_.longest() + 256) + 4 * tree + times_.size() * sizeof(double);
  }
  static std::uint64_t header_room(const MovieHeader& header) {
    std::uint64_t room = 16 * tree + header.experiment.size() + header.layout.size();
    for (const auto& [key, value] : header.annotations) room += tree + key.size() + value.size();
    for (const MovieFile& file : header.files) room += tree + file.content.size();
    return room;
  }

  void finish() override {
    flush();
    check_hdf5(H5Adelete(file_, "complete"), partial_);
    hdf5_annotate(file_, "complete", 1.);
    bool closed = state_.reset();
    closed = time_.reset() && closed;
    closed = file_.reset() && closed;
    if (!closed) throw FileError("cannot close " + partial_.string());
    rename_file(partial_, path_);
  }
  Kept keep() override {
    state_.reset();
    time_.reset();
    file_.reset();
    return {partial_, static_cast<std::int64_t>(written_)};
  }

  std::filesystem::path path_;
  std::filesystem::path partial_;
  hsize_t size_, group_;
  ShuffledChunk encoder_;
  std::vector<std::uint64_t> chunk_;
  std::vector<Still> still_;         ///< one a group
  std::vector<std::uint64_t> rows_;  ///< the block that waits, an instant after the other
  std::vector<double> times_;
  Hdf5Handle file_, time_, state_;
  hsize_t waiting_ = 0;  ///< instants in the block
  hsize_t written_ = 0;  ///< instants in the file
};

}  // namespace

std::unique_ptr<RecordWriter> make_movie_writer(const std::filesystem::path& path,
                                                const MovieHeader& header) {
  return std::make_unique<MovieWriter>(path, header);
}

}  // namespace hookpoint::output
