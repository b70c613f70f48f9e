// Files are read whole, and appear under their own names only when they are complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hookpoint::output {

/// The disk refused: the message names the file and the reason.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No file can be made there: another place may do.
struct PlaceError : FileError {
  using FileError::FileError;
};

/// "cannot write trace.csv.partial: No space left on device"; the reason is errno's.
[[noreturn]] void fail_file(std::string_view doing, const std::filesystem::path& file);

/// `path` with `suffix` added: where a file stands until it is complete.
std::filesystem::path partial_name(std::filesystem::path path,
                                   std::string_view suffix = ".partial");

/// Creates the missing folders above `path`. Throws PlaceError.
void make_folder_of(const std::filesystem::path& path);

/// `from` under the name `to`. Throws FileError.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Takes `bytes` of the disk for `file` (which exists) beyond its end now, so that a library that
/// cannot live with a full disk never meets one. Throws FileError.
void reserve_room(const std::filesystem::path& file, std::uint64_t bytes);

/// Written as `<path><suffix>`, renamed to `path` by `complete`. Destroyed before that, it leaves
/// the partial file, and never touches what stood under `path`. Nothing waits in a buffer: what was
/// written survives the end of the process, however it ends.
class PartialFile {
 public:
  /// Creates missing folders. Throws PlaceError.
  explicit PartialFile(std::filesystem::path path, std::string_view suffix = ".partial");
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// At the end, the whole text or, when the disk is full, nothing of it. Throws FileError.
  void write(std::string_view text) { write_at(size_, text); }
  /// All from `offset` <= size() on becomes `text`. Throws FileError; the file then ends at
  /// `offset`.
  void write_at(std::uint64_t offset, std::string_view text);
  /// Renames; nothing may be written afterwards. Throws FileError.
  void complete();

  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& partial() const { return partial_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// All of a regular file; nothing when there is none that can be read. Nobody may ever write to a
/// pipe: it is not read.
std::optional<std::string> read_file(const std::filesystem::path& path);

/// `text` as the whole of `path`, all or nothing. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace hookpoint::output
