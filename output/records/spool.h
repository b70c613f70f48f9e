// Rows on their way into a format that cannot be appended to: a plain binary file that holds the
// header and every row so far, whenever the run ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "output/files/file.h"
#include "output/records/recorder.h"

namespace hookpoint::output {

inline constexpr std::string_view spool_suffix = ".spool";

/// Writes `<path>.spool`: the magic line, a header of counted strings (bytes.h), then a row of
/// time and values after the other, as 8-byte little-endian reals.
class SpoolWriter {
 public:
  /// `format`: what the record is to become. Throws FileError.
  SpoolWriter(const std::filesystem::path& path, std::string_view format,
              const RecordHeader& header);
  /// Throws FileError; the row is then not there at all.
  void row(double time, std::span<const double> values);
  const std::filesystem::path& path() const { return file_.partial(); }
  std::int64_t rows() const { return rows_; }

 private:
  PartialFile file_;
  std::string line_;
  std::int64_t rows_ = 0;
};

/// A spool read back. A last row that is not whole is left out.
class SpoolReader {
 public:
  /// Throws FileError when it cannot be read or is no spool.
  explicit SpoolReader(const std::filesystem::path& path);
  const std::string& format() const { return format_; }
  const RecordHeader& header() const { return header_; }
  std::int64_t rows() const { return rows_; }
  /// Columns [first, first + columns.size()) of all rows; column 0 is the time. One pass over the
  /// file.
  void read(std::size_t first, std::span<std::vector<double>> columns);

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::string format_;
  RecordHeader header_;
  std::uint64_t begin_ = 0;  ///< offset of the first row
  std::int64_t rows_ = 0;
};

}  // namespace hookpoint::output
