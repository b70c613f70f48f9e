#include "output/files/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace hookpoint::output {

void fail_file(std::string_view doing, const std::filesystem::path& file) {
  const int reason = errno;
  throw FileError("cannot " + std::string(doing) + " " + file.string() + ": " +
                  std::strerror(reason) +
                  (reason == EFBIG ? " (the limit of file sizes, `ulimit -f`)" : ""));
}

std::filesystem::path partial_name(std::filesystem::path path, std::string_view suffix) {
  return path += suffix;
}

void make_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  std::error_code error, ignored;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (!error || std::filesystem::is_directory(folder, ignored)) return;
  throw PlaceError("cannot create " + path.string() +
                   ": its folder cannot be made: " + error.message());
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw FileError("cannot rename " + from.string() + ": " + error.message());
}

void reserve_room(const std::filesystem::path& file, std::uint64_t bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_file("open", file);
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  const int refused = ::posix_fallocate(descriptor, end, static_cast<off_t>(bytes));
  // A refusal may have come half way: what it took is given back.
  const bool given_back = refused == 0 || ::ftruncate(descriptor, end) == 0;
  ::close(descriptor);
  errno = refused;
  if (refused != 0 || !given_back) fail_file("write", file);
}

PartialFile::PartialFile(std::filesystem::path path, std::string_view suffix)
    : path_(std::move(path)), partial_(partial_name(path_, suffix)) {
  make_folder_of(path_);
  descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ >= 0) return;
  const int reason = errno;
  throw PlaceError("cannot create " + partial_.string() + ": " + std::strerror(reason));
}

PartialFile::~PartialFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PartialFile::write_at(std::uint64_t offset, std::string_view text) {
  std::uint64_t end = offset;
  while (!text.empty()) {
    const ssize_t written =
        ::pwrite(descriptor_, text.data(), text.size(), static_cast<off_t>(end));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int reason = errno;
      size_ = offset;
      const bool cut = ::ftruncate(descriptor_, static_cast<off_t>(offset)) == 0;
      if (cut) errno = reason;
      fail_file(cut ? "write" : "write (nor shorten)", partial_);
    }
    end += static_cast<std::uint64_t>(written);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (end < size_ && ::ftruncate(descriptor_, static_cast<off_t>(end)) != 0)
    fail_file("shorten", partial_);
  size_ = end;
}

void PartialFile::complete() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail_file("write", partial_);
  rename_file(partial_, path_);
}

std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad()) return std::nullopt;
  return text;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  PartialFile file(path);
  file.write(text);
  file.complete();
}

}  // namespace hookpoint::output
