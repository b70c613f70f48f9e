// Folders for files that are of no use after the program has ended.
#pragma once

#include <filesystem>
#include <string_view>

namespace hookpoint::output {

/// A folder of this user alone, removed with everything in it when the object is. One that a killed
/// program left behind is removed by the next object of the same kind: it holds a mark, and nobody
/// locks it any more.
class TemporaryFolder {
 public:
  /// `kind`: "movie" makes hookpoint-movie-XXXXXX. Throws FileError.
  explicit TemporaryFolder(std::string_view kind);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  ///< the open folder
};

}  // namespace hookpoint::output
