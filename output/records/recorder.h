// Data out: rows of channels at given times, in the format that the analyst's tools read, every
// channel with its path, unit, type, range and meaning. docs/data.md has the layouts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/files/file.h"
#include "output/records/channel.h"
#include "output/records/scene.h"

namespace hookpoint::output {

struct RecordHeader {
  std::string name;
  std::vector<Channel> channels;
  double period = 0.;      ///< between rows [s]; 0 when it varies
  std::string experiment;  ///< the experiment's text, from which the run can be repeated
  std::vector<std::pair<std::string, std::string>> annotations;  ///< engine, version, seed, ...
  Scene scene;  ///< what a player draws; only for a format that `shows_scene`
};

/// A record being written. Until `close` its file is named `<path>.partial`. A run that is cut off
/// leaves that file, readable up to the last rows (`csv`, `wl`, `hdf5`, `mcap`; how many may be
/// lost: docs/data.md), or `<path>.spool` (`mat5`, `mat73`), which `recover_spool` turns into the
/// record.
class RecordWriter {
 public:
  virtual ~RecordWriter() = default;
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// `values`: one a channel, in its unit, then numbers_of_pose for each body of the header's
  /// scene. `time` [s], not before the last row's. Allocates nothing, but for what the HDF5 library
  /// does at the end of a block. Throws FileError when the disk refuses: the message names the
  /// file, the moment and what is kept; later rows throw the same.
  void row(double time, std::span<const double> values);
  /// The record complete under its own name. Does nothing once a row was refused. Throws FileError.
  void close();

 protected:
  /// What a reader finds after the disk refused.
  struct Kept {
    std::filesystem::path file;
    std::int64_t rows = 0;
  };

  /// `values`: of a row.
  explicit RecordWriter(std::size_t values) : values_(values) {}
  virtual void append(double time, std::span<const double> values) = 0;
  virtual void finish() = 0;
  /// Leaves what can be kept in a readable state. Called once, after a FileError of `append` or
  /// `finish`.
  virtual Kept keep() = 0;

 private:
  [[noreturn]] void refuse(const FileError& error);

  std::size_t values_;
  double time_ = 0.;
  std::string refusal_;  ///< the message of the first FileError
  bool closed_ = false;
};

struct RecordFormat {
  std::string_view name;       ///< as in `format = hdf5`
  std::string_view extension;  ///< "h5"
  std::string_view doc;        ///< one line
  bool shows_scene = false;    ///< takes RecordHeader::scene, poses and shapes
};

/// All formats, in the order in which the manual lists them.
std::span<const RecordFormat> record_formats();

/// nullptr when there is none of that name.
const RecordFormat* find_record_format(std::string_view name);

/// `format`: a name of `record_formats`, else std::invalid_argument. Creates missing folders.
/// Throws FileError.
std::unique_ptr<RecordWriter> make_record_writer(std::string_view format,
                                                 const std::filesystem::path& path,
                                                 const RecordHeader& header);

/// Turns what a killed run left of a `mat5` or `mat73` record into the record at `<path>`, and
/// removes the spool. Returns its path and rows. Throws FileError, also when the file is no spool.
struct RecoveredRecord {
  std::filesystem::path path;
  std::int64_t rows = 0;
};
RecoveredRecord recover_spool(const std::filesystem::path& spool);

}  // namespace hookpoint::output
