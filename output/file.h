// A file that appears under its own name only when it is complete.
#pragma once

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace hookpoint::output {

/// The disk refused: the message names the file and the reason.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Written as `<path>.partial`, renamed to `path` by `complete`. Destroyed before that, it leaves
/// the partial file, whose whole lines are there to be looked at, and never touches what stood
/// under `path`.
class PartialFile {
 public:
  /// Creates missing folders. Throws FileError.
  explicit PartialFile(std::filesystem::path path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Throws FileError when the disk is full.
  void write(std::string_view text);
  /// Flushes and renames; nothing may be written afterwards. Throws FileError.
  void complete();
  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(const char* doing) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  std::FILE* file_ = nullptr;
};

/// `text` as the whole of `path`, all or nothing. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace hookpoint::output
