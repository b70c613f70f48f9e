// HDF5: `/time` and a dataset a channel under `/channels`, extended block by block. The library
// loses a file in which a write failed, so the room of a block is taken before it is written; after
// each block everything is flushed, and a run that dies leaves a file that reads up to there.
#include "output/records/formats.h"
#include "output/records/hdf5_file.h"

namespace hookpoint::output {
namespace {

constexpr hsize_t block_rows = 512;  ///< rows of a chunk, and between two flushes

Hdf5Handle create_dataset(hid_t group, const Channel& channel, const char* name) {
  const hsize_t none = 0, unlimited = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
  const Hdf5Handle properties = clockless_dataset();
  require_hdf5(H5Pset_chunk(properties, 1, &block_rows));
  require_hdf5(H5Pset_shuffle(properties));
  require_hdf5(H5Pset_deflate(properties, deflate_level));
  Hdf5Handle dataset(
      H5Dcreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose);
  hdf5_annotate(dataset, "path", channel.path);
  hdf5_annotate(dataset, "unit", channel.unit);
  hdf5_annotate(dataset, "type", channel.type);
  hdf5_annotate(dataset, "minimum", channel.minimum);
  hdf5_annotate(dataset, "maximum", channel.maximum);
  hdf5_annotate(dataset, "doc", channel.doc);
  return dataset;
}

class Hdf5Record final : public RecordWriter {
 public:
  Hdf5Record(const std::filesystem::path& path, const RecordHeader& header)
      : RecordWriter(header.channels.size()), path_(path), partial_(partial_name(path)) {
    make_folder_of(path_);
    { PartialFile place(path_); }  // whether the file can be made at all, and why not
    reserve_room(partial_, header_room(header));
    file_ = create_hdf5(partial_);
    write_header(header);
    block_.resize(datasets_.size() * block_rows);
    flush_hdf5(file_, partial_);
  }
  ~Hdf5Record() override {
    datasets_.clear();
    file_.reset();
  }

 private:
  void write_header(const RecordHeader& header) {
    hdf5_annotate(file_, "name", header.name);
    hdf5_annotate(file_, "period", header.period);
    hdf5_annotate(file_, "complete", 0.);
    hdf5_write_text(file_, "experiment", header.experiment);
    const Hdf5Handle notes(H5Gcreate2(file_, "annotations", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Gclose);
    for (const auto& [key, value] : header.annotations) hdf5_write_text(notes, key.c_str(), value);
    datasets_.push_back(
        create_dataset(file_, {"time", "s", "double", 0., infinity, "simulated time"}, "time"));
    const Hdf5Handle group(H5Gcreate2(file_, "channels", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Gclose);
    for (const Channel& channel : header.channels)
      datasets_.push_back(create_dataset(group, channel, channel.path.c_str()));
  }

  void append(double time, std::span<const double> values) override {
    block_[waiting_] = time;
    for (std::size_t i = 0; i < values.size(); ++i)
      block_[(i + 1) * block_rows + waiting_] = values[i];
    if (++waiting_ == block_rows) flush();
  }

  /// The block that waits, to the disk.
  void flush() {
    if (waiting_ == 0) return;
    reserve_room(partial_, room(datasets_.size()));
    const Hdf5Handle memory(H5Screate_simple(1, &waiting_, nullptr), H5Sclose);
    const hsize_t end = written_ + waiting_;
    for (std::size_t i = 0; i < datasets_.size(); ++i) {
      check_hdf5(H5Dset_extent(datasets_[i], &end), partial_);
      const Hdf5Handle target(H5Dget_space(datasets_[i]), H5Sclose);
      require_hdf5(
          H5Sselect_hyperslab(target, H5S_SELECT_SET, &written_, nullptr, &waiting_, nullptr));
      check_hdf5(H5Dwrite(datasets_[i], H5T_NATIVE_DOUBLE, memory, target, H5P_DEFAULT,
                          block_.data() + i * block_rows),
                 partial_);
    }
    flush_hdf5(file_, partial_);
    written_ = end;
    waiting_ = 0;
  }

  /// An upper bound of what a block takes: its data uncompressed, and for each dataset a few nodes
  /// of the tree in which its chunks are found.
  static std::uint64_t room(std::size_t datasets) {
    constexpr std::uint64_t tree = 16384;
    return (datasets + 1) * (block_rows * sizeof(double) + tree);
  }
  static std::uint64_t header_room(const RecordHeader& header) {
    std::uint64_t texts = header.name.size() + header.experiment.size();
    for (const auto& [key, value] : header.annotations) texts += key.size() + value.size();
    for (const Channel& channel : header.channels)
      texts += 2 * channel.path.size() + channel.doc.size();
    return texts + room(header.channels.size() + header.annotations.size());
  }

  void finish() override {
    flush();
    check_hdf5(H5Adelete(file_, "complete"), partial_);
    hdf5_annotate(file_, "complete", 1.);
    close_file();
    rename_file(partial_, path_);
  }
  void close_file() {
    bool closed = true;
    for (Hdf5Handle& dataset : datasets_) closed = dataset.reset() && closed;
    closed = file_.reset() && closed;
    if (!closed) throw FileError("cannot close " + partial_.string());
  }
  Kept keep() override {
    datasets_.clear();
    file_.reset();
    return {partial_, static_cast<std::int64_t>(written_)};
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::filesystem::path path_;
  std::filesystem::path partial_;
  Hdf5Handle file_;
  std::vector<Hdf5Handle> datasets_;  ///< the time, then the channels
  std::vector<double> block_;         ///< one row of `block_rows` a dataset
  hsize_t waiting_ = 0;               ///< rows in the block
  hsize_t written_ = 0;               ///< rows in the file
};

}  // namespace

std::unique_ptr<RecordWriter> make_hdf5_record(const std::filesystem::path& path,
                                               const RecordHeader& header) {
  return std::make_unique<Hdf5Record>(path, header);
}

}  // namespace hookpoint::output
