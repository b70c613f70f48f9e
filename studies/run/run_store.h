// Finished runs on disk, by what decides their numbers: an interrupted study continues where it
// stopped, and no run is made twice, in whatever study it stands.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/run/run_record.h"

namespace hookpoint::studies {

/// The disk is full, or the store is damaged, held by another program, or of another version. The
/// message names the file and what to do; what is in it stays as it is.
struct StoreError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `runs.sqlite` in a folder: one writer, this process, for as long as the object lives. What
/// `save` has returned from is there whenever the process ends. Any thread may call. Damage within
/// a run is recognised by its hashes: the run then counts as missing.
class RunStore {
 public:
  static constexpr const char* file_name = "runs.sqlite";

  /// Without `keep` the runs of before are removed. Throws StoreError.
  RunStore(const std::filesystem::path& folder, bool keep);
  ~RunStore();
  RunStore(const RunStore&) = delete;
  RunStore& operator=(const RunStore&) = delete;

  /// Of the run with that identity (32 hexadecimal digits): its numbers, or all of it.
  std::optional<RunRecord> numbers(const std::string& identity) const;
  std::optional<RunRecord> load(const std::string& identity) const;
  /// Together with what is there of the same run already. It is that of row `row` of `study` now.
  void save(const std::string& study, std::size_t row, const std::string& identity,
            RunRecord record);
  /// Says whose run that of the row is, which is in the store.
  void assign(const std::string& study, std::size_t row, const std::string& identity);
  /// The run that the row of `study` had last; nothing when it had none.
  std::optional<std::string> assigned(const std::string& study, std::size_t row) const;

  /// What was timed, under a name that no two studies share: a time never repeats.
  std::optional<RunRecord> timing(const std::string& identity) const;
  void save_timing(const std::string& identity, const RunRecord& record);

 private:
  class Connection;
  mutable std::mutex mutex_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace hookpoint::studies
