// Runs as another process leaves them: a file that grows by one whole record after the other. It
// has one writer, on whatever machine, and is read by others meanwhile, which a database on a
// network's file system would not allow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "studies/run/run_record.h"

namespace hookpoint::studies {

/// One record as it stands in the file.
std::string journal_entry(const std::string& identity, const RunRecord& record);
/// The record at the front of `text`, which is taken away from it; nothing unless it is whole and
/// as it was written.
std::optional<std::pair<std::string, RunRecord>> take_entry(std::string_view& text);

/// Appends. What a writer before it left is kept up to its last whole record.
class Journal {
 public:
  /// Throws output::FileError: also when another writes it.
  explicit Journal(std::filesystem::path file);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Whether that run is in it already.
  bool has(const std::string& identity) const { return identities_.contains(identity); }
  /// At the end, and on the disk at the latest a second later. Throws output::FileError.
  void add(const std::string& identity, const RunRecord& record);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::int64_t synced_ = 0;  ///< [ns], of a clock that never goes back
  std::set<std::string> identities_;
};

/// Reads what has come since it last looked.
class JournalReader {
 public:
  explicit JournalReader(std::filesystem::path file) : file_(std::move(file)) {}
  /// The next record; nothing when there is no other that is whole.
  std::optional<std::pair<std::string, RunRecord>> next();

 private:
  void look();

  std::filesystem::path file_;
  std::uint64_t offset_ = 0;  ///< of what was not yet read
  std::string text_;          ///< read, and not yet handed out
  std::size_t taken_ = 0;     ///< of it
};

}  // namespace hookpoint::studies
