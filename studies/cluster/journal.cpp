#include "studies/cluster/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>

#include "output/files/file.h"

namespace hookpoint::studies {
namespace {

constexpr std::string_view entry_mark = "run ";
constexpr std::size_t identity_digits = 32;
constexpr std::int64_t between_syncs = 1'000'000'000;  ///< [ns]

std::int64_t nanoseconds_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A count at the front of `text`, up to `end`.
std::optional<std::size_t> take_count(std::string_view& text, char end) {
  std::size_t count = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const auto digits = static_cast<std::size_t>(rest - text.data());
  if (error != std::errc{} || digits >= text.size() || text[digits] != end) return std::nullopt;
  text.remove_prefix(digits + 1);
  return count;
}

}  // namespace

std::string journal_entry(const std::string& identity, const RunRecord& record) {
  const std::string numbers = numbers_text(record), samples = samples_bytes(record);
  return std::string(entry_mark) + identity + ' ' + std::to_string(numbers.size()) + ' ' +
         std::to_string(samples.size()) + '\n' + numbers + samples;
}

std::optional<std::pair<std::string, RunRecord>> take_entry(std::string_view& text) {
  std::string_view rest = text;
  if (!rest.starts_with(entry_mark) || rest.size() <= entry_mark.size() + identity_digits)
    return std::nullopt;
  rest.remove_prefix(entry_mark.size());
  std::string identity(rest.substr(0, identity_digits));
  if (rest[identity_digits] != ' ') return std::nullopt;
  rest.remove_prefix(identity_digits + 1);
  const auto numbers = take_count(rest, ' ');
  const auto samples = numbers ? take_count(rest, '\n') : std::nullopt;
  if (!samples || *numbers > rest.size() || *samples > rest.size() - *numbers) return std::nullopt;
  auto record = read_numbers(rest.substr(0, *numbers));
  if (!record || !read_samples(rest.substr(*numbers, *samples), *record)) return std::nullopt;
  text = rest.substr(*numbers + *samples);
  return std::pair{std::move(identity), std::move(*record)};
}

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) output::fail_file("write", file_);
  // Where the file system has no locks, the queue sees to it that a task runs once at a time.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw output::FileError("another process writes " + file_.string());
  }
  const std::string text = output::read_file(file_).value_or("");
  std::string_view rest = text;
  while (auto entry = take_entry(rest)) identities_.insert(std::move(entry->first));
  size_ = text.size() - rest.size();
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) {
    const int reason = errno;
    ::close(descriptor_);
    errno = reason;
    output::fail_file("write", file_);
  }
}

Journal::~Journal() {
  ::fsync(descriptor_);
  ::close(descriptor_);
}

void Journal::add(const std::string& identity, const RunRecord& record) {
  const std::string entry = journal_entry(identity, record);
  for (std::size_t written = 0; written < entry.size();) {
    const ssize_t count = ::pwrite(descriptor_, entry.data() + written, entry.size() - written,
                                   static_cast<off_t>(size_ + written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      // Half a record is none, with or without this.
      if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) errno = reason;
      errno = reason;
      output::fail_file("write", file_);
    }
    written += static_cast<std::size_t>(count);
  }
  size_ += entry.size();
  identities_.insert(identity);
  const std::int64_t now = nanoseconds_now();
  if (now - synced_ < between_syncs) return;
  synced_ = now;
  if (::fsync(descriptor_) != 0) output::fail_file("write", file_);
}

void JournalReader::look() {
  text_.erase(0, taken_);
  taken_ = 0;
  const int descriptor = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  char block[1 << 16];
  ssize_t count = 0;
  while ((count = ::pread(descriptor, block, sizeof block, static_cast<off_t>(offset_))) > 0) {
    text_.append(block, static_cast<std::size_t>(count));
    offset_ += static_cast<std::uint64_t>(count);
  }
  ::close(descriptor);
}

std::optional<std::pair<std::string, RunRecord>> JournalReader::next() {
  for (const bool looked : {false, true}) {
    if (looked) look();
    std::string_view rest = std::string_view(text_).substr(taken_);
    if (auto entry = take_entry(rest)) {
      taken_ = text_.size() - rest.size();
      return entry;
    }
  }
  return std::nullopt;
}

}  // namespace hookpoint::studies
