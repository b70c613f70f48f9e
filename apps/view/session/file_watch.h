// Whether somebody has saved one of a run's files.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

namespace hookpoint::view {

class FileWatch {
 public:
  /// From now on these, as they are.
  void watch(std::vector<std::filesystem::path> paths);
  /// Whether one of them has been written since the last call that said so. Looks at most twice a
  /// second. A file that is gone for the moment, as some editors do it, has not been.
  bool written();

 private:
  std::vector<std::filesystem::path> paths_;
  std::vector<std::filesystem::file_time_type> times_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace hookpoint::view
