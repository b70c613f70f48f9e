// Finished runs on disk, one small file each, so that an interrupted study goes on where it
// stopped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "studies/run/execute.h"

namespace hookpoint::studies {

/// Files `rows/00042.row` of a study's folder: values with as many digits as read back to the same
/// double, under the identity of their run, with a hash of all of it at the end. A file appears
/// under its name when it is whole; one that a failing disk damaged is a row that is missing.
/// Distinct rows may be saved from several threads.
class RowStore {
 public:
  /// Without `keep` earlier rows are removed. Throws output::FileError.
  RowStore(std::filesystem::path folder, bool keep);
  /// Nothing when the row is missing, damaged, of another run than `identity`
  /// (StudyPlan::identity_of), or has not `metrics` values and `plots` traces.
  std::optional<RowOutcome> load(std::size_t row, const std::string& identity, std::size_t metrics,
                                 std::size_t plots) const;
  /// Whether there is a file of that row, whatever is in it.
  bool has(std::size_t row) const;
  /// The status and the notices of `outcome` are a line each.
  void save(std::size_t row, const std::string& identity, const RowOutcome& outcome) const;

 private:
  std::filesystem::path path(std::size_t row) const;
  std::filesystem::path folder_;
};

}  // namespace hookpoint::studies
