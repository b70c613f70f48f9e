// Where a run leaves files that nobody wants.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "apps/python/errors.h"

namespace hookpoint::python {

/// A folder that is gone with everything in it when this is.
class TemporaryFolder {
 public:
  /// Throws hookpoint.Error.
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hookpoint-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw_error("there is no room for temporary files");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hookpoint::python
