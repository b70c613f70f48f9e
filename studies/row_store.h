// Finished runs on disk, one small file each, so that an interrupted study goes on where it
// stopped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "studies/execute.h"

namespace hookpoint::studies {

/// Files `rows/00042.row` of a study's folder: values with as many digits as read back to the same
/// double. Distinct rows may be saved from several threads.
class RowStore {
 public:
  /// `hash` of the plan: rows of another plan count as missing. Without `keep` earlier rows are
  /// removed.
  RowStore(std::filesystem::path folder, std::string hash, bool keep);
  /// Nothing when the row is missing, damaged, or has not `metrics` values and `plots` traces.
  std::optional<RowOutcome> load(std::size_t row, std::size_t metrics, std::size_t plots) const;
  void save(std::size_t row, const RowOutcome& outcome) const;

 private:
  std::filesystem::path path(std::size_t row) const;
  std::filesystem::path folder_;
  std::string hash_;
};

}  // namespace hookpoint::studies
